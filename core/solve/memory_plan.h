// What a solve by gathering will take of memory, from the scene alone: nothing of it is made.
#pragma once

#include <cstdint>

#include "core/scene/scene.h"

namespace lueur {

struct MemoryPlan {
    // What it is worked out from.
    std::uint64_t vertices = 0, elements = 0; // of the mesh
    std::uint64_t samples = 0;                // places where light is computed
    // Bytes at their most.
    std::uint64_t program = 0; // itself, with its libraries
    std::uint64_t scene = 0;
    std::uint64_t mesh = 0;   // and what is kept of it for the estimate of error
    std::uint64_t world = 0;  // rays' hierarchy of boxes, and the triangles in it
    std::uint64_t direct = 0; // shares of the luminaires at samples
    std::uint64_t rows = 0;   // ends of the gathered rays
    std::uint64_t fields = 0; // light in channels: what is solved, shown and interpolated
    std::uint64_t peak() const;
};

// channels: that the scene is solved in (ChannelField).
MemoryPlan plan_memory(const Scene& scene, int channels);

} // namespace lueur
