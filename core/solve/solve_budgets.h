// How finely a solution is made: what the mesh, direct light and memory planning agree on.
#pragma once

#include <algorithm>
#include <cstdint>

namespace lueur {

// Meshes of more coarse vertices have more shadows and contacts than there is room for vertices at: it is kept for the
// finer levels of what is worth most, and more of it is given to contacts.
constexpr bool is_crowded(std::uint64_t coarse) {
    return coarse > 30000;
}
// Rows of direct light times luminaires: where there are more, indirect light is first solved for a guess of the
// direct.
inline constexpr std::uint64_t most_lit_first = 300000;
inline constexpr double receiver_cell = 0.3; // of the coarse element size: what lies closer shares what is gathered
// Coarse vertices that light is computed at; of meshes of more, it is computed at so many samples (light_samples.h).
inline constexpr std::uint32_t most_samples = 80000;
constexpr bool is_sampled(std::uint64_t coarse) {
    return coarse > most_samples;
}
// That direct light may add, with those of indirect light: the window has to draw them. More where all else is drawn
// too.
inline constexpr std::uint32_t most_fine_vertices = 20000, most_fine_vertices_of_sampled = 40000;
constexpr std::uint32_t fine_vertices(std::uint64_t coarse) {
    return is_sampled(coarse) ? most_fine_vertices_of_sampled : most_fine_vertices;
}
// That indirect light may add: so many, and a share of the receivers.
constexpr std::uint32_t contact_vertices(std::uint64_t coarse, std::uint32_t receivers) {
    return 1000 + receivers / (is_crowded(coarse) ? 3 : 8);
}

} // namespace lueur
