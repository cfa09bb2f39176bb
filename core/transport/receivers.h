// Who gathers: coarse vertices that lie close together on one object and look the same way share one row.
//
// Indirect light is smooth; a mug of 200 vertices needs a few receivers, not 200. Vertices of refined walls are further
// apart than a cell and stay receivers of their own. Where direct light is computed at samples of the vertices only,
// the same samples gather.
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

// cell: edge of the cubes, m, in which vertices of one object and side with normals within about 30 degrees are put
// together, if they lie about as deep; buried and free vertices never are.
Receivers make_receivers(const Scene& scene, const Mesh& mesh, const std::vector<std::uint8_t>& buried, float cell);

// One a sample (light_samples.h): rays end at the group that a vertex is in. buried: of the coarse vertices.
Receivers receivers_of(const LightSamples& samples, const std::vector<std::uint8_t>& buried);

// For more vertices behind those that are there (of a mesh that was cut at contacts): each a receiver of its own.
void add_receivers(std::uint32_t vertices, const std::vector<std::uint8_t>& buried, Receivers& receivers);

} // namespace lueur
