// Refinement: what is linked, and what is cut first.
#include "core/solve/hierarchy.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr std::size_t batch = 256;                 // of work judged together: a millisecond or two
constexpr std::uint32_t most_lecture_roots = 3000; // every pair of which the lecture's forms link
constexpr float flat_enough = 0.7f;                // least cosine in a cluster that receives as one: about 45 degrees
constexpr double coarsest = 64;                    // times the final tolerance, where flux refinement begins

} // namespace

Hierarchy::Hierarchy(const Scene& scene, const World& world, const HierarchySettings& settings, DirectAt direct)
    : world_(world)
    , settings_(settings)
    , direct_(std::move(direct))
    , emitters_(scene.luminaires.size())
    , tree_(make_element_tree(scene, settings.oracle == RefinementOracle::error)) {
    tree_.nodes.reserve(room_for_nodes());
    points_.reserve(room_for_nodes());
    for (const ElementNode& n : tree_.nodes) leaves_ += n.is_leaf();
    for (std::uint32_t r = 0; r < tree_.root_count; ++r) total_area_ += double(tree_.nodes[r].area);
    if (!(settings_.smallest_area > 0)) settings_.smallest_area = static_cast<float>(total_area_ / 20000);
    if (settings_.oracle != RefinementOracle::error && tree_.root_count > most_lecture_roots) {
        failure_ = fmt::format("the lecture's hierarchical radiosity links every pair of surfaces: {} are too many (at "
                               "most {}); oracle = \"error\" has clusters above them",
                               tree_.root_count, most_lecture_roots);
        phase_ = Phase::failed;
    }
}

double Hierarchy::progress() const {
    if (phase_ == Phase::settled) return 1;
    if (phase_ == Phase::refine && !work_.empty()) return double(work_done_) / double(work_done_ + work_.size());
    if (phase_ == Phase::look && !tree_.nodes.empty()) return double(looked_) / double(tree_.nodes.size());
    return 0;
}

const char* Hierarchy::doing() const {
    switch (phase_) {
    case Phase::relight:
        return "relight";
    case Phase::look:
        return "look";
    case Phase::begin:
        return "begin";
    case Phase::refine:
        return "refine";
    case Phase::list:
        return "list";
    case Phase::sweep:
        return "sweep";
    case Phase::push:
        return "push";
    case Phase::pull:
        return "pull";
    case Phase::measure:
        return "measure";
    case Phase::settled:
        return "settled";
    case Phase::failed:
        return "failed";
    }
    return "";
}

std::uint32_t Hierarchy::link_count() const {
    const std::size_t count = phase_ == Phase::list ? listing_.links : (refining() ? kept_.size() : links_.size());
    return static_cast<std::uint32_t>(count);
}

bool Hierarchy::step(const std::atomic<bool>& cancel) {
    TimeSlice slice(cancel);
    // One sweep a step: what is shown between rounds, and read by the next, must not depend on the time.
    const std::uint32_t sweeps = sweeps_;
    const auto at_end = [this] { return phase_ == Phase::settled || phase_ == Phase::failed; };
    while (!at_end() && sweeps_ == sweeps && !cancel.load(std::memory_order_relaxed)) {
        switch (phase_) {
        case Phase::relight:
            relight(slice);
            break;
        case Phase::look:
            look_at_new_nodes(cancel);
            break;
        case Phase::begin:
            begin_round(slice);
            break;
        case Phase::refine:
            refine_some();
            break;
        case Phase::list:
            list_links(slice);
            break;
        case Phase::sweep:
            if (gather(cancel)) start_pushing(false);
            break;
        case Phase::push:
            push(slice);
            break;
        case Phase::pull:
            pull(slice);
            break;
        case Phase::measure:
            measure_errors(slice);
            break;
        case Phase::settled:
        case Phase::failed:
            break;
        }
        if (slice.over()) break;
    }
    return !at_end();
}

// Every node gets the points that stand for it, and its direct light.
void Hierarchy::look_at_new_nodes(const std::atomic<bool>& cancel) {
    const std::uint32_t count = static_cast<std::uint32_t>(tree_.nodes.size());
    if (points_.size() != count) {
        points_.resize(count);
        resize_values();
    }
    const std::uint32_t first_time = rounds_ == 0 ? tree_.root_count : 0;
    const bool done = run_slice(looked_, count, 16, cancel, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t n = first; n < last; ++n) {
            points_[n] = look_around(world_, tree_, n, 4 * settings_.smallest_area);
            if (!tree_.nodes[n].is_cluster()) light_node(n);
        }
    });
    if (!done) return;
    phase_ = Phase::refine;
    if (first_time == 0 || begun_) return;
    for (std::size_t i = tree_.nodes.size() - tree_.cluster_count; i < tree_.nodes.size(); ++i) {
        // Of clusters as much lives as of their roots.
        ElementNode& node = tree_.nodes[tree_.children_first(i)];
        const ElementNode &a = tree_.nodes[node.children[0]], &b = tree_.nodes[node.children[1]];
        node.live_share = node.area > 0 ? std::min(1.0f, (a.live_area() + b.live_area()) / node.area) : 0;
    }
    begun_ = true;
    start_round();
    resume_ = Phase::begin;
    round_cursor_ = 0;
    start_pushing(true);
}

void Hierarchy::light_node(std::uint32_t n) {
    if (direct_) {
        float* mean = direct_mean_.data() + std::size_t(n) * emitters_;
        float* spread = direct_spread_.data() + std::size_t(n) * emitters_;
        std::vector<float> factors(emitters_ * link_points);
        const NodePoints& points = points_[n];
        for (int k = 0; k < points.count; ++k)
            direct_(points.position[static_cast<std::size_t>(k)], points.normal[static_cast<std::size_t>(k)],
                    factors.data() + static_cast<std::size_t>(k) * emitters_);
        for (std::size_t l = 0; l < emitters_; ++l) {
            double sum = 0, square = 0;
            for (int k = 0; k < points.count; ++k) sum += factors[static_cast<std::size_t>(k) * emitters_ + l];
            const double m = points.count > 0 ? sum / points.count : 0;
            for (int k = 0; k < points.count; ++k)
                square += std::pow(factors[static_cast<std::size_t>(k) * emitters_ + l] - m, 2);
            mean[l] = static_cast<float>(m);
            spread[l] = static_cast<float>(points.count > 1 ? std::sqrt(square / (points.count - 1)) : 0);
        }
    }
    set_leaf_source(n);
}

void Hierarchy::start_round() {
    work_.clear();
    kept_.clear();
    work_done_ = cursor_ = 0;
    cut_any_ = false;
    if (rounds_ == 0) {
        tolerance_ = final_tolerance_;
        if (settings_.oracle == RefinementOracle::error && settings_.tolerance == 0) tolerance_ = 0.02;
        if (settings_.oracle == RefinementOracle::flux) tolerance_ = coarsest * final_tolerance_;
    }
    phase_ = Phase::begin;
}

// The first round links what there is: every pair of surfaces, or the cluster over all with itself. Later ones look at
// all links again.
void Hierarchy::begin_round(TimeSlice& slice) {
    if (rounds_ > 0) {
        const auto look_again = [this](std::size_t l) {
            const Link& link = links_[l];
            work_.push_back(
                {link.receiver, link.source, false, true, {link.form_factor, link.spread, 0}, {}, Verdict::keep});
        };
        if (!run_slice(cursor_, links_.size(), nodes_a_look, slice, look_again)) return;
    } else if (settings_.oracle == RefinementOracle::error) {
        if (tree_.top != no_index) work_.push_back({tree_.top, tree_.top});
    } else {
        const auto link_pairs = [this](std::size_t p) {
            for (auto q = static_cast<std::uint32_t>(p) + 1; q < tree_.root_count; ++q)
                work_.push_back({static_cast<std::uint32_t>(p), q, true});
        };
        if (!run_slice(cursor_, tree_.root_count, 1, slice, link_pairs)) return;
    }
    ++rounds_;
    ++rounds_of_solve_;
    phase_ = Phase::refine;
}

void Hierarchy::refine_some() {
    if (work_.empty()) return start_listing();
    const std::size_t count = std::min(work_.size(), batch);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16), [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t w = range.begin(); w < range.end(); ++w) judge(work_[w]);
    });
    for (std::size_t w = 0; w < count; ++w) {
        const Work work = work_[w]; // apply() grows the list
        rays_ += work.there.rays + work.back.rays;
        apply(work);
    }
    work_.erase(work_.begin(), work_.begin() + static_cast<std::ptrdiff_t>(count));
    work_done_ += count;
    if (looked_ < tree_.nodes.size()) phase_ = Phase::look;
}

void Hierarchy::judge(Work& work) const {
    const auto estimate = [&](std::uint32_t receiver, std::uint32_t source) {
        // The lecture's disks lose a tenth of what walls exchange at their common edge: what touches gets the exact
        // formula from its points.
        const ElementNode &r = tree_.nodes[receiver], &s = tree_.nodes[source];
        const bool touch = glm::distance(r.centre, s.centre) < r.radius + s.radius;
        const bool disks = settings_.oracle != RefinementOracle::error && !touch;
        return estimate_link(world_, tree_, points_, receiver, source, disks ? LinkKernel::disks : LinkKernel::polygon);
    };
    if (work.receiver != work.source && !can_face(tree_, work.receiver, work.source)) {
        work.verdict = Verdict::drop;
        return;
    }
    switch (settings_.oracle) {
    case RefinementOracle::form_factor:
        work.verdict = by_form_factor(work);
        break;
    case RefinementOracle::flux:
        if (!work.estimated && !work.pair) work.there = estimate(work.receiver, work.source);
        // At first all surfaces are linked whole, whatever they will send; then links are refined.
        work.verdict = work.pair ? Verdict::keep : by_flux(work);
        break;
    case RefinementOracle::error:
        if (!work.estimated && work.receiver != work.source) work.there = estimate(work.receiver, work.source);
        work.verdict = by_error(work);
        return;
    }
    if (work.pair && work.verdict == Verdict::keep) {
        work.there = estimate(work.receiver, work.source);
        work.back = estimate(work.source, work.receiver);
    }
}

bool Hierarchy::can_cut(std::uint32_t n) const {
    const ElementNode& node = tree_.nodes[n];
    return !node.is_leaf() || (node.area > settings_.smallest_area && !limited_);
}

// The lecture cuts the one that receives more of the other's light, F_rs < F_sr: the larger one (correction 38).
Hierarchy::Verdict Hierarchy::cut_one(std::uint32_t receiver, std::uint32_t source, bool prefer_source) const {
    const bool r = can_cut(receiver), s = can_cut(source);
    if (!r && !s) return Verdict::keep; // correction 43: the link stays, refinement ends
    return s && (prefer_source || !r) ? Verdict::cut_source : Verdict::cut_receiver;
}

// Oracle1 with its result the right way round (correction 37) and both directions looked at (38).
Hierarchy::Verdict Hierarchy::by_form_factor(const Work& work) const {
    if (!work.pair) return Verdict::keep;
    const float f = std::max(lecture_form_factor(tree_, work.receiver, work.source),
                             lecture_form_factor(tree_, work.source, work.receiver));
    if (f < tolerance_) return Verdict::keep;
    return cut_one(work.receiver, work.source, tree_.nodes[work.source].area > tree_.nodes[work.receiver].area);
}

// Oracle2: the flux that a link carries, B_s A_r F_rs (correction 40), brightness over all channels (42).
Hierarchy::Verdict Hierarchy::by_flux(const Work& work) const {
    const float b = brightness_[work.source];
    if (!(b > 0)) return Verdict::keep;
    const double flux = double(b) * tree_.nodes[work.receiver].live_area() * work.there.form_factor;
    if (flux <= tolerance_ * emitted_flux_) return Verdict::keep;
    return cut_one(work.receiver, work.source, tree_.nodes[work.source].area > tree_.nodes[work.receiver].area);
}

// What an error dF of a link costs, dF times this. A row that is known to sum to 1 is scaled to it, so that an error of
// one link is taken from all others: sum dF_s B_s = sum dF_s (B_s - H). A furnace then needs no links to speak of, and
// a white room none between what is equally bright.
double Hierarchy::contrast(std::uint32_t receiver, std::uint32_t source) const {
    const double b = brightness_[source];
    return tree_.nodes[receiver].closed ? std::abs(b - double(arriving_[receiver])) : b;
}

Hierarchy::Verdict Hierarchy::by_error(const Work& work) const {
    const ElementNode &r = tree_.nodes[work.receiver], &s = tree_.nodes[work.source];
    if (work.receiver == work.source) return r.is_cluster() ? Verdict::cut_receiver : Verdict::drop;
    if (r.is_cluster() && r.flatness < flat_enough) return Verdict::cut_receiver;
    if (!r.is_cluster() && points_[work.receiver].count == 0 && r.is_leaf()) return Verdict::drop; // inside a solid
    const double b = contrast(work.receiver, work.source);
    const double limit = tolerance_ * mean_irradiance_;
    const double weight = std::sqrt(r.live_area() / total_area_);
    // Spheres that touch: four points say little of a cluster that near.
    const bool near = (r.is_cluster() || s.is_cluster()) && glm::distance(r.centre, s.centre) < r.radius + s.radius;
    const double of_receiver = b * (near ? std::max(work.there.spread, 0.5f) : work.there.spread);
    const double of_source = double(work.there.form_factor) * brightness_spread_[work.source];
    if ((of_receiver + of_source) * weight <= limit) return Verdict::keep;
    if (near) return cut_one(work.receiver, work.source, s.is_cluster() && (!r.is_cluster() || s.radius > r.radius));
    return cut_one(work.receiver, work.source, of_source > of_receiver || s.radius > r.radius);
}

void Hierarchy::apply(const Work& work) {
    const auto link = [&](std::uint32_t r, std::uint32_t s, const LinkEstimate& e) {
        if (e.form_factor > 0) kept_.push_back({r, s, e.form_factor, e.spread});
    };
    switch (work.verdict) {
    case Verdict::drop:
        return;
    case Verdict::keep:
        link(work.receiver, work.source, work.there);
        if (work.pair) link(work.source, work.receiver, work.back);
        if (kept_.size() + work_.size() >= settings_.most_links) limited_ = true;
        return;
    case Verdict::cut_receiver:
    case Verdict::cut_source: {
        cut_any_ = true;
        const bool receiver = work.verdict == Verdict::cut_receiver;
        const std::uint32_t node = receiver ? work.receiver : work.source;
        cut(node);
        const auto children = tree_.nodes[node].children;
        for (const std::uint32_t child : children) {
            if (child == no_index) continue;
            if (work.receiver == work.source) {
                for (const std::uint32_t other : children)
                    if (other != no_index && (other != child || tree_.nodes[child].is_cluster()))
                        work_.push_back({child, other});
            } else {
                work_.push_back({receiver ? child : work.receiver, receiver ? work.source : child, work.pair});
            }
        }
        return;
    }
    }
}

void Hierarchy::cut(std::uint32_t node) {
    if (!tree_.nodes[node].is_leaf()) return;
    cut_element(tree_, node);
    --leaves_;
    for (const std::uint32_t child : tree_.nodes[node].children)
        if (child != no_index) ++leaves_, levels_ = std::max<std::uint32_t>(levels_, tree_.nodes[child].level);
    if (tree_.nodes.size() >= settings_.most_elements) limited_ = true;
}

} // namespace lueur
