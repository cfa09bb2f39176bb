// Who gathers: the samples of the coarse mesh (light_samples.h), and the vertices that are added at contacts. Rays end
// at the group that a vertex is in.
#pragma once

#include <cstdint>
#include <vector>

#include "core/transport/light_samples.h"
#include "core/transport/mesh.h"

namespace lueur {

struct Receivers {
    std::vector<std::uint32_t> of_vertex; // of each vertex of the level of indirect light
    std::vector<std::uint32_t> vertex;    // of each receiver: the vertex whose rays stand for all
    std::vector<std::uint8_t> buried;     // of each receiver
    std::uint32_t count() const { return static_cast<std::uint32_t>(vertex.size()); }
};

// One a sample; buried: of the coarse vertices.
Receivers receivers_of(const LightSamples& samples, const std::vector<std::uint8_t>& buried);

// For more vertices behind those that are there (of a mesh that was cut at contacts): each a receiver of its own.
void add_receivers(std::uint32_t vertices, const std::vector<std::uint8_t>& buried, Receivers& receivers);

} // namespace lueur
