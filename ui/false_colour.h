// The colours of the unshot-energy view: viridis as a polynomial of degree 6 (after M. Zucker's fit of matplotlib's
// table), dark violet to yellow.
#pragma once

#include <glm/glm.hpp>

namespace lueur {

glm::vec3 false_colour(float t); // 0..1 -> encoded sRGB

inline constexpr float false_colour_decades = 5; // from the top of the scale down

} // namespace lueur
