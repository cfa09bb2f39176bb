#include "core/solve/restriction.h"

#include <algorithm>

namespace lueur {

std::vector<float> restrict_direct(const Mesh& mesh, const DirectTransport& direct) {
    const std::size_t emitters = direct.emitter_count();
    std::vector<float> area = vertex_areas(mesh);
    for (std::size_t v = 0; v < area.size(); ++v)
        if (direct.buried()[v]) area[v] = 0;
    std::vector<float> sum(mesh.vertices.size() * emitters);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        direct.add_factors(static_cast<std::uint32_t>(v), area[v], std::span(sum).subspan(v * emitters, emitters));
    // Children give half of what they hold to each parent, latest first.
    for (std::size_t v = area.size(); v-- > mesh.coarse_vertex_count;) {
        for (const std::uint32_t parent : mesh.vertices[v].parents) {
            area[parent] += 0.5f * area[v];
            for (std::size_t l = 0; l < emitters; ++l) sum[parent * emitters + l] += 0.5f * sum[v * emitters + l];
        }
    }
    sum.resize(std::size_t(mesh.coarse_vertex_count) * emitters);
    for (std::size_t v = 0; v < mesh.coarse_vertex_count; ++v)
        for (std::size_t l = 0; l < emitters; ++l)
            sum[v * emitters + l] = area[v] > 0 ? sum[v * emitters + l] / area[v] : 0;
    return sum;
}

void fill_buried(std::span<const glm::uvec3> elements, std::vector<std::uint8_t> buried, ChannelField& values) {
    std::vector<glm::uvec3> mixed; // elements with buried vertices: few
    for (const glm::uvec3& e : elements)
        if (buried[e.x] || buried[e.y] || buried[e.z]) mixed.push_back(e);
    for (int ring = 0; ring < 4 && !mixed.empty(); ++ring) {
        std::vector<std::uint32_t> touched;
        std::vector<std::uint32_t> neighbours(values.count, 0); // of each touched vertex, with repeats
        for (const glm::uvec3& e : mixed)
            for (int k = 0; k < 3; ++k) {
                if (!buried[e[k]]) continue;
                for (int m = 1; m < 3; ++m) {
                    const std::uint32_t other = e[(k + m) % 3];
                    if (buried[other]) continue;
                    if (neighbours[e[k]]++ == 0) {
                        touched.push_back(e[k]);
                        std::fill_n(values[e[k]], values.stride, 0.0f);
                    }
                    for (int c = 0; c < values.stride; ++c) values[e[k]][c] += values[other][c];
                }
            }
        if (touched.empty()) break;
        for (const std::uint32_t v : touched) {
            const float share = 1.0f / static_cast<float>(neighbours[v]);
            for (int c = 0; c < values.stride; ++c) values[v][c] *= share;
            buried[v] = 0;
        }
    }
}

} // namespace lueur
