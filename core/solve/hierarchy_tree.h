// The hierarchy of elements: quadtrees over the scene's surfaces, and clusters over those.
//
// A root is a triangle of the scene, or two that make a convex planar quadrilateral (a wall). It is cut into four along
// the middles of its edges (Hanrahan, Salzman & Aupperle 1991). Above the roots stand clusters (Smits, Arvo & Greenberg
// 1994; Sillion 1995): roots of an object that look the same way, halved in space, then the objects. So a scene of
// 60,000 triangles exchanges light between few nodes. A two-sided surface has roots on both sides.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include "core/transport/mesh.h"

namespace lueur {

enum class ElementShape : std::uint8_t { triangle, quadrilateral, cluster };

struct ElementNode {
    std::uint32_t parent = no_index;
    std::array<std::uint32_t, 4> children{no_index, no_index, no_index, no_index}; // clusters have two
    std::array<std::uint32_t, 4> corners{no_index, no_index, no_index, no_index};  // tree vertices, from the lit side
    glm::vec3 centre{0}, normal{0}; // of a cluster: of its box; mean by area, zero where all cancels
    float area = 0;                 // m^2, of all its surfaces
    float live_share = 1;           // of its area that does not lie inside solids
    float radius = 0;               // m, of a sphere around the centre
    float flatness = 1;             // least cosine between a member's normal and the mean
    std::uint32_t surface = no_index;
    std::uint32_t first_root = 0, root_count = 0; // of a cluster: in ElementTree::root_order
    std::uint16_t level = 0;                      // cuts below its root
    ElementShape shape = ElementShape::triangle;
    bool back = false;   // of the back side of a two-sided surface
    bool closed = false; // whatever way it looks, it sees a lit side
    bool is_leaf() const { return children[0] == no_index; }
    bool is_cluster() const { return shape == ElementShape::cluster; }
    float live_area() const { return area * live_share; }
};

struct ElementTree {
    std::vector<glm::vec3> vertices;
    std::vector<ElementNode> nodes; // roots, then clusters, then what roots were cut into
    std::uint32_t root_count = 0, cluster_count = 0;
    std::uint32_t top = no_index;                               // the cluster over all; none: no_index
    std::vector<std::array<std::uint32_t, 2>> root_of_triangle; // of a scene triangle: front and back root
    std::vector<std::uint32_t> root_order;                      // so that a cluster's roots stand together
    std::vector<double> root_area_before; // running sum of areas in that order, one more than roots
    std::unordered_map<std::uint64_t, std::uint32_t> edge_middle; // of an edge between two vertices

    // Node i of all, parents before their children: clusters, roots, what those were cut into.
    std::uint32_t parents_first(std::size_t i) const {
        const auto n = static_cast<std::uint32_t>(i);
        if (n < cluster_count) return root_count + n;
        return n < root_count + cluster_count ? n - cluster_count : n;
    }
    std::uint32_t children_first(std::size_t i) const { return parents_first(nodes.size() - 1 - i); }
};

ElementTree make_element_tree(const Scene& scene, bool clusters);

// Cuts a leaf that is not a cluster into four. Its corners are children's corners; middles of edges are shared with the
// neighbours of the same surface.
void cut_element(ElementTree& tree, std::uint32_t node);

// The leaf of a root's quadtree under a point of its plane.
std::uint32_t leaf_under(const ElementTree& tree, std::uint32_t root, glm::vec3 point);

struct SurfacePoint {
    glm::vec3 position, normal;
    glm::vec3 inward; // the middle of the element it lies on
};
// A point of an element or cluster, uniform by area, for u in the unit square.
SurfacePoint point_on(const ElementTree& tree, std::uint32_t node, glm::vec2 u);

// Weights of an element's corners at a point of it: barycentric, or bilinear in a quadrilateral. They sum to 1.
std::array<float, 4> corner_weights(const ElementTree& tree, std::uint32_t node, glm::vec3 point);

// The vertices of neighbours that lie on the edge from a to b, in order: where a neighbour is cut finer, its corners
// are T-vertices of this element.
void vertices_on_edge(const ElementTree& tree, std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& between);

} // namespace lueur
