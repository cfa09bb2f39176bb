#include "core/scene/frame.h"

#include <cmath>

namespace lueur {

Camera frame_scene(const Geometry& geometry) {
    Camera camera;
    if (geometry.triangles.empty()) return camera;
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::uvec3& t : geometry.triangles)
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 p(geometry.vertices[t[k]].position);
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    const glm::dvec3 centre = (low + high) / 2.0, extent = high - low;
    double volume = 0; // by the divergence theorem; negative where surfaces face inwards
    for (const glm::uvec3& t : geometry.triangles) {
        const glm::dvec3 a = glm::dvec3(geometry.vertices[t.x].position) - centre,
                         b = glm::dvec3(geometry.vertices[t.y].position) - centre,
                         c = glm::dvec3(geometry.vertices[t.z].position) - centre;
        volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    if (volume < -0.5 * extent.x * extent.y * extent.z) {
        const bool along_x = extent.x > extent.z;
        const glm::dvec3 share = along_x ? glm::dvec3(0.45, 0.1, 0.3) : glm::dvec3(0.3, 0.1, 0.45);
        camera.position = centre + share * extent;
        camera.target = centre - glm::dvec3(0.2, 0.1, 0.2) * extent;
        camera.vertical_fov_degrees = 65;
        return camera;
    }
    const double radius = std::max(glm::length(extent) / 2, 1e-6);
    const double distance = radius / std::sin(camera.vertical_fov_degrees / 2 * 3.14159265358979323846 / 180);
    camera.position = centre + distance * glm::normalize(glm::dvec3(0.5, 0.35, 1));
    camera.target = centre;
    return camera;
}

} // namespace lueur
