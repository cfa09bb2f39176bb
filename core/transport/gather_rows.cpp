#include "core/transport/gather_rows.h"

#include "core/transport/sampling.h"

namespace lueur {

namespace {

constexpr int burial_rays = 16;
constexpr int most_back_faces = 4; // a quarter

// One of the three vertices, by interpolation weight, among those that are not buried.
std::uint32_t pick_vertex(const glm::uvec3& v, const Hit& hit, const std::vector<std::uint8_t>& buried, float u) {
    float w[3] = {1 - hit.b1 - hit.b2, hit.b1, hit.b2};
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

} // namespace

void find_buried(const World& world, const Mesh& mesh, const std::vector<glm::vec3>& origins, std::uint32_t first,
                 std::uint32_t last, std::vector<std::uint8_t>& buried) {
    for (std::uint32_t i = first; i < last; ++i) {
        const Frame frame(mesh.vertices[i].normal);
        int back_faces = 0;
        for (std::uint32_t k = 0; k < burial_rays; ++k)
            back_faces += world.closest({origins[i], frame.world(cosine_direction(r2_point(k, {0, 0})))}).back_face;
        buried[i] = back_faces > most_back_faces;
    }
}

GatherPass make_gather_pass(const Mesh& mesh) {
    GatherPass pass;
    pass.ends.assign(std::size_t(mesh.coarse_vertex_count) * rays_per_pass, mesh.coarse_vertex_count);
    return pass;
}

void trace_gather_rays(const World& world, const Mesh& mesh, const std::vector<glm::vec3>& origins,
                       const std::vector<std::uint8_t>& buried, std::uint32_t seed, std::uint32_t pass, std::uint32_t first,
                       std::uint32_t last, GatherPass& out) {
    const std::uint32_t none = mesh.coarse_vertex_count;
    const std::uint32_t key = hash(hash(seed, pass), 0x5bd1e995u); // of the choices of vertices
    for (std::uint32_t i = first; i < last; ++i) {
        std::uint32_t* ends = out.ends.data() + std::size_t(i) * rays_per_pass;
        if (buried[i]) {
            std::fill(ends, ends + rays_per_pass, none);
            continue;
        }
        const Frame frame(mesh.vertices[i].normal);
        const glm::vec2 offset = random_offset(hash(seed, pass % independent_sets), i);
        const std::uint32_t first_point = pass / independent_sets * rays_per_pass;
        for (std::uint32_t k = 0; k < rays_per_pass; ++k) {
            const Hit hit = world.closest({origins[i], frame.world(cosine_direction(r2_point(first_point + k, offset)))});
            ends[k] = none;
            if (hit.element == no_index) continue;
            const float u = unit_float(hash(key, i * rays_per_pass + k));
            const std::uint32_t v = pick_vertex(mesh.nodes[hit.element].vertices, hit, buried, u);
            if (v != no_index) ends[k] = v;
        }
    }
}

double row_sum(const std::vector<GatherPass>& passes, std::uint32_t receiver, std::uint32_t coarse_vertex_count) {
    std::uint64_t hits = 0;
    for (const GatherPass& pass : passes)
        for (int k = 0; k < rays_per_pass; ++k)
            hits += pass.ends[std::size_t(receiver) * rays_per_pass + k] != coarse_vertex_count;
    return passes.empty() ? 0 : double(hits) / (double(passes.size()) * rays_per_pass);
}

} // namespace lueur
