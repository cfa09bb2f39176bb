// How finely a solution is made: what the mesh, direct light and memory planning agree on.
#pragma once

#include <cstdint>

namespace lueur {

inline constexpr std::uint32_t fine_vertices = 20000; // that direct light may add: the window has to draw them
inline constexpr double sample_cell = 0.3;            // of the coarse element size: what lies closer shares its light
inline constexpr std::uint32_t most_samples = 40000;  // of the coarse mesh (light_samples.h)
// That indirect light may add: so many, and a share of the samples.
inline constexpr std::uint32_t contact_vertices = 1000, contact_share = 8;

} // namespace lueur
