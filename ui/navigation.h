// Moving a camera by hand: pure functions of a camera and a movement of the pointer. A mirrored camera (+x drawn to the
// left) moves the way the picture moves under the hand.
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "core/scene/scene.h"

namespace lueur {

struct Bounds {
    glm::dvec3 low{0}, high{0};
    bool empty = true;
    void include(const glm::dvec3& point);
    glm::dvec3 centre() const { return 0.5 * (low + high); }
    double radius() const { return empty ? 1.0 : 0.5 * glm::length(high - low); }
};
Bounds bounds_of(const Geometry& geometry);
Bounds bounds_of(const Geometry& geometry, ObjectIndex object);

// Movements are in shares of the viewport's height, x to the right, y down.
Camera orbited(const Camera& camera, glm::dvec2 movement); // about the target; never over the poles
Camera panned(const Camera& camera, glm::dvec2 movement);  // what lies at the target's depth follows the pointer
Camera dollied(const Camera& camera, double steps,
               double scene_size);                               // > 0: nearer; pushes the target on when it is reached
Camera looked_around(const Camera& camera, glm::dvec2 movement); // about the eye
Camera flown(const Camera& camera, glm::dvec3 right_up_forward); // in metres
Camera framed(const Camera& camera, const Bounds& bounds, double aspect);

// Near and far planes that hold everything in front of the camera.
struct DepthRange {
    double near_plane, far_plane;
};
DepthRange depth_range(const Camera& camera, const Bounds& bounds);

} // namespace lueur
