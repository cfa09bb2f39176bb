// Points to measure at: random by area on the lit sides of a scene, not inside solids (of whose hemisphere the rays
// meet black back faces).
#pragma once

#include <vector>

#include "core/view/measure.h"

namespace lueur {

// The solution has a world. The same seed gives the same points. Fewer than asked for, or none, when nearly all of the
// area lies inside solids.
std::vector<MeasurePoint> surface_points(const Solution& solution, int count, std::uint32_t seed);

} // namespace lueur
