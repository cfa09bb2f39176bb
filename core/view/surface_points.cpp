#include "core/view/surface_points.h"

#include <random>

#include "core/solve/solution_state.h"

namespace lueur {

std::vector<MeasurePoint> surface_points(const Solution& solution, int count, std::uint32_t seed) {
    const Mesh& mesh = solution.state().mesh;
    std::vector<MeasurePoint> points;
    if (mesh.coarse_area.empty()) return points;
    std::mt19937 random(seed);
    std::discrete_distribution<std::uint32_t> element(mesh.coarse_area.begin(), mesh.coarse_area.end());
    std::uniform_real_distribution<float> unit(0, 1);
    for (int tries = 0; tries < 100 * count && static_cast<int>(points.size()) < count; ++tries) {
        const glm::uvec3 v = mesh.nodes[element(random)].vertices;
        float u = unit(random), w = unit(random);
        if (u + w > 1) u = 1 - u, w = 1 - w;
        const glm::vec3 a = mesh.vertices[v.x].position, b = mesh.vertices[v.y].position,
                        c = mesh.vertices[v.z].position;
        const glm::vec3 p = a + u * (b - a) + w * (c - a), n = glm::normalize(glm::cross(b - a, c - a));
        if (solution.world()->closest({p + 1e-5f * n, n}).back_face) continue;
        points.push_back({p, n});
    }
    return points;
}

} // namespace lueur
