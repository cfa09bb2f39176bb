// Lengths and axes of files against the scene's metres and Y up.
#pragma once

#include "core/scene/scene.h"

namespace lueur {

double metres_from_length(double length, LengthUnit unit);

// The shortest decimal, in `unit`, that is read as exactly these metres (feet and inches: to the last bit but one): a
// scene saved again and again never drifts.
double length_from_metres(double metres, LengthUnit unit);

// Z up: file (x, y, z) is world (x, z, -y). Directions are points with unit metre.
glm::dvec3 world_from_file(const glm::dvec3& point, LengthUnit unit, UpAxis up);
glm::dvec3 file_from_world(const glm::dvec3& point, LengthUnit unit, UpAxis up);

std::string to_string(LengthUnit unit);
std::string to_string(UpAxis up);

} // namespace lueur
