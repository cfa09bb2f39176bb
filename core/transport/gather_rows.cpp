#include "core/transport/gather_rows.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/transport/sampling.h"

namespace lueur {

namespace {

constexpr std::uint32_t most_back_faces = 4; // a quarter

// One of three vertices, by interpolation weight, among those that are not buried.
std::uint32_t pick_vertex(const glm::uvec3& v, glm::vec3 w, const std::vector<std::uint8_t>& buried, float u) {
    float sum = 0;
    for (int k = 0; k < 3; ++k) {
        if (buried[v[k]] || w[k] < 0) w[k] = 0;
        sum += w[k];
    }
    if (!(sum > 0)) return no_index;
    u *= sum;
    for (int k = 0; k < 2; ++k) {
        if (u < w[k]) return v[k];
        u -= w[k];
    }
    return w[2] > 0 ? v[2] : (w[1] > 0 ? v[1] : v[0]);
}

// Every so many rays, hits may be known or not.
constexpr std::uint32_t rays_at_once = burial_rays;
static_assert(rays_per_pass % rays_at_once == 0);

using Hits = std::array<Hit, rays_at_once>;

// Rays from number `first` of a sequence on.
Hits trace_from(const World& world, glm::vec3 origin, glm::vec3 normal, glm::vec2 offset, std::uint32_t first) {
    std::array<glm::vec3, rays_at_once> directions;
    Hits hits;
    const Frame frame(normal);
    for (std::uint32_t k = 0; k < rays_at_once; ++k)
        directions[k] = frame.world(cosine_direction(r2_point(first + k, offset)));
    world.closest(origin, directions, hits);
    return hits;
}

// Of a vertex, in the sequence of one set.
glm::vec2 offset_of(std::uint32_t vertex, std::uint32_t seed, std::uint32_t set) {
    return random_offset(hash(seed, set), vertex);
}

void keep(const Hits& hits, RayHit* out) {
    for (const Hit& hit : hits) *out++ = {hit.element, hit.b1, hit.b2};
}

std::uint32_t back_faces_of(const Hits& hits) {
    return static_cast<std::uint32_t>(std::ranges::count_if(hits, &Hit::back_face));
}

// To what is around, harmonic mean, m.
float distance_of(const Hits& hits) {
    float nearness = 0;
    for (const Hit& hit : hits)
        if (hit.any()) nearness += 1 / std::max(hit.t, 1e-20f);
    return nearness > 0 ? burial_rays / nearness : 1e30f;
}

} // namespace

void find_buried(const World& world, const Mesh& mesh, const std::vector<glm::vec3>& origins, std::uint32_t seed,
                 std::uint32_t first, std::uint32_t last, std::vector<std::uint8_t>& buried, Surroundings* around) {
    for (std::uint32_t i = first; i < last; ++i) {
        const Hits hits = trace_from(world, origins[i], mesh.vertices[i].normal, offset_of(i, seed, 0), 0);
        const std::uint32_t back_faces = back_faces_of(hits);
        buried[i] = back_faces > most_back_faces;
        if (!around) continue;
        around->back[i] = static_cast<std::uint8_t>(back_faces);
        around->lit[i] = static_cast<std::uint8_t>(
            std::ranges::count_if(hits, [](const Hit& hit) { return hit.element != no_index; }));
        around->near[i] = static_cast<std::uint8_t>(
            std::ranges::count_if(hits, [&](const Hit& hit) { return hit.any() && hit.t < around->near_distance; }));
        around->distance[i] = distance_of(hits);
        if (!around->hits.empty()) keep(hits, around->hits.data() + std::size_t(i) * burial_rays);
    }
}

LookAround look_around(const World& world, glm::vec3 origin, glm::vec3 normal) {
    const Hits hits = trace_from(world, origin, normal, {0, 0}, 0);
    return {back_faces_of(hits) > most_back_faces, distance_of(hits)};
}

std::vector<RayHit> hits_of_burial(const Receivers& receivers, const std::vector<RayHit>& hits) {
    std::vector<RayHit> of_pass(std::size_t(receivers.count()) * rays_per_pass);
    for (std::size_t i = 0; i < receivers.count() && !hits.empty(); ++i)
        std::copy_n(hits.begin() + std::ptrdiff_t(receivers.vertex[i] * burial_rays), burial_rays,
                    of_pass.begin() + std::ptrdiff_t(i * rays_per_pass));
    return of_pass;
}

GatherPass make_gather_pass(const Mesh& mesh, const Receivers& receivers, std::vector<RayHit> hits) {
    const std::size_t rays = std::size_t(receivers.count()) * rays_per_pass;
    const std::uint32_t vertices = static_cast<std::uint32_t>(mesh.vertices.size());
    return {std::vector<std::uint32_t>(rays, receivers.count()), std::vector<std::uint32_t>(rays, vertices), vertices,
            std::move(hits)};
}

std::uint64_t trace_gather_rays(const World& world, const Mesh& mesh, const std::vector<glm::vec3>& origins,
                                const Receivers& receivers, const std::vector<std::uint8_t>& buried, std::uint32_t seed,
                                std::uint32_t pass, std::uint32_t first, std::uint32_t last, GatherPass& out) {
    const std::uint32_t key = hash(hash(seed, pass), 0x5bd1e995u); // of the choices of vertices
    const std::uint32_t first_point = pass / independent_sets * rays_per_pass;
    const std::size_t known = out.hits.size() / rays_per_pass;
    std::uint64_t traced = 0;
    std::array<RayHit, rays_per_pass> fresh;
    for (std::uint32_t i = first; i < last; ++i) {
        if (receivers.buried[i]) continue; // all its rays stay outside
        const std::uint32_t vertex = receivers.vertex[i];
        const std::size_t row = std::size_t(i) * rays_per_pass;
        RayHit* hits = i < known ? out.hits.data() + row : fresh.data();
        for (std::uint32_t k = 0; k < rays_per_pass; k += rays_at_once) {
            if (i < known && hits[k].element != RayHit::untraced) continue;
            keep(trace_from(world, origins[vertex], mesh.vertices[vertex].normal,
                            offset_of(vertex, seed, pass % independent_sets), first_point + k),
                 hits + k);
            traced += rays_at_once;
        }
        for (std::size_t k = 0; k < rays_per_pass; ++k) {
            if (hits[k].element == no_index) continue;
            const std::uint32_t bits = hash(key, static_cast<std::uint32_t>(row + k));
            const auto [indirect, fine] = locate_twice(mesh, hits[k].element, hits[k].b1, hits[k].b2);
            const std::uint32_t end = pick_vertex(indirect.vertices, indirect.weights, buried, unit_float(bits));
            if (end != no_index) out.ends[row + k] = receivers.of_vertex[end];
            const std::uint32_t fine_end = pick_vertex(fine.vertices, fine.weights, buried, unit_float(hash(bits)));
            if (fine_end != no_index) out.fine_ends[row + k] = fine_end;
        }
    }
    return traced;
}

double row_sum(const std::vector<GatherPass>& passes, std::uint32_t receiver, std::uint32_t receivers) {
    std::uint64_t hits = 0;
    for (const GatherPass& pass : passes)
        for (int k = 0; k < rays_per_pass; ++k)
            hits += pass.ends[std::size_t(receiver) * rays_per_pass + k] != receivers;
    return passes.empty() ? 0 : double(hits) / (double(passes.size()) * rays_per_pass);
}

} // namespace lueur
