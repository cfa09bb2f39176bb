// What a hierarchy shows: its leaves read at the vertices of a conforming mesh.
//
// A leaf's irradiance is constant; shown is the mean of the leaves of one surface around each corner, interpolated.
// Where neighbours are cut finer, their corners on a leaf's edge (T-vertices) count as its corners too. The mesh that
// is drawn is bisected until it is nowhere coarser than the leaves: it conforms, so no crack can open between levels.
#pragma once

#include <cstdint>
#include <vector>

#include "core/solve/hierarchy.h"
#include "core/transport/mesh.h"

namespace lueur {

// Cuts elements of `mesh` until none is longer than the leaves it overlaps, or there are `most_vertices`. True when any
// was cut.
bool cut_mesh_to_leaves(const ElementTree& tree, Mesh& mesh, std::uint32_t most_vertices);

// From which corners of which leaf a mesh vertex reads.
struct LeafReading {
    std::uint32_t leaf = no_index;
    std::array<float, 4> weights{};
};
std::vector<LeafReading> read_leaves(const ElementTree& tree, const Mesh& mesh);

// Irradiance at the mesh vertices. Vertices that see leaves inside solids only are set in `buried` and 0.
ChannelField irradiance_at_vertices(const Hierarchy& hierarchy, const std::vector<LeafReading>& readings, int channels,
                                    std::vector<std::uint8_t>& buried);

} // namespace lueur
