// Vertices that stand at one place.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace lueur {

// For each vertex a number that it shares with all vertices within `distance` of the first one found there. O(n) by
// hashing into cells.
std::vector<std::uint32_t> weld_positions(const std::vector<Vertex>& vertices, double distance);

} // namespace lueur
