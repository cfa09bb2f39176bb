// What estimates of error need of the mesh: nothing here depends on light, so that it is made once a mesh and kept.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/transport/mesh.h"

namespace lueur {

// Elements on both sides of an edge, and how far a field bends over it.
class Bends {
public:
    Bends() = default;
    // Edges of `elements` that two of them share, none of whose four vertices is left out.
    Bends(std::span<const glm::uvec3> elements, const Mesh& mesh, const std::vector<std::uint8_t>& left_out);

    // At each vertex, RMS over the edges around it, of how far the plane of one triangle misses the far corner of its
    // neighbour. A field that is linear has none.
    std::vector<float> at_vertices(std::span<const float> value) const;
    // Squared mean difference to the neighbours.
    std::vector<float> neighbour_differences(std::span<const float> value) const;

private:
    struct Side {
        glm::uvec4 vertices; // the edge's a and b, the far corners c and d
        float u, w, scale;   // d = a + u (b - a) + w (c - a); what a miss there counts
    };
    std::vector<Side> sides_;
    // Edges around each vertex, those that bend and those that only join two vertices.
    std::vector<std::uint32_t> first_side_, side_of_, first_neighbour_, neighbour_of_;
};

struct ErrorMesh {
    // What it was made for.
    std::size_t element_count = 0;
    std::uint32_t level = 0; // vertices at which indirect light is solved, the first ones
    std::vector<std::uint8_t> buried;

    std::vector<float> area; // m^2 of each vertex
    // Of buried vertices that share elements with others: half of what they have of these, as the rest is in the solid.
    std::vector<float> rim_area;
    double seen_area = 0; // of those that are not buried
    Bends fine, coarse;
    std::vector<glm::uvec3> coarse_elements;

    bool at_rim(std::size_t v) const { return rim_area[v] > 0; }
    bool is_of(const Mesh& mesh, std::uint32_t level_now, const std::vector<std::uint8_t>& buried_now) const {
        return element_count == mesh.elements.size() && level == level_now && buried == buried_now;
    }
};

// with_bends: else neither knows how a field bends. buried: all vertices; buried_coarse: those of the level alone.
ErrorMesh make_error_mesh(const Mesh& mesh, std::uint32_t level, std::vector<std::uint8_t> buried,
                          const std::vector<std::uint8_t>& buried_coarse, bool with_bends = true);

} // namespace lueur
