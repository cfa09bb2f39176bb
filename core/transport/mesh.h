// Surfaces cut into elements: a conforming triangle mesh for each surface, refined by bisecting longest edges (Rivara
// 1984), so that there are no T-vertices inside a surface and a coarse field is read on the fine mesh without loss.
//
// Two levels live in one mesh. Coarse vertices come first: indirect light is solved there. Bisecting coarse elements
// further gives the fine vertices, where direct light is kept. A fine vertex is the midpoint of two earlier ones (its
// parents), so that a field on coarse vertices is prolonged by averaging parents, in order. Two-sided surfaces appear
// twice, once a side.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "core/scene/scene.h"

namespace lueur {

inline constexpr std::uint32_t no_index = 0xffffffffu;

struct MeshVertex {
    glm::vec3 position; // m
    glm::vec3 normal;   // unit, towards the lit side
    glm::vec2 uv;
    std::uint32_t surface; // SurfaceIndex
    bool back = false;     // of the back side of a two-sided surface
    std::array<std::uint32_t, 2> parents{no_index, no_index};
};

// An element or what it was cut from. Nodes 0..coarse_element_count-1 are the coarse elements.
struct MeshNode {
    glm::uvec3 vertices;               // counter-clockwise from the lit side
    std::uint32_t coarse;              // the coarse element it is, or is part of
    std::uint32_t children = no_index; // first of two, next to each other; no_index: a leaf
    std::uint8_t split_edge = 0;       // edge k runs from vertex k to vertex k+1
};

// The scene's triangles and how they were cut into coarse elements: rays meet few large triangles and then go down to
// the element. The first `count` nodes are the triangles themselves.
struct TriangleTree {
    struct Node {
        glm::uvec3 vertices;               // of the mesh
        std::uint32_t children = no_index; // as MeshNode's; no_index: a leaf
        std::uint32_t element = no_index;  // of a leaf: the coarse element
        std::uint8_t split_edge = 0;
    };
    std::vector<Node> nodes;
    std::uint32_t count = 0;
};

// Goes down from a triangle to the coarse element under a point of it; b1, b2 become the element's.
std::uint32_t coarse_element_at(const TriangleTree& tree, std::uint32_t triangle, float& b1, float& b2);

struct Mesh {
    std::vector<MeshVertex> vertices;
    std::vector<MeshNode> nodes;
    std::uint32_t coarse_vertex_count = 0;
    std::uint32_t coarse_element_count = 0;

    // Where indirect light is gathered: the coarse level, and what cuts it at contacts (indirect_refinement.h). Its
    // vertices and nodes are the first ones.
    std::uint32_t indirect_vertex_count = 0, indirect_node_count = 0;
    std::vector<glm::uvec3> indirect_elements;

    std::vector<std::uint32_t> coarse_surface; // of each coarse element: SurfaceIndex
    std::vector<std::uint8_t> coarse_back;     // 1: the back side of a two-sided surface
    std::vector<std::uint32_t>
        coarse_twin;                // the element of the other side, vertices 2 and 3 swapped; no_index: one-sided
    std::vector<float> coarse_area; // m^2
    std::vector<std::uint32_t> coarse_triangle; // which of the scene's triangles (degenerate ones not counted) it is of
    std::shared_ptr<const TriangleTree> triangles;

    // Patches, which shoot as one: neighbouring coarse elements cut from the same triangle (elements receive, larger
    // patches shoot: Cohen, Greenberg, Immel & Brock 1986).
    std::vector<std::uint32_t> coarse_patch; // of each coarse element
    std::vector<glm::uvec3> patches;         // corners: coarse vertices, counter-clockwise from the lit side

    // The leaves, which are drawn and interpolated.
    std::vector<glm::uvec3> elements;
    std::vector<std::uint32_t> element_coarse;
    std::vector<std::uint32_t> element_surface;
    std::vector<std::uint8_t> element_back;
};

struct MeshParams {
    double element_size = 0; // longest coarse edge, m; 0: from the area and the number of triangles
};

Mesh make_mesh(const Scene& scene, const MeshParams& params);
double automatic_element_size(const Scene& scene);

// The leaf under a point of a coarse element and the weights of its three vertices there (sum 1).
struct Located {
    glm::uvec3 vertices;
    glm::vec3 weights;
};
Located locate(const Mesh& mesh, std::uint32_t coarse_element, float b1, float b2);
// The same on the level that has so many vertices: the coarse one, that of indirect light, or that of the leaves.
Located locate_on_level(const Mesh& mesh, std::uint32_t vertices, std::uint32_t coarse_element, float b1, float b2);

// On the level of indirect light and on that of the leaves.
struct LocatedTwice {
    Located indirect, fine;
};
LocatedTwice locate_twice(const Mesh& mesh, std::uint32_t coarse_element, float b1, float b2);

// The elements of the level that has so many vertices: the coarse one or that of indirect light.
std::vector<glm::uvec3> elements_of_level(const Mesh& mesh, std::uint32_t vertices);

// Where rays of a point of a surface start: moved a little towards `inward`, the middle of the elements around it, and
// lifted off the surface by epsilon and by what a curved surface may bend away.
glm::vec3 ray_origin(glm::vec3 position, glm::vec3 normal, glm::vec3 inward, float epsilon);

// Where rays of a vertex start: moved a little into its elements (a vertex on a corner lies in the next wall) and off
// its surface.
std::vector<glm::vec3> ray_origins(const Mesh& mesh, float epsilon);

// Area that belongs to each vertex of the fine mesh: a third of its elements, m^2.
std::vector<float> vertex_areas(const Mesh& mesh);
std::vector<float> vertex_areas(const Mesh& mesh, std::span<const glm::uvec3> elements, std::uint32_t vertices);

} // namespace lueur
