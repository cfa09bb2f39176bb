#include "core/solve/hierarchy_field.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr std::uint32_t nodes_a_look = 64; // at the clock

struct Box {
    glm::vec3 low{1e30f}, high{-1e30f};
    void add(glm::vec3 p) { low = glm::min(low, p), high = glm::max(high, p); }
    // More than touch. Both may be flat in the same axis.
    bool meets(const Box& other, float tolerance) const {
        for (int k = 0; k < 3; ++k) {
            const float overlap = std::min(high[k], other.high[k]) - std::max(low[k], other.low[k]);
            if (overlap < -tolerance) return false;
            const bool flat = high[k] - low[k] < 4 * tolerance || other.high[k] - other.low[k] < 4 * tolerance;
            if (!flat && overlap < tolerance) return false;
        }
        return true;
    }
};

std::uint32_t root_of(const ElementTree& tree, const Mesh& mesh, std::uint32_t coarse) {
    return tree.root_of_triangle[mesh.coarse_triangle[coarse]][mesh.coarse_back[coarse]];
}

// The radius of the smallest leaf that a mesh element's box meets.
float smallest_leaf(const ElementTree& tree, std::uint32_t n, const Box& box, float tolerance) {
    const ElementNode& node = tree.nodes[n];
    Box own;
    for (const std::uint32_t c : node.corners)
        if (c != no_index) own.add(tree.vertices[c]);
    if (!own.meets(box, tolerance)) return 1e30f;
    if (node.is_leaf()) return node.radius;
    float smallest = 1e30f;
    for (const std::uint32_t child : node.children)
        smallest = std::min(smallest, smallest_leaf(tree, child, box, tolerance));
    return smallest;
}

} // namespace

bool LeafMesh::cut(const ElementTree& tree, std::uint32_t most_vertices, const std::atomic<bool>& cancel) {
    TimeSlice slice(cancel, nodes_a_look);
    while (node_ < mesh_.nodes.size()) { // grows while it runs
        const std::uint32_t n = node_++;
        const std::uint32_t root = root_of(tree, mesh_, mesh_.nodes[n].coarse);
        if (root == no_index || tree.nodes[root].is_leaf()) continue;
        while (mesh_.nodes[n].children == no_index && mesh_.vertices.size() < most_vertices) {
            const glm::uvec3 v = mesh_.nodes[n].vertices;
            const int edge = bisection_.longest_edge(n);
            const float longest = std::sqrt(bisection_.edge_length(v[edge], v[(edge + 1) % 3]));
            Box box;
            for (int k = 0; k < 3; ++k) box.add(mesh_.vertices[v[k]].position);
            if (longest <= 2.02f * smallest_leaf(tree, root, box, 1e-4f * longest)) break;
            bisection_.split(n);
        }
        if (slice.over() && node_ < mesh_.nodes.size()) return false;
    }
    list_leaves(mesh_);
    return true;
}

bool LeafMesh::read(const ElementTree& tree, const std::atomic<bool>& cancel) {
    if (element_ == 0) readings_.assign(mesh_.vertices.size(), {});
    TimeSlice slice(cancel, nodes_a_look);
    while (element_ < mesh_.elements.size()) {
        const std::uint32_t e = element_++;
        const glm::uvec3 v = mesh_.elements[e];
        const std::uint32_t root = root_of(tree, mesh_, mesh_.element_coarse[e]);
        if (root == no_index) continue;
        const glm::vec3 centre =
            (mesh_.vertices[v.x].position + mesh_.vertices[v.y].position + mesh_.vertices[v.z].position) / 3.0f;
        for (int k = 0; k < 3; ++k) {
            // Of the leaves around a vertex the smallest: of a T-vertex that is one of which it is a corner.
            const glm::vec3 p = mesh_.vertices[v[k]].position;
            const std::uint32_t leaf = leaf_under(tree, root, p + 0.01f * (centre - p));
            LeafReading& reading = readings_[v[k]];
            if (reading.leaf != no_index && tree.nodes[reading.leaf].radius <= tree.nodes[leaf].radius) continue;
            reading.leaf = leaf;
            reading.weights = corner_weights(tree, leaf, p);
        }
        if (slice.over()) return element_ >= mesh_.elements.size();
    }
    return true;
}

ChannelField irradiance_at_vertices(const Hierarchy& hierarchy, const std::vector<LeafReading>& readings, int channels,
                                    std::vector<std::uint8_t>& buried) {
    const ElementTree& tree = hierarchy.tree();
    const ChannelField& leaves = hierarchy.irradiance();
    ChannelField corners(static_cast<std::uint32_t>(tree.vertices.size()), channels);
    std::vector<float> weight(tree.vertices.size(), 0);
    std::vector<std::uint32_t> around;
    for (std::uint32_t n = 0; n < leaves.count; ++n) {
        const ElementNode& node = tree.nodes[n];
        if (!node.is_leaf() || node.is_cluster() || hierarchy.buried(n)) continue;
        const std::size_t count = node.shape == ElementShape::quadrilateral ? 4 : 3;
        around.clear();
        for (std::size_t k = 0; k < count; ++k) {
            around.push_back(node.corners[k]);
            vertices_on_edge(tree, node.corners[k], node.corners[(k + 1) % count], around);
        }
        for (const std::uint32_t v : around) {
            const float w = 1 / (glm::distance(tree.vertices[v], node.centre) + 1e-9f);
            weight[v] += w;
            for (int c = 0; c < channels; ++c) corners[v][c] += w * leaves[n][c] * hierarchy.scale(n);
        }
    }
    ChannelField field(static_cast<std::uint32_t>(readings.size()), channels);
    buried.assign(readings.size(), 0);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, readings.size(), 256), [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t v = range.begin(); v < range.end(); ++v) {
                const LeafReading& reading = readings[v];
                if (reading.leaf == no_index) continue;
                const ElementNode& node = tree.nodes[reading.leaf];
                const bool dead = hierarchy.buried(reading.leaf);
                float sum = 0;
                float* out = field[static_cast<std::uint32_t>(v)];
                for (std::size_t k = 0; k < 4; ++k) {
                    const std::uint32_t corner = node.corners[k];
                    if (corner == no_index || reading.weights[k] <= 0) continue;
                    const bool lit = weight[corner] > 0;
                    if (!lit && dead) continue;
                    sum += reading.weights[k];
                    const float* from = lit ? corners[corner] : leaves[reading.leaf];
                    const float w = reading.weights[k] * (lit ? 1 / weight[corner] : hierarchy.scale(reading.leaf));
                    for (int c = 0; c < channels; ++c) out[c] += w * from[c];
                }
                if (sum <= 0) {
                    buried[v] = 1;
                    continue;
                }
                for (int c = 0; c < channels; ++c) out[c] /= sum;
            }
        });
    return field;
}

} // namespace lueur
