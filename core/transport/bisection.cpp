#include "core/transport/bisection.h"

#include "core/transport/time_slice.h"

namespace lueur {

Bisection::Bisection(Mesh& mesh)
    : Bisection(mesh, adopts_later) {
    const std::atomic<bool> never{false};
    while (!adopt(never)) {
    }
}

Bisection::Bisection(Mesh& mesh, AdoptsLater)
    : mesh_(mesh) {
    std::size_t leaves = 0;
    for (const MeshNode& node : mesh.nodes) leaves += node.children == no_index;
    edge_leaves_.reserve(leaves * 2); // at most three halves, and what is split
}

bool Bisection::adopt(const std::atomic<bool>& cancel) {
    if (!adopts_) return true;
    TimeSlice slice(cancel, 256);
    for (; adopted_ < mesh_.nodes.size(); ++adopted_) {
        if (slice.over()) return false;
        if (mesh_.nodes[adopted_].children == no_index) attach(adopted_);
    }
    adopts_ = false;
    return true;
}

void Bisection::attach(std::uint32_t node) {
    const glm::uvec3 v = mesh_.nodes[node].vertices;
    for (int k = 0; k < 3; ++k) {
        auto& leaves = edge_leaves_.at(edge_key(v[k], v[(k + 1) % 3]));
        // A third leaf at an edge keeps its place with its first neighbour only.
        (leaves[0] == no_index ? leaves[0] : leaves[1]) = node;
    }
}

void Bisection::detach(std::uint32_t node) {
    const glm::uvec3 v = mesh_.nodes[node].vertices;
    for (int k = 0; k < 3; ++k) {
        auto& leaves = edge_leaves_.at(edge_key(v[k], v[(k + 1) % 3]));
        if (leaves[0] == node)
            leaves[0] = leaves[1], leaves[1] = no_index;
        else if (leaves[1] == node)
            leaves[1] = no_index;
    }
}

std::uint32_t Bisection::neighbour(std::uint32_t node, int edge) const {
    const glm::uvec3 v = mesh_.nodes[node].vertices;
    const auto leaves = edge_leaves_.find(edge_key(v[edge], v[(edge + 1) % 3]));
    return leaves[0] == node ? leaves[1] : leaves[0];
}

float Bisection::edge_length(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
    // In one order for both elements at the edge, so that they agree to the last bit.
    const glm::vec3 d = mesh.vertices[std::max(a, b)].position - mesh.vertices[std::min(a, b)].position;
    return glm::dot(d, d);
}

int Bisection::longest_edge(const Mesh& mesh, std::uint32_t node) {
    // Equal lengths are told apart by vertex number: the order of edges is total, so chains of ever longer edges end.
    const glm::uvec3 v = mesh.nodes[node].vertices;
    int best = 0;
    float best_length = -1;
    std::uint64_t best_key = 0;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = v[k], b = v[(k + 1) % 3];
        const float length = edge_length(mesh, a, b);
        const std::uint64_t key = edge_key(a, b);
        if (length > best_length || (length == best_length && key > best_key))
            best = k, best_length = length, best_key = key;
    }
    return best;
}

void Bisection::bisect(std::uint32_t node, int edge, std::uint32_t midpoint) {
    detach(node);
    const std::uint32_t first = static_cast<std::uint32_t>(mesh_.nodes.size());
    mesh_.nodes[node].children = first;
    mesh_.nodes[node].split_edge = static_cast<std::uint8_t>(edge);
    const glm::uvec3 v = mesh_.nodes[node].vertices;
    const std::uint32_t coarse = mesh_.nodes[node].coarse;
    const std::uint32_t a = v[edge], b = v[(edge + 1) % 3], c = v[(edge + 2) % 3];
    mesh_.nodes.push_back({{a, midpoint, c}, coarse});
    mesh_.nodes.push_back({{midpoint, b, c}, coarse});
    attach(first);
    attach(first + 1);
}

void Bisection::split(std::uint32_t start) {
    // The longest-edge propagation path, walked with a stack instead of recursion.
    std::vector<std::uint32_t> path{start};
    while (!path.empty()) {
        const std::uint32_t node = path.back();
        if (mesh_.nodes[node].children != no_index) {
            path.pop_back(); // a neighbour's split has split it already
            continue;
        }
        const int edge = longest_edge(node);
        const std::uint32_t other = neighbour(node, edge);
        const glm::uvec3 v = mesh_.nodes[node].vertices;
        const std::uint32_t a = v[edge], b = v[(edge + 1) % 3];
        int other_edge = -1;
        if (other != no_index) {
            other_edge = longest_edge(other);
            const glm::uvec3 w = mesh_.nodes[other].vertices;
            if (edge_key(w[other_edge], w[(other_edge + 1) % 3]) != edge_key(a, b)) {
                path.push_back(other); // its longest edge is longer: it goes first
                continue;
            }
        }
        const MeshVertex &va = mesh_.vertices[a], &vb = mesh_.vertices[b];
        const glm::vec3 normal = va.normal + vb.normal;
        const float length = glm::length(normal);
        const MeshVertex middle{0.5f * (va.position + vb.position),
                                length > 1e-6f ? normal / length : va.normal,
                                0.5f * (va.uv + vb.uv),
                                va.surface,
                                va.back,
                                {a, b}};
        const std::uint32_t midpoint = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back(middle);
        bisect(node, edge, midpoint);
        if (other != no_index) bisect(other, other_edge, midpoint);
        path.pop_back();
    }
}

void list_leaves(Mesh& mesh) {
    mesh.elements.clear();
    mesh.element_coarse.clear();
    mesh.element_surface.clear();
    mesh.element_back.clear();
    // Depth first, so that neighbours in space are neighbours in the list.
    std::vector<std::uint32_t> path;
    for (std::uint32_t coarse = 0; coarse < mesh.coarse_element_count; ++coarse) {
        path.push_back(coarse);
        while (!path.empty()) {
            const MeshNode& node = mesh.nodes[path.back()];
            path.pop_back();
            if (node.children != no_index) {
                path.push_back(node.children + 1);
                path.push_back(node.children);
                continue;
            }
            mesh.elements.push_back(node.vertices);
            mesh.element_coarse.push_back(node.coarse);
            mesh.element_surface.push_back(mesh.coarse_surface[node.coarse]);
            mesh.element_back.push_back(mesh.coarse_back[node.coarse]);
        }
    }
}

} // namespace lueur
