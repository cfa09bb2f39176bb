// Gather, push and pull, and what the links' errors come to.
#include "core/solve/hierarchy.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/solve/least_absorbed.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr double settled_share = 1e-3;   // of what the residual may still come to, 1 / (1 - rho) of it
constexpr double least_residual = 1e-6;  // single precision has no more
constexpr double coarse_residual = 0.02; // before the links are refined further
constexpr std::uint32_t most_round_sweeps = 3000;
constexpr std::uint32_t most_rounds = 20;
constexpr std::uint32_t most_growing = 20; // sweeps in a row whose residual grows: the rows have too much energy

// room: for so many in the end. To move what is there takes longer than a step may.
void grow(ChannelField& field, std::uint32_t count, std::size_t room, int channels) {
    if (field.values.empty()) field = ChannelField(count, channels);
    field.values.reserve(room * static_cast<std::size_t>(field.stride));
    field.count = count;
    field.values.resize(std::size_t(count) * static_cast<std::size_t>(field.stride), 0.0f);
}

} // namespace

double tolerance_for(RefinementOracle oracle, double target_error) {
    switch (oracle) {
    case RefinementOracle::form_factor: {
        // Over a node that subtends F the kernel differs by about the square root of F. 1 / F such links make a row;
        // if their errors are independent, the row's is sqrt(1 / F) F sqrt(F) = F.
        return std::max(1e-4, target_error);
    }
    case RefinementOracle::flux: {
        // Measured on the Cornell box against gathering at 1 %: RMS 22.5 % with links of 2e-3 of the emitted flux,
        // 11.3 % with 1.25e-4. Errors fall with the fourth root: a quarter of the flux halves an element's edge only
        // once, and shadow edges, which are lines, gain the root of that.
        constexpr double flux = 2e-3, error = 0.225;
        return std::max(1e-8, flux * std::pow(target_error / error, 4));
    }
    case RefinementOracle::error:
        return 1e-7; // ends by its own estimate, not by this
    }
    return 0;
}

std::size_t Hierarchy::room_for_nodes() const {
    return std::max(tree_.nodes.size(), std::min<std::size_t>(settings_.most_elements, 4 * tree_.root_count));
}

void Hierarchy::resize_values() {
    const std::uint32_t count = static_cast<std::uint32_t>(tree_.nodes.size());
    const std::uint32_t before = total_.count;
    const std::size_t room = room_for_nodes();
    for (ChannelField* field : {&source_, &gathered_, &total_, &b_}) grow(*field, count, room, channels_);
    for (auto* values :
         {&scale_, &row_sum_, &leaf_error_, &brightness_, &brightness_spread_, &direct_brightness_, &arriving_})
        values->resize(count, 0);
    std::fill(scale_.begin() + before, scale_.end(), 1.0f);
    if (direct_) {
        direct_mean_.resize(std::size_t(count) * emitters_, 0);
        direct_spread_.resize(std::size_t(count) * emitters_, 0);
    }
    // What a node is cut into has its light until the next sweep.
    for (std::uint32_t n = before; n < count; ++n) {
        const std::uint32_t parent = tree_.nodes[n].parent;
        if (parent == no_index || tree_.nodes[n].level == 0) continue;
        std::copy_n(total_[parent], total_.stride, total_[n]);
        scale_[n] = scale_[parent];
        arriving_[n] = arriving_[parent];
    }
}

float Hierarchy::bright(const float* channels) const {
    float sum = 0;
    for (std::size_t c = 0; c < sources_.weight.size(); ++c) sum += sources_.weight[c] * channels[c];
    return sum;
}

// E, or what the surface sends on of direct light; and B with the light there is so far.
void Hierarchy::set_leaf_source(std::uint32_t n) {
    const ElementNode& node = tree_.nodes[n];
    const auto& rho = sources_.material_rho[sources_.surface_material[node.surface]];
    float* source = source_[n];
    std::fill_n(source, source_.stride, 0.0f);
    float spread = 0;
    direct_brightness_[n] = 0;
    if (direct_) {
        std::vector<float> of_spread(static_cast<std::size_t>(source_.stride), 0.0f);
        for (std::size_t l = 0; l < emitters_; ++l) {
            const float mean = direct_mean_[std::size_t(n) * emitters_ + l];
            const float sd = direct_spread_[std::size_t(n) * emitters_ + l];
            if (mean == 0 && sd == 0) continue;
            for (std::size_t c = 0; c < sources_.weight.size(); ++c)
                direct_brightness_[n] +=
                    static_cast<float>(double(mean) * double(sources_.weight[c]) * sources_.luminaire_exitance[l][c]);
            for (int c = 0; c < channels_; ++c) {
                const float sent = static_cast<float>(rho[static_cast<std::size_t>(c)] *
                                                      sources_.luminaire_exitance[l][static_cast<std::size_t>(c)]);
                source[c] += sent * mean;
                of_spread[static_cast<std::size_t>(c)] += sent * sd;
            }
        }
        spread = bright(of_spread.data());
    } else {
        std::uint32_t root = n;
        while (tree_.nodes[root].level > 0) root = tree_.nodes[root].parent;
        if (const auto luminaire = sources_.root_luminaire[root])
            for (int c = 0; c < channels_; ++c)
                source[c] = static_cast<float>(sources_.luminaire_exitance[*luminaire][static_cast<std::size_t>(c)]);
    }
    if (points_[n].count == 0) std::fill_n(source, source_.stride, 0.0f); // inside a solid
    for (int c = 0; c < channels_; ++c)
        b_[n][c] = source[c] + static_cast<float>(rho[static_cast<std::size_t>(c)]) * total_[n][c] * scale_[n];
    brightness_[n] = bright(b_[n]);
    brightness_spread_[n] = spread;
}

void Hierarchy::set_sources(HierarchySources sources) {
    const int channels = sources.material_rho.empty() ? 1 : static_cast<int>(sources.material_rho[0].size());
    const bool other_channels = channels != channels_;
    sources_ = std::move(sources);
    channels_ = channels;
    if (other_channels)
        for (ChannelField* field : {&source_, &gathered_, &total_, &b_, &step_before_}) *field = ChannelField();
    if (phase_ == Phase::failed && tree_.root_count > 0 && rounds_ == 0) return; // refused
    points_.resize(tree_.nodes.size());
    resize_values();
    extrapolation_.assign(static_cast<std::size_t>(channels_), 0);
    change_before_.assign(static_cast<std::size_t>(channels_), 0);
    ratio_before_ = change_before_;
    sweeps_since_ = 0;
    emitted_flux_ = mean_rho_ = 0;
    double area = 0, white = 0;
    for (const float w : sources_.weight) white += double(w);
    for (std::uint32_t r = 0; r < tree_.root_count; ++r) {
        const auto& rho = sources_.material_rho[sources_.surface_material[tree_.nodes[r].surface]];
        double y = 0, e = 0;
        for (std::size_t c = 0; c < sources_.weight.size(); ++c) {
            y += double(sources_.weight[c]) * rho[c];
            if (const auto l = sources_.root_luminaire[r])
                e += double(sources_.weight[c]) * sources_.luminaire_exitance[*l][c];
        }
        mean_rho_ += y / std::max(white, 1e-30) * double(tree_.nodes[r].area);
        area += double(tree_.nodes[r].area);
        emitted_flux_ += e * double(tree_.nodes[r].area);
    }
    mean_rho_ = area > 0 ? mean_rho_ / area : 0;
    final_tolerance_ =
        settings_.tolerance > 0 ? settings_.tolerance : tolerance_for(settings_.oracle, settings_.target_error);
    sweeps_of_round_ = growing_ = rounds_of_solve_ = 0;
    gather_cursor_ = 0;
    cut_any_ = true; // other light asks for other links
    if (!begun_) {
        looked_ = 0; // what was looked at may have had other channels
        phase_ = Phase::look;
        return;
    }
    // A round in the making goes on where it was.
    const bool lights_anew =
        phase_ == Phase::relight || (pushing_.sources_only && (phase_ == Phase::push || phase_ == Phase::pull));
    if (!lights_anew) {
        resume_ = refining() ? phase_ : Phase::sweep;
        round_cursor_ = cursor_;
    }
    cursor_ = 0;
    phase_ = Phase::relight;
}

void Hierarchy::relight(TimeSlice& slice) {
    const auto light = [this](std::size_t n) {
        if (!tree_.nodes[n].is_cluster()) set_leaf_source(static_cast<std::uint32_t>(n));
    };
    if (run_slice(cursor_, tree_.nodes.size(), nodes_a_look, slice, light)) start_pushing(true);
}

void Hierarchy::start_listing() {
    first_link_.assign(tree_.nodes.size() + 1, 0);
    listing_ = {};
    listing_.links = kept_.size();
    links_.clear();
    links_.reserve(kept_.size());
    rows_above_one_ = 0;
    phase_ = Phase::list;
}

// Links by receiver, and what their form factors sum to.
void Hierarchy::list_links(TimeSlice& slice) {
    constexpr std::size_t links_a_look = 4096;
    const std::size_t nodes = tree_.nodes.size();
    Listing& l = listing_;
    const auto count = [&](std::size_t k) {
        ++first_link_[kept_[k].receiver + 1];
        links_.push_back({}); // bit by bit: so much fresh memory at once takes longer than a step may
    };
    if (!run_slice(l.counted, l.links, links_a_look, slice, count)) return;
    if (l.next.empty()) {
        for (std::size_t n = 0; n < nodes; ++n) first_link_[n + 1] += first_link_[n];
        l.next.assign(first_link_.begin(), first_link_.end());
    }
    const auto place = [&](std::size_t) {
        links_[l.next[kept_.front().receiver]++] = kept_.front();
        kept_.pop_front();
    };
    if (!run_slice(l.placed, l.links, links_a_look, slice, place)) return;
    const auto sum = [&](std::size_t i) { add_to_row(tree_.parents_first(i)); };
    if (!run_slice(l.summed, nodes, nodes_a_look, slice, sum)) return;
    sweeps_of_round_ = growing_ = 0;
    residual_ = last_residual_ = 1;
    std::fill(extrapolation_.begin(), extrapolation_.end(), 0.0f);
    sweeps_since_ = 0;
    phase_ = Phase::sweep;
}

// A row sums to what stays in the scene, never to more than 1: disks that touch, or two faces in one plane, would send
// more than there is, and with a reflectance near 1 no sweep would converge. With `error` what looks at lit surfaces
// only gets exactly what they send: a row of 1.
void Hierarchy::add_to_row(std::uint32_t n) {
    constexpr float rounding = 1e-4f;
    const ElementNode& node = tree_.nodes[n];
    float sum = node.parent == no_index ? 0 : row_sum_[node.parent];
    for (std::uint32_t l = first_link_[n]; l < first_link_[n + 1]; ++l) sum += links_[l].form_factor;
    row_sum_[n] = sum;
    scale_[n] = 1;
    if (!(sum > 0)) return;
    if (sum > 1 || (node.closed && settings_.oracle == RefinementOracle::error)) scale_[n] = 1 / sum;
    if (node.is_leaf() && !node.is_cluster()) rows_above_one_ += sum > 1 + rounding;
}

// H_r = sum F_rs B_s over the links of each node (correction 39).
bool Hierarchy::gather(const std::atomic<bool>& cancel) {
    return run_slice(gather_cursor_, gathered_.count, 64, cancel, [&](std::uint32_t first, std::uint32_t last) {
        const int stride = b_.stride;
        for (std::uint32_t n = first; n < last; ++n) {
            float* h = gathered_[n];
            std::fill_n(h, stride, 0.0f);
            for (std::uint32_t l = first_link_[n]; l < first_link_[n + 1]; ++l) {
                const float f = links_[l].form_factor;
                const float* b = b_[links_[l].source];
                for (int c = 0; c < stride; ++c) h[c] += f * b[c];
            }
        }
    });
}

double Hierarchy::settled_residual() const {
    return std::max(least_residual, settled_share * (1 - mean_rho_));
}

bool Hierarchy::is_next_tolerance_finer() const {
    return settings_.oracle != RefinementOracle::form_factor && tolerance_ > final_tolerance_ * 1.0001;
}

// When all has been gathered, pushed and pulled: what comes next. A sweep counts when it is through with.
void Hierarchy::end_sweep() {
    ++sweeps_of_round_;
    growing_ = residual_ > last_residual_ ? growing_ + 1 : 0;
    last_residual_ = residual_;
    phase_ = Phase::sweep;
    if (!std::isfinite(residual_) || growing_ > most_growing || sweeps_of_round_ > most_round_sweeps) {
        failure_ = "hierarchical radiosity does not converge on this scene: its rows reflect as much as they receive";
        phase_ = Phase::failed;
        ++sweeps_;
        return;
    }
    const bool last_round = limited_ || !is_next_tolerance_finer();
    const double enough = settled_residual();
    if (residual_ > (last_round ? enough : std::max(coarse_residual * (1 - mean_rho_), enough))) {
        ++sweeps_;
        return;
    }
    measuring_ = {};
    measuring_.square.assign(tree_.nodes.size(), 0);
    measuring_.sum = measuring_.square;
    cursor_ = 0;
    phase_ = Phase::measure;
}

void Hierarchy::end_measuring() {
    ++sweeps_;
    const bool last_round = limited_ || !is_next_tolerance_finer();
    const bool good = settings_.oracle == RefinementOracle::error && settings_.tolerance == 0 &&
                      links_error_ <= settings_.target_error; // what the sweeps leave is swept away
    if (limited_ || rounds_of_solve_ >= most_rounds || good || (last_round && !cut_any_) ||
        settings_.oracle == RefinementOracle::form_factor) {
        phase_ = residual_ <= settled_residual() ? Phase::settled : Phase::sweep;
        return;
    }
    if (!last_round) tolerance_ = std::max(final_tolerance_, tolerance_ / 2);
    start_round();
}

void Hierarchy::start_pushing(bool sources_only) {
    pushing_ = {};
    pushing_.sources_only = sources_only;
    pushing_.change.assign(static_cast<std::size_t>(channels_), 0);
    pushing_.norm = pushing_.along = pushing_.before = pushing_.change;
    grow(step_before_, static_cast<std::uint32_t>(tree_.nodes.size()), room_for_nodes(), channels_);
    gather_cursor_ = 0;
    cursor_ = 0;
    phase_ = Phase::push;
}

void Hierarchy::push(TimeSlice& slice) {
    const auto push_next = [this](std::size_t i) { push_to(tree_.parents_first(i)); };
    if (!run_slice(cursor_, tree_.nodes.size(), nodes_a_look, slice, push_next)) return;
    auto& [sources_only, change, norm, along, before, light, area] = pushing_;
    mean_irradiance_ = area > 0 ? light / area : 0;
    residual_ = 0;
    for (std::size_t c = 0; c < change.size(); ++c) {
        along[c] = before[c] > 0 && change[c] > 0 ? along[c] / std::sqrt(before[c] * change[c]) : 1;
        change[c] = norm[c] > 0 ? std::sqrt(change[c] / norm[c]) : 0;
        if (!(change[c] <= residual_)) residual_ = change[c]; // and where it is not a number
    }
    if (!sources_only) extrapolate(change, along);
    cursor_ = 0;
    phase_ = Phase::pull;
}

void Hierarchy::pull(TimeSlice& slice) {
    const auto pull_next = [this](std::size_t i) { pull_to(tree_.children_first(i)); };
    if (!run_slice(cursor_, tree_.nodes.size(), nodes_a_look, slice, pull_next)) return;
    if (!pushing_.sources_only) return end_sweep();
    cursor_ = round_cursor_;
    phase_ = resume_;
}

// Irradiance, not radiosity, goes down (correction 41): children may have paints of their own.
void Hierarchy::push_to(std::uint32_t n) {
    auto& [sources_only, change, norm, along, before, light, area] = pushing_;
    const ElementNode& node = tree_.nodes[n];
    if (!sources_only) {
        const float* from = node.parent == no_index ? nullptr : total_[node.parent];
        for (int c = 0; c < channels_; ++c) total_[n][c] = gathered_[n][c] + (from ? from[c] : 0);
    }
    if (!node.is_leaf() || node.is_cluster()) return;
    const auto& rho = sources_.material_rho[sources_.surface_material[node.surface]];
    const bool buried = points_[n].count == 0;
    for (int c = 0; c < channels_; ++c) {
        const auto k = static_cast<std::size_t>(c);
        const float b = buried ? 0 : source_[n][c] + static_cast<float>(rho[k]) * total_[n][c] * scale_[n];
        const float step = b - b_[n][c];
        // A lamp's own exitance may be a million times what its light leaves elsewhere: it does not change.
        const float sent_on = direct_ ? b : b - (buried ? 0 : source_[n][c]);
        change[k] += double(node.live_area()) * double(step) * double(step);
        norm[k] += double(node.live_area()) * double(sent_on) * double(sent_on);
        along[k] += double(node.live_area()) * double(step) * double(step_before_[n][c]);
        before[k] += double(node.live_area()) * double(step_before_[n][c]) * double(step_before_[n][c]);
        step_before_[n][c] = step;
        b_[n][c] = extrapolation_[k] != 0 ? std::max(0.0f, b + extrapolation_[k] * step) : b;
    }
    brightness_[n] = bright(b_[n]);
    arriving_[n] = buried ? 0 : bright(total_[n]) * scale_[n];
    light += double(node.live_area()) * (double(arriving_[n]) + double(direct_brightness_[n]));
    area += double(node.live_area());
}

void Hierarchy::pull_to(std::uint32_t n) {
    const ElementNode& node = tree_.nodes[n];
    if (node.is_leaf()) return;
    double whole = 0;
    for (const std::uint32_t child : node.children)
        if (child != no_index) whole += double(tree_.nodes[child].live_area());
    float* b = b_[n];
    std::fill_n(b, b_.stride, 0.0f);
    brightness_[n] = arriving_[n] = 0;
    double square = 0;
    for (const std::uint32_t child : node.children) {
        if (child == no_index || !(whole > 0)) continue;
        const float share = static_cast<float>(double(tree_.nodes[child].live_area()) / whole);
        for (int c = 0; c < channels_; ++c) b[c] += share * b_[child][c];
        brightness_[n] += share * brightness_[child];
        arriving_[n] += share * arriving_[child];
        square += double(share) * (double(brightness_spread_[child]) * brightness_spread_[child] +
                                   double(brightness_[child]) * brightness_[child]);
    }
    brightness_spread_[n] =
        static_cast<float>(std::sqrt(std::max(0.0, square - double(brightness_[n]) * brightness_[n])));
}

// Sweeps by Jacobi approach the end along one direction, by the same ratio each; once the ratio stands, the rest of the
// way is a geometric series (Lyusternik 1947), and the next sweep goes it at once. Without this a white room takes a
// thousand. Between two plates light goes to and fro: there is a second direction, along which every step undoes the
// one before, and which that series would blow up. Half a step ends it.
void Hierarchy::extrapolate(const std::vector<double>& change, const std::vector<double>& alignment) {
    constexpr std::uint32_t sweeps_between = 4;
    constexpr double same_way = 0.98; // cosine between two steps
    const bool had = std::any_of(extrapolation_.begin(), extrapolation_.end(), [](float e) { return e != 0; });
    ++sweeps_since_;
    if (had) sweeps_since_ = 0;
    for (std::size_t c = 0; c < change.size(); ++c) {
        const double ratio = change_before_[c] > 0 ? change[c] / change_before_[c] : 0;
        const bool stands = ratio > 0.3 && ratio < 1 - 1e-6 && std::abs(ratio - ratio_before_[c]) < 0.1 * (1 - ratio);
        extrapolation_[c] = 0;
        if (sweeps_since_ >= sweeps_between && alignment[c] > same_way && stands)
            extrapolation_[c] = static_cast<float>(ratio / (1 - ratio));
        else if (sweeps_since_ >= sweeps_between && alignment[c] < same_way && ratio > 0.3)
            extrapolation_[c] = -0.5f;
        ratio_before_[c] = ratio;
        change_before_[c] = change[c];
    }
}

void Hierarchy::measure_node(std::uint32_t n) {
    auto& [square, sum, errors, bounds, light, mean] = measuring_;
    const ElementNode& node = tree_.nodes[n];
    if (node.parent != no_index) square[n] = square[node.parent], sum[n] = sum[node.parent];
    for (std::uint32_t l = first_link_[n]; l < first_link_[n + 1]; ++l) {
        const Link& link = links_[l];
        const float e = static_cast<float>(contrast(n, link.source)) * link.spread +
                        link.form_factor * brightness_spread_[link.source];
        square[n] += e * e, sum[n] += e;
    }
    if (!node.is_leaf() || node.is_cluster()) return;
    leaf_error_[n] = std::sqrt(square[n]);
    const double h = double(bright(total_[n])) * double(scale_[n]) + double(direct_brightness_[n]);
    const double area = double(node.live_area());
    errors += area * double(square[n]);
    bounds += area * double(sum[n]);
    light += area * h * h;
    mean += area * h;
}

void Hierarchy::measure_errors(TimeSlice& slice) {
    const auto measure_next = [this](std::size_t i) { measure_node(tree_.parents_first(i)); };
    if (!run_slice(cursor_, tree_.nodes.size(), nodes_a_look, slice, measure_next)) return;
    const auto& [square, sum, errors, bounds, light, mean] = measuring_;
    const double absorbed = std::max(least_absorbed, 1 - mean_rho_);
    links_error_ = light > 0 ? std::sqrt(errors / light) : 0;
    estimated_error_ = std::min(1.0, links_error_ + residual_ / absorbed);
    error_bound_ = mean > 0 ? bounds / mean / absorbed + residual_ / absorbed : 0;
    end_measuring();
}

} // namespace lueur
