// What a hierarchy shows: its leaves read at the vertices of a conforming mesh.
//
// A leaf's irradiance is constant; shown is the mean of the leaves of one surface around each corner, interpolated.
// Where neighbours are cut finer, their corners on a leaf's edge (T-vertices) count as its corners too. The mesh that
// is drawn is bisected until it is nowhere coarser than the leaves: it conforms, so no crack can open between levels.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/solve/hierarchy.h"
#include "core/transport/bisection.h"
#include "core/transport/mesh.h"

namespace lueur {

// From which corners of which leaf a mesh vertex reads.
struct LeafReading {
    std::uint32_t leaf = no_index;
    std::array<float, 4> weights{};
};

// Cuts elements of a copy of a mesh until none is longer than the leaves it overlaps, or there are `most_vertices`;
// then finds which leaf each vertex reads. Each call is a slice, true at the end; the tree may not change in between.
class LeafMesh {
public:
    explicit LeafMesh(const Mesh& mesh)
        : mesh_(mesh)
        , bisection_(mesh_) {}
    LeafMesh(const LeafMesh&) = delete; // bisection_ refers to mesh_
    LeafMesh& operator=(const LeafMesh&) = delete;

    void begin() { node_ = element_ = 0; }
    bool cut(const ElementTree& tree, std::uint32_t most_vertices, const std::atomic<bool>& cancel);
    bool read(const ElementTree& tree, const std::atomic<bool>& cancel);
    const Mesh& mesh() const { return mesh_; }
    const std::vector<LeafReading>& readings() const { return readings_; }

private:
    Mesh mesh_;
    Bisection bisection_;
    std::uint32_t node_ = 0, element_ = 0;
    std::vector<LeafReading> readings_;
};

// Irradiance at the mesh vertices. Vertices that see leaves inside solids only are set in `buried` and 0.
ChannelField irradiance_at_vertices(const Hierarchy& hierarchy, const std::vector<LeafReading>& readings, int channels,
                                    std::vector<std::uint8_t>& buried);

} // namespace lueur
