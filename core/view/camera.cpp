#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "core/view/picture.h"

namespace lueur {

namespace {

struct CameraAxes {
    glm::dvec3 forward, right, up;
};

CameraAxes camera_axes(const Camera& camera) {
    glm::dvec3 forward = camera.target - camera.position;
    forward = glm::dot(forward, forward) > 0 ? glm::normalize(forward) : glm::dvec3(0, 0, -1);
    glm::dvec3 right = glm::cross(forward, camera.up);
    if (glm::dot(right, right) < 1e-12) // looking along up: any horizontal axis does
        right = glm::cross(forward, std::abs(forward.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1));
    right = glm::normalize(right);
    return {forward, camera.mirrored ? -right : right, glm::cross(right, forward)};
}

} // namespace

Ray camera_ray(const Camera& camera, double aspect, double x, double y) {
    const CameraAxes axes = camera_axes(camera);
    const double half = std::tan(camera.vertical_fov_degrees * std::numbers::pi / 360);
    const glm::dvec3 direction = axes.forward + (2 * x - 1) * aspect * half * axes.right + (1 - 2 * y) * half * axes.up;
    return {glm::vec3(camera.position), glm::vec3(glm::normalize(direction)), 0, 1e30f};
}

glm::dmat4 clip_from_world(const Camera& camera, double aspect, double near_plane, double far_plane) {
    const CameraAxes axes = camera_axes(camera);
    glm::dmat4 eye_from_world(1);
    for (int k = 0; k < 3; ++k) {
        eye_from_world[k][0] = axes.right[k];
        eye_from_world[k][1] = axes.up[k];
        eye_from_world[k][2] = -axes.forward[k];
    }
    eye_from_world[3] = glm::dvec4(-glm::dot(axes.right, camera.position), -glm::dot(axes.up, camera.position),
                                   glm::dot(axes.forward, camera.position), 1);
    return glm::perspective(camera.vertical_fov_degrees * std::numbers::pi / 180, aspect, near_plane, far_plane) *
           eye_from_world;
}

} // namespace lueur
