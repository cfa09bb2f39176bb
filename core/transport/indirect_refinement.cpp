#include "core/transport/indirect_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/transport/gather_rows.h"
#include "core/transport/sampling.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr std::uint32_t rays_a_place = 32; // differences between places count, and the rays are alike
constexpr float grey_reflectance = 0.5f;
constexpr float close_edge = 0.7f; // of the distance to what is around: longer edges are looked at

} // namespace

IndirectRefinement::IndirectRefinement(const World& world, Mesh& mesh, const DirectTransport& direct,
                                       std::vector<std::uint8_t> buried, std::vector<float> distance,
                                       const IndirectParams& params)
    : world_(world)
    , mesh_(mesh)
    , params_(params)
    , samples_(direct.samples())
    , edges_(mesh, params.most_vertices, params.room)
    , buried_(std::move(buried))
    , distance_(std::move(distance))
    , origins_(ray_origins(mesh, world.epsilon())) {
    const std::vector<float> area = vertex_areas(mesh);
    double sum = 0, all = 0;
    for (std::uint32_t v = 0; v < mesh.coarse_vertex_count; ++v) {
        direct_.push_back(direct.guessed_light()[v]);
        if (!buried_[v]) sum += double(area[v]) * direct_[v], all += area[v];
    }
    // Light of further reflections as if it were the same everywhere: rho + rho^2 + ... of the mean.
    const float mean = all > 0 ? static_cast<float>(sum / all) : 0;
    const float ambient = mean * grey_reflectance / (1 - grey_reflectance);
    for (const float d : direct_) radiosity_.push_back(grey_reflectance * (d + ambient));
    floor_ = 0.25f * (mean + ambient);
    light_.assign(mesh.vertices.size(), -1);
    done_ = !(mean > 0);
}

// The same directions about any normal: what differs between two places near each other is not noise.
IndirectRefinement::Seen IndirectRefinement::gather(glm::vec3 origin, glm::vec3 normal) const {
    const Frame frame(normal);
    double light = 0, nearness = 0;
    int back_faces = 0;
    std::array<glm::vec3, rays_a_place> directions;
    std::array<Hit, rays_a_place> hits;
    for (std::uint32_t k = 0; k < rays_a_place; ++k) directions[k] = frame.world(cosine_direction(r2_point(k, {0, 0})));
    world_.closest(origin, directions, hits);
    for (const Hit& hit : hits) {
        if (!hit.any()) continue;
        nearness += 1 / std::max(double(hit.t), 1e-20);
        back_faces += hit.back_face;
        if (hit.element == no_index) continue;
        const glm::uvec3 v = mesh_.nodes[hit.element].vertices;
        const glm::vec3 w(1 - hit.b1 - hit.b2, hit.b1, hit.b2);
        double sum = 0, weight = 0;
        for (int c = 0; c < 3; ++c)
            if (!buried_[v[c]]) sum += double(w[c]) * radiosity_[v[c]], weight += w[c];
        if (weight > 0) light += sum / weight;
    }
    rays_.fetch_add(rays_a_place, std::memory_order_relaxed);
    return {static_cast<float>(light / rays_a_place),
            nearness > 0 ? static_cast<float>(rays_a_place / nearness) : 1e30f, 4 * back_faces > int(rays_a_place)};
}

bool IndirectRefinement::is_close(std::uint32_t a, std::uint32_t b) const {
    const float length = glm::distance(mesh_.vertices[a].position, mesh_.vertices[b].position);
    // Between vertices that read samples there is nothing finer to be had.
    if (!samples_.stands_alone(a) && !samples_.stands_alone(b) && length <= samples_.cell) return false;
    // A bar of a picture frame has its ends in its neighbours and its back in the wall: only what lies between is seen.
    if (buried_[a] || buried_[b]) return true;
    return length > close_edge * std::min(distance_[a], distance_[b]);
}

// The edges that may be bent, and the vertices whose light has to be known for them.
bool IndirectRefinement::begin_level(const std::atomic<bool>& cancel) {
    if (!edges_.collect(
            edges_.begun() ? params_.smallest_edge : params_.smallest_element,
            [this](std::uint32_t a, std::uint32_t b) { return is_close(a, b); }, cancel))
        return false;
    corners_.clear();
    cursor_ = 0;
    std::vector<std::uint8_t> wanted(mesh_.vertices.size(), 0);
    for (const EdgeRefinement::Edge& edge : edges_.edges())
        for (const std::uint32_t end : {edge.a, edge.b})
            if (light_[end] < 0 && !buried_[end] && !wanted[end]) wanted[end] = 1, corners_.push_back(end);
    seen_.assign(edges_.edges().size() + corners_.size(), {});
    return true;
}

std::vector<float> IndirectRefinement::bent_edges() {
    const std::vector<EdgeRefinement::Edge>& edges = edges_.edges();
    for (std::size_t c = 0; c < corners_.size(); ++c) light_[corners_[c]] = seen_[edges.size() + c].light;
    std::vector<float> bent(edges.size(), 0);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        float light = 0, direct = 0, ends = 0;
        for (const std::uint32_t v : {edges[e].a, edges[e].b})
            if (!buried_[v]) light += light_[v], direct += direct_[v], ends += 1;
        if (seen_[e].buried) continue;
        if (ends == 0) {
            bent[e] = 1; // nothing is known of what is seen here
            continue;
        }
        const float guess = light / ends, here = seen_[e].light;
        const float misfit = std::abs(here - guess) / std::max(floor_, here + direct / ends);
        if (misfit > params_.tolerance) bent[e] = misfit;
    }
    return bent;
}

void IndirectRefinement::split_bent() {
    const std::uint32_t before = static_cast<std::uint32_t>(mesh_.vertices.size());
    edges_.split();
    const std::uint32_t after = static_cast<std::uint32_t>(mesh_.vertices.size());
    origins_ = ray_origins(mesh_, world_.epsilon());
    std::vector<std::uint32_t> unseen; // made for conformity
    for (std::uint32_t v = before; v < after; ++v) {
        const auto& parents = mesh_.vertices[v].parents;
        const std::uint32_t looked_at = edges_.edge_of(v);
        const Seen seen = looked_at != no_index ? seen_[looked_at] : Seen{};
        direct_.push_back(0.5f * (direct_[parents[0]] + direct_[parents[1]]));
        light_.push_back(seen.light);
        distance_.push_back(seen.distance);
        buried_.push_back(seen.buried);
        if (seen.light < 0) unseen.push_back(v);
    }
    tbb::parallel_for(std::size_t(0), unseen.size(), [&](std::size_t i) {
        const std::uint32_t v = unseen[i];
        const Seen seen = gather(origins_[v], mesh_.vertices[v].normal);
        light_[v] = seen.light, distance_[v] = seen.distance, buried_[v] = seen.buried;
    });
    done_ = after == before || after >= params_.most_vertices;
}

bool IndirectRefinement::step(const std::atomic<bool>& cancel) {
    if (done_) return true;
    const EdgeRefinement::Level level{[&] { return begin_level(cancel); }, [&] { return look(cancel); },
                                      [&] { return bent_edges(); }, [&] { split_bent(); }};
    return edges_.step(level, cancel) && done_;
}

bool IndirectRefinement::look(const std::atomic<bool>& cancel) {
    const float epsilon = world_.epsilon();
    const std::vector<EdgeRefinement::Edge>& edges = edges_.edges();
    const auto gather_at = [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i) {
            if (i < edges.size()) {
                const EdgeRefinement::Place middle = edges_.middle(edges[i], epsilon);
                seen_[i] = gather(middle.origin, middle.normal);
            } else {
                const std::uint32_t v = corners_[i - edges.size()];
                seen_[i] = gather(origins_[v], mesh_.vertices[v].normal);
            }
        }
    };
    return run_slice(cursor_, static_cast<std::uint32_t>(seen_.size()), 16, cancel, gather_at);
}

} // namespace lueur
