#include "core/transport/mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/scene/index_table.h"
#include "core/transport/bisection.h"

namespace lueur {

namespace {

constexpr double elements_across_a_patch = 3;

glm::vec3 area_vector(const Geometry& geometry, const glm::uvec3& triangle) {
    const glm::vec3 a = geometry.vertices[triangle.x].position;
    return 0.5f * glm::cross(geometry.vertices[triangle.y].position - a, geometry.vertices[triangle.z].position - a);
}

// A surface shows its back where its material says so, or where it shines there.
std::vector<bool> two_sided_surfaces(const Scene& scene) {
    std::vector<bool> objects;
    for (const Object& object : scene.objects) objects.push_back(scene.materials[at(object.material)].two_sided);
    for (const Luminaire& luminaire : scene.luminaires)
        for (const ObjectIndex o : luminaire.objects)
            if (luminaire.side != EmitSide::front) objects[at(o)] = true;
    std::vector<bool> surfaces;
    for (const Surface& surface : scene.geometry->surfaces) surfaces.push_back(objects[at(surface.object)]);
    return surfaces;
}

std::uint64_t hash_of(const MeshVertex& vertex) {
    std::uint64_t hash = 0x9e3779b97f4a7c15ull ^ vertex.surface;
    const glm::vec3 &p = vertex.position, &n = vertex.normal;
    for (const float f : {p.x, p.y, p.z, n.x, n.y, n.z, vertex.uv.x, vertex.uv.y}) {
        hash = (hash ^ std::bit_cast<std::uint32_t>(f + 0.0f)) * 0xff51afd7ed558ccdull; // -0 equals 0
        hash ^= hash >> 32;
    }
    return hash;
}

// Vertices of one surface are one where position, texture coordinate and (on curved surfaces) normal are the same.
bool same_vertex(const MeshVertex& a, const MeshVertex& b) {
    return a.surface == b.surface && a.position == b.position && a.normal == b.normal && a.uv == b.uv;
}

void add_surface_triangles(const Scene& scene, Mesh& mesh) {
    const Geometry& geometry = *scene.geometry;
    std::vector<glm::vec3> plane_normal(geometry.surfaces.size(), glm::vec3(0));
    for (std::size_t t = 0; t < geometry.triangles.size(); ++t)
        plane_normal[at(geometry.triangle_surface[t])] += area_vector(geometry, geometry.triangles[t]);
    for (glm::vec3& n : plane_normal)
        if (glm::dot(n, n) > 0) n = glm::normalize(n);

    IndexTable welded(geometry.triangles.size() * 3);
    for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
        const std::uint32_t s = static_cast<std::uint32_t>(at(geometry.triangle_surface[t]));
        const bool planar = geometry.surfaces[s].planar;
        const glm::vec3 flat_normal =
            planar ? plane_normal[s] : glm::normalize(area_vector(geometry, geometry.triangles[t]));
        glm::uvec3 corners;
        for (int k = 0; k < 3; ++k) {
            const Vertex& v = geometry.vertices[geometry.triangles[t][k]];
            glm::vec3 normal = planar || v.normal == glm::vec3(0) ? flat_normal : v.normal;
            if (glm::dot(normal, flat_normal) < 0) normal = -normal; // a file's normal on the wrong side
            const MeshVertex vertex{v.position, normal, v.uv, s, false, {no_index, no_index}};
            corners[k] =
                welded.find_or_insert(hash_of(vertex), static_cast<std::uint32_t>(mesh.vertices.size()),
                                      [&](std::uint32_t other) { return same_vertex(mesh.vertices[other], vertex); });
            if (corners[k] == mesh.vertices.size()) mesh.vertices.push_back(vertex);
        }
        if (corners.x == corners.y || corners.y == corners.z || corners.z == corners.x) continue;
        mesh.nodes.push_back({corners, static_cast<std::uint32_t>(mesh.nodes.size())});
        mesh.coarse_surface.push_back(s);
        mesh.coarse_back.push_back(0);
    }
}

// Elements get edges of at most `size`; thin ones (a skirting board, a slat), whose area is small anyway, of at most
// three times that.
void refine_to_size(Mesh& mesh, float size) {
    Bisection bisection(mesh);
    const float limit = size * size;
    const auto too_large = [&](std::uint32_t n) {
        const int edge = bisection.longest_edge(n);
        const glm::uvec3 v = mesh.nodes[n].vertices;
        const float longest = bisection.edge_length(v[edge], v[(edge + 1) % 3]);
        const glm::vec3 a = mesh.vertices[v.x].position;
        const float twice_area =
            glm::length(glm::cross(mesh.vertices[v.y].position - a, mesh.vertices[v.z].position - a));
        return longest > 9 * limit || (longest > limit && twice_area > 0.5f * limit);
    };
    for (std::uint32_t n = 0; n < mesh.nodes.size(); ++n) // grows while it runs: children are looked at in their turn
        while (mesh.nodes[n].children == no_index && too_large(n)) bisection.split(n);
}

// The coarsest ancestor of each node whose edges are at most `patch_size` long (or the node itself), by node number.
std::vector<std::uint32_t> patch_roots(const Mesh& mesh, float patch_size) {
    std::vector<std::uint32_t> root(mesh.nodes.size(), no_index);
    for (std::uint32_t n = 0; n < mesh.nodes.size(); ++n) { // parents come before children
        if (root[n] == no_index) {
            const int edge = Bisection::longest_edge(mesh, n);
            const glm::uvec3 v = mesh.nodes[n].vertices;
            if (mesh.nodes[n].children == no_index ||
                Bisection::edge_length(mesh, v[edge], v[(edge + 1) % 3]) <= patch_size * patch_size)
                root[n] = n;
        }
        if (root[n] != no_index && mesh.nodes[n].children != no_index)
            root[mesh.nodes[n].children] = root[mesh.nodes[n].children + 1] = root[n];
    }
    return root;
}

// Leaves become the coarse elements; of what they were cut from only the patches are remembered.
void make_leaves_coarse(Mesh& mesh, float patch_size) {
    const std::uint32_t triangles =
        static_cast<std::uint32_t>(mesh.coarse_surface.size()); // the first nodes are those of the scene
    const std::vector<std::uint32_t> root = patch_roots(mesh, patch_size);
    std::vector<std::uint32_t> patch_of_root(mesh.nodes.size(), no_index);
    std::vector<MeshNode> leaves;
    std::vector<std::uint32_t> surface;
    std::vector<std::uint32_t> path;
    auto tree = std::make_shared<TriangleTree>();
    tree->count = triangles;
    for (const MeshNode& node : mesh.nodes)
        tree->nodes.push_back({node.vertices, node.children, no_index, node.split_edge});
    for (std::uint32_t start = 0; start < triangles;
         ++start) { // depth first: neighbours in space are neighbours in number
        path.push_back(start);
        while (!path.empty()) {
            const std::uint32_t n = path.back();
            const MeshNode& node = mesh.nodes[n];
            path.pop_back();
            if (node.children != no_index) {
                path.push_back(node.children + 1);
                path.push_back(node.children);
                continue;
            }
            if (patch_of_root[root[n]] == no_index) {
                patch_of_root[root[n]] = static_cast<std::uint32_t>(mesh.patches.size());
                mesh.patches.push_back(mesh.nodes[root[n]].vertices);
            }
            mesh.coarse_patch.push_back(patch_of_root[root[n]]);
            surface.push_back(mesh.coarse_surface[node.coarse]);
            mesh.coarse_triangle.push_back(start);
            tree->nodes[n].element = static_cast<std::uint32_t>(leaves.size());
            leaves.push_back({node.vertices, static_cast<std::uint32_t>(leaves.size())});
        }
    }
    mesh.triangles = std::move(tree);
    mesh.nodes = std::move(leaves);
    mesh.coarse_surface = std::move(surface);
    mesh.coarse_back.assign(mesh.nodes.size(), 0);
    for (MeshVertex& v : mesh.vertices) v.parents = {no_index, no_index};
}

void add_back_sides(const Scene& scene, Mesh& mesh) {
    const std::size_t front_count = mesh.nodes.size();
    const std::vector<bool> two_sided = two_sided_surfaces(scene);
    mesh.coarse_twin.assign(front_count, no_index);
    std::vector<std::uint32_t> back_vertex(mesh.vertices.size(), no_index);
    const auto back_of = [&](std::uint32_t v) {
        if (back_vertex[v] == no_index) {
            back_vertex[v] = static_cast<std::uint32_t>(mesh.vertices.size());
            MeshVertex copy = mesh.vertices[v];
            copy.normal = -copy.normal;
            copy.back = true;
            mesh.vertices.push_back(copy);
        }
        return back_vertex[v];
    };
    std::vector<std::uint32_t> back_patch(mesh.patches.size(), no_index);
    for (std::uint32_t e = 0; e < front_count; ++e) {
        if (!two_sided[mesh.coarse_surface[e]]) continue;
        const glm::uvec3 v = mesh.nodes[e].vertices;
        const std::uint32_t back = static_cast<std::uint32_t>(mesh.nodes.size());
        mesh.nodes.push_back({{back_of(v.x), back_of(v.z), back_of(v.y)}, back});
        mesh.coarse_surface.push_back(mesh.coarse_surface[e]);
        mesh.coarse_back.push_back(1);
        mesh.coarse_triangle.push_back(mesh.coarse_triangle[e]);
        mesh.coarse_twin[e] = back;
        mesh.coarse_twin.push_back(e);
        const std::uint32_t patch = mesh.coarse_patch[e];
        if (back_patch[patch] == no_index) {
            back_patch[patch] = static_cast<std::uint32_t>(mesh.patches.size());
            const glm::uvec3 p = mesh.patches[patch];
            mesh.patches.push_back({back_of(p.x), back_of(p.z), back_of(p.y)});
        }
        mesh.coarse_patch.push_back(back_patch[patch]);
    }
}

} // namespace

double automatic_element_size(const Scene& scene) {
    const Geometry& geometry = *scene.geometry;
    const std::vector<bool> two_sided = two_sided_surfaces(scene);
    double area = 0;
    for (std::size_t t = 0; t < geometry.triangles.size(); ++t)
        area += glm::length(area_vector(geometry, geometry.triangles[t])) *
                (two_sided[at(geometry.triangle_surface[t])] ? 2 : 1);
    // Indirect light is smooth: few receivers do, more where there are more things to be dark between. Bisection of
    // right triangles down to a longest edge h leaves about 2.8 / h^2 vertices a square metre.
    const double vertices = 2200 + std::min(0.2 * static_cast<double>(geometry.triangles.size()), 20000.0);
    return area > 0 ? std::sqrt(2.8 * area / vertices) : 1.0;
}

Mesh make_mesh(const Scene& scene, const MeshParams& params) {
    Mesh mesh;
    add_surface_triangles(scene, mesh);
    const double size = params.element_size > 0 ? params.element_size : automatic_element_size(scene);
    refine_to_size(mesh, static_cast<float>(size));
    make_leaves_coarse(mesh, static_cast<float>(elements_across_a_patch * size));
    add_back_sides(scene, mesh);
    mesh.coarse_vertex_count = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.coarse_element_count = static_cast<std::uint32_t>(mesh.nodes.size());
    mesh.coarse_area.reserve(mesh.nodes.size());
    for (const MeshNode& node : mesh.nodes) {
        const glm::vec3 a = mesh.vertices[node.vertices.x].position;
        mesh.coarse_area.push_back(0.5f * glm::length(glm::cross(mesh.vertices[node.vertices.y].position - a,
                                                                 mesh.vertices[node.vertices.z].position - a)));
    }
    list_leaves(mesh);
    mesh.indirect_vertex_count = mesh.coarse_vertex_count;
    mesh.indirect_node_count = mesh.coarse_element_count;
    mesh.indirect_elements = mesh.elements;
    return mesh;
}

namespace {

// One step down: the weights in the child that holds the point, and whether it is the second one. Children are {a,
// middle, c}, with the weights {a - b, 2 b, c}, and {middle, b, c}, with {2 a, b - a, c}. Which of them is as good as
// random: chosen by masks, for a branch would be mispredicted at every other step.
std::uint32_t step_down(int k, glm::vec3& w) {
    constexpr int following[3] = {1, 2, 0};
    const int l = following[k];
    const float a = w[k], b = w[l], c = w[following[l]];
    const std::uint32_t second = a < b, mask = 0u - second;
    const auto apart = std::bit_cast<std::uint32_t>(std::abs(a - b)),
               twice = std::bit_cast<std::uint32_t>(2 * std::min(a, b));
    w = {std::bit_cast<float>((twice & mask) | (apart & ~mask)), std::bit_cast<float>((apart & mask) | (twice & ~mask)),
         c};
    return second;
}

// From node n down to the leaf among the first `nodes`.
std::uint32_t descend(const Mesh& mesh, std::uint32_t n, glm::vec3& w, std::uint32_t nodes) {
    while (mesh.nodes[n].children < nodes) // no_index is larger than any
        n = mesh.nodes[n].children + step_down(mesh.nodes[n].split_edge, w);
    return n;
}

} // namespace

std::uint32_t coarse_element_at(const TriangleTree& tree, std::uint32_t triangle, float& b1, float& b2) {
    std::uint32_t n = triangle;
    glm::vec3 w(1 - b1 - b2, b1, b2);
    while (tree.nodes[n].children != no_index) n = tree.nodes[n].children + step_down(tree.nodes[n].split_edge, w);
    b1 = w.y, b2 = w.z;
    return tree.nodes[n].element;
}

Located locate(const Mesh& mesh, std::uint32_t coarse_element, float b1, float b2) {
    glm::vec3 w(1 - b1 - b2, b1, b2);
    const std::uint32_t leaf = descend(mesh, coarse_element, w, no_index);
    return {mesh.nodes[leaf].vertices, w};
}

LocatedTwice locate_twice(const Mesh& mesh, std::uint32_t coarse_element, float b1, float b2) {
    glm::vec3 w(1 - b1 - b2, b1, b2);
    const std::uint32_t indirect = descend(mesh, coarse_element, w, mesh.indirect_node_count);
    const glm::vec3 indirect_weights = w;
    const std::uint32_t leaf = descend(mesh, indirect, w, no_index);
    return {{mesh.nodes[indirect].vertices, indirect_weights}, {mesh.nodes[leaf].vertices, w}};
}

Located locate_on_level(const Mesh& mesh, std::uint32_t vertices, std::uint32_t coarse_element, float b1, float b2) {
    const std::uint32_t nodes = vertices == mesh.vertices.size()         ? no_index
                                : vertices == mesh.indirect_vertex_count ? mesh.indirect_node_count
                                                                         : mesh.coarse_element_count;
    glm::vec3 w(1 - b1 - b2, b1, b2);
    const std::uint32_t leaf = descend(mesh, coarse_element, w, nodes);
    return {mesh.nodes[leaf].vertices, w};
}

std::vector<glm::uvec3> elements_of_level(const Mesh& mesh, std::uint32_t vertices) {
    if (vertices == mesh.indirect_vertex_count) return mesh.indirect_elements;
    std::vector<glm::uvec3> elements;
    for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e) elements.push_back(mesh.nodes[e].vertices);
    return elements;
}

glm::vec3 ray_origin(glm::vec3 position, glm::vec3 normal, glm::vec3 inward, float epsilon) {
    const glm::vec3 shift = 0.02f * (inward - position);
    // On a curved surface the elements bend away from the tangent plane: stay as far above it as they may be below.
    const float bend = glm::dot(shift, normal);
    return position + shift + (epsilon + std::abs(bend) - bend) * normal;
}

std::vector<glm::vec3> ray_origins(const Mesh& mesh, float epsilon) {
    std::vector<glm::vec3> inward(mesh.vertices.size(), glm::vec3(0));
    std::vector<float> count(mesh.vertices.size(), 0);
    for (const glm::uvec3& e : mesh.elements) {
        const glm::vec3 centre =
            (mesh.vertices[e.x].position + mesh.vertices[e.y].position + mesh.vertices[e.z].position) / 3.0f;
        for (int k = 0; k < 3; ++k) inward[e[k]] += centre, count[e[k]] += 1;
    }
    std::vector<glm::vec3> origins(mesh.vertices.size());
    for (std::size_t v = 0; v < origins.size(); ++v) {
        const MeshVertex& vertex = mesh.vertices[v];
        const glm::vec3 inside = count[v] > 0 ? inward[v] / count[v] : vertex.position;
        origins[v] = ray_origin(vertex.position, vertex.normal, inside, epsilon);
    }
    return origins;
}

std::vector<float> vertex_areas(const Mesh& mesh) {
    return vertex_areas(mesh, mesh.elements, static_cast<std::uint32_t>(mesh.vertices.size()));
}

std::vector<float> vertex_areas(const Mesh& mesh, std::span<const glm::uvec3> elements, std::uint32_t vertices) {
    std::vector<float> areas(vertices, 0);
    for (const glm::uvec3& e : elements) {
        const glm::vec3 a = mesh.vertices[e.x].position;
        const float third =
            glm::length(glm::cross(mesh.vertices[e.y].position - a, mesh.vertices[e.z].position - a)) / 6;
        for (int k = 0; k < 3; ++k) areas[e[k]] += third;
    }
    return areas;
}

} // namespace lueur
