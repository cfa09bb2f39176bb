#include "ui/navigation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lueur {
namespace {

struct Frame {
    glm::dvec3 right, up, forward; // as seen in the picture: right is right even when mirrored
    double distance;
};

glm::dvec3 axis_of(const Camera& camera) {
    const double length = glm::length(camera.up);
    return length > 1e-12 ? camera.up / length : glm::dvec3(0, 1, 0);
}

glm::dvec3 any_across(const glm::dvec3& direction) {
    const auto other = std::abs(direction.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    return glm::normalize(glm::cross(direction, other));
}

Frame frame_of(const Camera& camera) {
    Frame frame;
    const auto towards = camera.target - camera.position;
    frame.distance = glm::length(towards);
    frame.forward = frame.distance > 1e-12 ? towards / frame.distance : glm::dvec3(0, 0, -1);
    const auto across = glm::cross(frame.forward, axis_of(camera));
    frame.right = glm::length(across) > 1e-9 ? glm::normalize(across) : any_across(frame.forward);
    frame.up = glm::cross(frame.right, frame.forward);
    if (camera.mirrored) frame.right = -frame.right;
    frame.distance = std::max(frame.distance, 1e-6);
    return frame;
}

glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& axis, double angle) { // Rodrigues
    const double c = std::cos(angle), s = std::sin(angle);
    return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1 - c));
}

// The direction turned by the movement: a full height is half a turn. Keeps 1 degree from the poles.
glm::dvec3 turned(const Camera& camera, const glm::dvec3& direction, glm::dvec2 radians) {
    const auto axis = axis_of(camera);
    const double sense = camera.mirrored ? -1 : 1;
    auto level = glm::cross(direction, axis);
    const auto right = glm::length(level) > 1e-9 ? glm::normalize(level) : any_across(direction);
    const double elevation = std::asin(std::clamp(glm::dot(direction, axis), -1.0, 1.0));
    const double limit = 89 * std::numbers::pi / 180;
    const double pitch =
        std::clamp(elevation - radians.y, std::min(-limit, elevation), std::max(limit, elevation)) - elevation;
    return glm::normalize(rotated(rotated(direction, right, pitch), axis, -radians.x * sense));
}

} // namespace

void Bounds::include(const glm::dvec3& point) {
    low = empty ? point : glm::min(low, point);
    high = empty ? point : glm::max(high, point);
    empty = false;
}

Bounds bounds_of(const Geometry& geometry) {
    Bounds bounds;
    for (const auto& triangle : geometry.triangles)
        for (int corner = 0; corner < 3; ++corner) bounds.include(geometry.vertices[triangle[corner]].position);
    return bounds;
}

Bounds bounds_of(const Geometry& geometry, ObjectIndex object) {
    Bounds bounds;
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i)
        if (geometry.surfaces[at(geometry.triangle_surface[i])].object == object)
            for (int corner = 0; corner < 3; ++corner)
                bounds.include(geometry.vertices[geometry.triangles[i][corner]].position);
    return bounds;
}

Camera orbited(const Camera& camera, glm::dvec2 movement) {
    const auto frame = frame_of(camera);
    auto result = camera;
    // The eye goes round the target against the hand, so that the thing turns with it.
    result.position = camera.target - frame.distance * turned(camera, frame.forward, std::numbers::pi * movement);
    return result;
}

Camera panned(const Camera& camera, glm::dvec2 movement) {
    const auto frame = frame_of(camera);
    const double height = 2 * frame.distance * std::tan(0.5 * camera.vertical_fov_degrees * std::numbers::pi / 180);
    const auto shift = height * (-movement.x * frame.right + movement.y * frame.up);
    auto result = camera;
    result.position += shift;
    result.target += shift;
    return result;
}

Camera dollied(const Camera& camera, double steps, double scene_size) {
    const auto frame = frame_of(camera);
    const double nearest = 0.02 * scene_size;
    double distance = frame.distance * std::pow(0.88, steps);
    auto result = camera;
    result.position = camera.target - distance * frame.forward;
    if (distance < nearest) result.target = result.position + nearest * frame.forward;
    return result;
}

Camera looked_around(const Camera& camera, glm::dvec2 movement) {
    const auto frame = frame_of(camera);
    auto result = camera;
    const double turn = camera.vertical_fov_degrees * std::numbers::pi / 180;
    result.target = camera.position + frame.distance * turned(camera, frame.forward, turn * movement);
    return result;
}

Camera flown(const Camera& camera, glm::dvec3 movement) {
    const auto frame = frame_of(camera);
    const auto shift = movement.x * frame.right + movement.y * axis_of(camera) + movement.z * frame.forward;
    auto result = camera;
    result.position += shift;
    result.target += shift;
    return result;
}

Camera framed(const Camera& camera, const Bounds& bounds, double aspect) {
    if (bounds.empty) return camera;
    const auto frame = frame_of(camera);
    const double half_vertical = 0.5 * camera.vertical_fov_degrees * std::numbers::pi / 180;
    const double half = std::min(half_vertical, std::atan(std::tan(half_vertical) * std::max(aspect, 1e-3)));
    auto result = camera;
    result.target = bounds.centre();
    result.position = result.target - frame.forward * (std::max(bounds.radius(), 1e-3) * 1.05 / std::sin(half));
    return result;
}

DepthRange depth_range(const Camera& camera, const Bounds& bounds) {
    const double radius = std::max(bounds.radius(), 1e-3);
    const double reach = glm::length(bounds.centre() - camera.position) + radius;
    const double nearest = std::max(glm::length(bounds.centre() - camera.position) - radius, 0.0);
    const double far_plane = 1.01 * reach;
    return {std::max(0.99 * nearest, 2e-4 * far_plane), far_plane};
}

} // namespace lueur
