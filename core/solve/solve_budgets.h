// How finely a solution is made: what the mesh, direct light and memory planning agree on.
#pragma once

#include <algorithm>
#include <cstdint>

namespace lueur {

// That direct light may add: the window has to draw them. A quarter of the coarse ones, between these.
inline constexpr std::uint32_t fewest_fine_vertices = 20000, most_fine_vertices = 60000;
constexpr std::uint32_t fine_vertices(std::uint64_t coarse) {
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(coarse / 4, fewest_fine_vertices, most_fine_vertices));
}
inline constexpr double receiver_cell = 0.3; // of the coarse element size: what lies closer shares what is gathered
// Coarse vertices that light is computed at; of meshes of more, it is computed at so many samples (light_samples.h).
inline constexpr std::uint32_t most_samples = 80000;
constexpr bool is_sampled(std::uint64_t coarse) {
    return coarse > most_samples;
}
// That indirect light may add: so many, and a share of the samples.
inline constexpr std::uint32_t contact_vertices = 1000, contact_share = 8;

} // namespace lueur
