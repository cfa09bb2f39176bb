#include "core/transport/edge_refinement.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr std::uint32_t leaves_a_look = 64; // at the clock

using Worth = std::pair<float, std::uint32_t>; // misfit by squared length, leaf

// Where all that is bent would take more than there is room for, level after level: leaves that are worth less than
// this are left whole, so that the others can be cut as finely as they are worth. A shadow's edge halves the worth of
// what it crosses with each cut, and crosses twice as many leaves after two: of one worth w there are
// sum 2^(k/2) = 3.4 sqrt(w / least) - 2.4 cuts, each of two leaves at once. `wanted`: the largest first.
float least_worth(const std::vector<Worth>& wanted, double room) {
    constexpr double level_share = 0.5, leaves_of_a_cut = 1.5; // some are cut for conformity
    if (double(wanted.size()) < level_share * room) return 0;
    double roots = 0, leaves = 0;
    for (const Worth& w : wanted) {
        const double root = std::sqrt(double(w.first));
        if (3.4 * roots - 2.4 * leaves * root > leaves_of_a_cut * room * root) {
            const double least = 3.4 * roots / (leaves_of_a_cut * room + 2.4 * leaves);
            return static_cast<float>(least * least);
        }
        roots += root, leaves += 1;
    }
    return 0;
}

} // namespace

EdgeRefinement::EdgeRefinement(Mesh& mesh, std::uint32_t most_vertices, Room room)
    : mesh_(mesh)
    , most_vertices_(most_vertices)
    , room_(room) {}

void EdgeRefinement::follow_mesh() {
    bisection_.reset();
    part_ = Part::prepare;
    if (std::exchange(collecting_, false)) next_node_ = first_node_; // again
}

bool EdgeRefinement::step(const Level& level, const std::atomic<bool>& cancel) {
    switch (part_) {
    case Part::prepare:
        if (prepare(cancel)) part_ = Part::collect;
        return false;
    case Part::collect:
        if (!level.collect()) return false;
        ask_first(level.largest_bend);
        part_ = Part::look;
        return false;
    case Part::look:
        if (!level.look()) return false;
        judge(level.bent());
        part_ = Part::plan;
        return false;
    case Part::plan:
        if (plan_split(cancel)) part_ = ask_more(level.largest_bend) ? Part::look : Part::split;
        return false;
    case Part::split:
        level.split();
        part_ = Part::prepare;
        return true;
    }
    return true;
}

bool EdgeRefinement::prepare(const std::atomic<bool>& cancel) {
    if (!bisection_) bisection_.emplace(mesh_, Bisection::adopts_later);
    return bisection_->adopt(cancel);
}

bool EdgeRefinement::collect(float smallest, const std::function<bool(std::uint32_t a, std::uint32_t b)>& wanted,
                             const std::atomic<bool>& cancel) {
    if (!std::exchange(collecting_, true)) {
        edges_.clear();
        edge_slot_.clear();
        open_.clear();
        cursor_ = 0;
    }
    TimeSlice slice(cancel, leaves_a_look);
    for (; next_node_ < mesh_.nodes.size(); ++next_node_) {
        if (slice.over()) return false;
        if (mesh_.nodes[next_node_].children == no_index) open_.push_back(next_node_);
    }
    for (; cursor_ < open_.size(); ++cursor_) {
        if (slice.over()) return false;
        const std::uint32_t n = open_[cursor_];
        const glm::uvec3 v = mesh_.nodes[n].vertices;
        const int longest = bisection_->longest_edge(n);
        const float reach = bisection_->edge_length(v[longest], v[(longest + 1) % 3]);
        if (reach < smallest * smallest) continue;
        const glm::vec3 centre =
            (mesh_.vertices[v.x].position + mesh_.vertices[v.y].position + mesh_.vertices[v.z].position) / 3.0f;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = v[k], b = v[(k + 1) % 3];
            const std::uint64_t key = Bisection::edge_key(a, b);
            if (straight_.contains(key) || !wanted(a, b)) continue;
            const auto [where, fresh] = edge_slot_.try_emplace(key, static_cast<std::uint32_t>(edges_.size()));
            if (fresh) edges_.push_back({std::min(a, b), std::max(a, b)});
            Edge& edge = edges_[where->second];
            edge.inward += centre;
            edge.elements += 1;
            edge.reach = std::max(edge.reach, reach);
        }
    }
    first_node_ = next_node_;
    collecting_ = false;
    return true;
}

EdgeRefinement::Place EdgeRefinement::middle(const Edge& edge, float epsilon) const {
    const MeshVertex &a = mesh_.vertices[edge.a], &b = mesh_.vertices[edge.b];
    const glm::vec3 sum = a.normal + b.normal;
    const glm::vec3 normal = glm::dot(sum, sum) > 1e-12f ? glm::normalize(sum) : a.normal;
    return {ray_origin(0.5f * (a.position + b.position), normal, edge.inward / float(edge.elements), epsilon), normal};
}

void EdgeRefinement::ask_first(float largest_bend) {
    asked_from_ = 0;
    asked_below_ = std::numeric_limits<float>::infinity();
    bent_.assign(edges_.size(), 0);
    const double few = 2 * room();
    if (room_ != Room::for_finer_levels || !std::isfinite(largest_bend) || double(edges_.size()) <= few) return;
    std::vector<float> reach;
    for (const Edge& edge : edges_) reach.push_back(edge.reach);
    const auto last = reach.begin() + static_cast<std::ptrdiff_t>(few);
    std::nth_element(reach.begin(), last, reach.end(), std::greater());
    asked_from_ = *last;
}

bool EdgeRefinement::ask_more(float largest_bend) {
    std::sort(wanted_.begin(), wanted_.end(), [](const Worth& a, const Worth& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    least_ = room_ == Room::for_finer_levels ? least_worth(wanted_, room()) : 0;
    // More edges make the least larger: those that reach it now are all there is to ask.
    const float from = std::isfinite(largest_bend) ? least_ / largest_bend : 0;
    if (asked_from_ <= from) return false;
    asked_below_ = asked_from_;
    asked_from_ = from;
    return true;
}

void EdgeRefinement::judge(const std::vector<float>& bent) {
    for (std::size_t e = 0; e < edges_.size(); ++e)
        if (is_asked(edges_[e])) bent_[e] = bent[e];
    wanted_.clear();
    cursor_ = 0;
}

bool EdgeRefinement::plan_split(const std::atomic<bool>& cancel) {
    TimeSlice slice(cancel, leaves_a_look);
    for (; cursor_ < edges_.size(); ++cursor_) {
        if (slice.over()) return false;
        const Edge& edge = edges_[cursor_];
        if (is_asked(edge) && bent_[cursor_] == 0) straight_.emplace(Bisection::edge_key(edge.a, edge.b), 1);
    }
    for (; cursor_ < edges_.size() + open_.size(); ++cursor_) {
        if (slice.over()) return false;
        const std::uint32_t n = open_[cursor_ - edges_.size()];
        const glm::uvec3 v = mesh_.nodes[n].vertices;
        float worst = 0;
        for (int k = 0; k < 3; ++k) {
            const auto slot = edge_slot_.find(Bisection::edge_key(v[k], v[(k + 1) % 3]));
            if (slot != edge_slot_.end()) worst = std::max(worst, bent_[slot->second]);
        }
        const int longest = bisection_->longest_edge(n);
        if (worst > 0) wanted_.emplace_back(worst * bisection_->edge_length(v[longest], v[(longest + 1) % 3]), n);
    }
    return true;
}

void EdgeRefinement::split() {
    for (const auto& [worth, n] : wanted_) {
        if (mesh_.vertices.size() >= most_vertices_ || worth < least_) break;
        if (mesh_.nodes[n].children == no_index) bisection_->split(n);
    }
    list_leaves(mesh_);
}

std::uint32_t EdgeRefinement::edge_of(std::uint32_t vertex) const {
    const auto& parents = mesh_.vertices[vertex].parents;
    const auto slot = edge_slot_.find(Bisection::edge_key(parents[0], parents[1]));
    return slot != edge_slot_.end() && edges_[slot->second].reach >= asked_from_ ? slot->second : no_index;
}

} // namespace lueur
