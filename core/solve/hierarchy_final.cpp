#include "core/solve/hierarchy_final.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/transport/polygon_form_factor.h"
#include "core/transport/sampling.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

// Of the node that a vertex reads, and of those above it.
template <typename F>
void for_nodes_above(const ElementTree& tree, std::uint32_t leaf, const F& f) {
    for (std::uint32_t n = leaf; n != no_index; n = tree.nodes[n].parent) f(n);
}

constexpr std::uint32_t vertices_a_look = 256; // at the clock

} // namespace

bool FinalGather::count_factors(const Hierarchy& hierarchy, const std::vector<LeafReading>& readings,
                                const std::vector<std::uint8_t>& buried, const std::atomic<bool>& cancel,
                                Count& count) {
    TimeSlice slice(cancel, vertices_a_look);
    while (count.vertices < readings.size()) {
        const std::uint32_t v = count.vertices++;
        if (!buried[v])
            for_nodes_above(hierarchy.tree(), readings[v].leaf,
                            [&](std::uint32_t n) { count.factors += hierarchy.links_of(n).size(); });
        if (slice.over()) break;
    }
    return count.vertices >= readings.size();
}

FinalGather::FinalGather(const Mesh& mesh, const std::vector<glm::vec3>& origins, std::vector<LeafReading> readings,
                         std::vector<std::uint8_t> buried, std::uint64_t factors)
    : mesh_(mesh)
    , origins_(origins)
    , readings_(std::move(readings))
    , buried_(std::move(buried))
    , vertices_(static_cast<std::uint32_t>(readings_.size())) {
    first_.reserve(vertices_ + 1);
    first_.push_back(0);
    source_.reserve(factors);
    factor_.reserve(factors);
    scale_.assign(vertices_, 1);
}

bool FinalGather::trace(const World& world, const Hierarchy& hierarchy, const std::atomic<bool>& cancel) {
    TimeSlice slice(cancel, vertices_a_look);
    while (listed_ < vertices_) {
        const std::uint32_t v = listed_++;
        if (!buried_[v])
            for_nodes_above(hierarchy.tree(), readings_[v].leaf, [&](std::uint32_t n) {
                for (const Link& link : hierarchy.links_of(n)) source_.push_back(link.source);
            });
        factor_.resize(source_.size(), 0.0f);
        first_.push_back(source_.size());
        if (slice.over()) return false;
    }
    return run_slice(cursor_, vertices_, 8, cancel, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t v = first; v < last; ++v) look_from(world, hierarchy, v);
    });
}

void FinalGather::look_from(const World& world, const Hierarchy& hierarchy, std::uint32_t vertex) {
    constexpr std::uint32_t rays_around = 32;
    if (first_[vertex] == first_[vertex + 1]) return;
    const ElementTree& tree = hierarchy.tree();
    const glm::vec3 p = origins_[vertex], normal = mesh_.vertices[vertex].normal;
    std::uint64_t rays = 0;
    double sum = 0;
    for (std::size_t l = first_[vertex]; l < first_[vertex + 1]; ++l) {
        const ElementNode& s = tree.nodes[source_[l]];
        const NodePoints& q = hierarchy.points_of(source_[l]);
        double all = 0, visible = 0, disks = 0;
        for (int j = 0; j < q.count; ++j) {
            const auto k = static_cast<std::size_t>(j);
            const glm::vec3 d = q.position[k] - p;
            const float r2 = glm::dot(d, d), a = glm::dot(d, normal), b = -glm::dot(d, q.normal[k]);
            if (!(a > 0 && b > 0 && r2 > 0)) continue;
            all += a * b / (r2 * r2);
            ++rays;
            if (world.occluded({p, d, 1e-5f, 1 - 1e-5f})) continue;
            const double part = double(s.live_area()) / q.count;
            visible += a * b / (r2 * r2);
            disks += part * a * b / r2 / (std::numbers::pi * r2 + part);
        }
        double f = disks;
        if (!s.is_cluster()) {
            f = 0;
            if (glm::dot(p - s.centre, s.normal) > 0 && (visible > 0 || all == 0)) {
                const std::size_t corners = s.shape == ElementShape::quadrilateral ? 4 : 3;
                std::array<glm::dvec3, 4> polygon;
                for (std::size_t k = 0; k < corners; ++k) polygon[k] = tree.vertices[s.corners[k]];
                f = polygon_form_factor(p, normal, {polygon.data(), corners}) * s.live_share;
                f *= all > 0 ? visible / all : visible_corners(world, tree, p, normal, source_[l], rays);
            }
        }
        factor_[l] = static_cast<float>(f);
        sum += f;
    }
    // As for elements: who sees lit surfaces only gets a row of 1, and nobody more.
    bool closed = true;
    const Frame frame(normal);
    for (std::uint32_t k = 0; k < rays_around && closed; ++k, ++rays)
        closed = world.closest({p, frame.world(cosine_direction(r2_point(k, {0, 0})))}).element != no_index;
    if (sum > 0 && (closed || sum > 1)) scale_[vertex] = static_cast<float>(1 / sum);
    rays_.fetch_add(rays, std::memory_order_relaxed);
}

bool FinalGather::gather(const Hierarchy& hierarchy, const std::atomic<bool>& cancel, std::uint32_t& cursor,
                         ChannelField& irradiance) const {
    const ChannelField& b = hierarchy.radiosity();
    return run_slice(cursor, vertices_, 16, cancel, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t v = first; v < last; ++v) {
            float* out = irradiance[v];
            for (std::size_t l = first_[v]; l < first_[v + 1]; ++l) {
                const float f = factor_[l] * scale_[v];
                const float* from = b[source_[l]];
                for (int c = 0; c < irradiance.stride; ++c) out[c] += f * from[c];
            }
        }
    });
}

} // namespace lueur
