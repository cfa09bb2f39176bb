#include "core/scene/surfaces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/scene/index_table.h"
#include "core/scene/weld.h"

namespace lueur {

namespace {

constexpr std::uint32_t none = 0xffffffffu;
constexpr double degree = 3.14159265358979323846 / 180;
constexpr double plane_angle = 0.2 * degree; // between neighbours of one wall
constexpr double flat_angle = 2 * degree;    // a file's normals this near to the wall's own are rounding
constexpr double sharp_cosine = 0.1;         // 84 degrees: an edge is an edge, whatever the normals say
constexpr double smooth_cosine = 0.9999;     // 0.8 degrees: one and the same normal, rounded
constexpr double weld_share = 1e-6, plane_share = 1e-5,
                 sliver_share = 1e-7; // of the scene's size, of the size, of the edge

struct Triangle {
    glm::uvec3 vertex;
    glm::uvec3 welded;
    glm::dvec3 normal; // unit, from the corners
    double area;
    double height; // over the longest edge
    ObjectIndex object;
};

struct EdgeUse {
    std::uint64_t edge; // two welded positions, the smaller first
    std::uint32_t triangle;
    std::uint8_t corner; // the edge goes from this corner to the next
};

struct UnionFind {
    std::vector<std::uint32_t> parent;
    explicit UnionFind(std::size_t count)
        : parent(count) {
        std::iota(parent.begin(), parent.end(), 0u);
    }
    std::uint32_t root(std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent[root(a)] = root(b); }
};

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

struct Left { // what is left out, of each object
    std::size_t degenerate = 0, not_finite = 0;
};

struct Builder {
    const TriangleSoup& soup;
    double size = 0; // diagonal of the bounding box
    std::vector<std::uint32_t> weld;
    std::vector<Triangle> triangles;
    std::vector<EdgeUse> uses;                                 // sorted by edge
    std::vector<std::array<std::uint32_t, 3>> neighbour_begin; // of each triangle's edges: where its edge's uses begin
    std::vector<std::uint32_t> region;                         // of each triangle; named by its seed

    void keep_sound_triangles(const std::vector<Object>& objects, std::vector<std::string>& warnings);
    void find_neighbours();
    void grow_planes();
    Geometry geometry();

    template <typename Visit>
    void each_neighbour(std::uint32_t triangle, int corner, const Visit& visit) const {
        const std::uint32_t begin = neighbour_begin[triangle][static_cast<std::size_t>(corner)];
        if (begin == none) return;
        for (std::uint32_t i = begin; i < uses.size() && uses[i].edge == uses[begin].edge; ++i)
            if (uses[i].triangle != triangle && triangles[uses[i].triangle].object == triangles[triangle].object)
                visit(uses[i]);
    }
    bool smooth_across(std::uint32_t triangle, int corner, const EdgeUse& other) const;
};

void Builder::keep_sound_triangles(const std::vector<Object>& objects, std::vector<std::string>& warnings) {
    std::vector<Left> left(objects.size());
    glm::dvec3 low(1e300), high(-1e300);
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
        const glm::uvec3& t = soup.triangles[i];
        const ObjectIndex object = soup.triangle_object[i];
        const glm::vec3 corner[3] = {soup.vertices[t.x].position, soup.vertices[t.y].position,
                                     soup.vertices[t.z].position};
        if (!finite(corner[0]) || !finite(corner[1]) || !finite(corner[2])) {
            ++left[at(object)].not_finite;
            continue;
        }
        const glm::dvec3 a(corner[0]), b(corner[1]), c(corner[2]);
        const glm::dvec3 cross = glm::cross(b - a, c - a);
        const double twice_area = glm::length(cross);
        const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        if (!(twice_area > sliver_share * longest * longest)) {
            ++left[at(object)].degenerate;
            continue;
        }
        triangles.push_back({t, {}, cross / twice_area, twice_area / 2, twice_area / longest, object});
        for (const glm::dvec3& p : {a, b, c}) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    size = triangles.empty() ? 0 : glm::distance(low, high);
    for (std::size_t i = 0; i < objects.size(); ++i) {
        if (left[i].degenerate)
            warnings.push_back(fmt::format(
                "object \"{}\": {} degenerate triangle{} left out (no area, or thinner than 1e-7 of the longest edge)",
                objects[i].name, left[i].degenerate, left[i].degenerate == 1 ? "" : "s"));
        if (left[i].not_finite)
            warnings.push_back(
                fmt::format("object \"{}\": {} triangle{} left out that name{} a vertex that is not a finite number",
                            objects[i].name, left[i].not_finite, left[i].not_finite == 1 ? "" : "s",
                            left[i].not_finite == 1 ? "s" : ""));
    }
}

void Builder::find_neighbours() {
    weld = weld_positions(soup.vertices, weld_share * size);
    uses.reserve(triangles.size() * 3);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        Triangle& triangle = triangles[i];
        for (int k = 0; k < 3; ++k) triangle.welded[k] = weld[triangle.vertex[k]];
        for (int k = 0; k < 3; ++k) {
            const std::uint64_t a = triangle.welded[k], b = triangle.welded[(k + 1) % 3];
            if (a != b) uses.push_back({std::min(a, b) << 32 | std::max(a, b), i, static_cast<std::uint8_t>(k)});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return a.edge != b.edge           ? a.edge < b.edge
               : a.triangle != b.triangle ? a.triangle < b.triangle
                                          : a.corner < b.corner;
    });
    neighbour_begin.assign(triangles.size(), {none, none, none});
    for (std::uint32_t i = 0, begin = 0; i < uses.size(); ++i) {
        if (uses[i].edge != uses[begin].edge) begin = i;
        neighbour_begin[uses[i].triangle][uses[i].corner] = begin;
    }
}

// Each wall grows from its largest triangle and is held against that one's plane, so that a finely cut cylinder does
// not creep into one "plane" step by step. Every edge is crossed at most twice a wall that touches it: O(n log n) with
// the sort.
void Builder::grow_planes() {
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return triangles[a].area > triangles[b].area; });
    region.assign(triangles.size(), none);
    std::vector<std::uint32_t> front;
    for (const std::uint32_t seed : order) {
        if (region[seed] != none) continue;
        const Triangle& wall = triangles[seed];
        const glm::dvec3 origin(soup.vertices[wall.vertex.x].position);
        region[seed] = seed;
        front.assign(1, seed);
        while (!front.empty()) {
            const std::uint32_t from = front.back();
            front.pop_back();
            for (int corner = 0; corner < 3; ++corner)
                each_neighbour(from, corner, [&](const EdgeUse& use) {
                    if (region[use.triangle] != none) return;
                    const Triangle& other = triangles[use.triangle];
                    // The normal of a thin triangle is uncertain by the rounding of its corners over its height.
                    const double angle = std::max(plane_angle, std::min(0.5, weld_share * size / other.height));
                    if (glm::dot(other.normal, wall.normal) < std::cos(angle)) return;
                    for (int k = 0; k < 3; ++k)
                        if (std::abs(glm::dot(glm::dvec3(soup.vertices[other.vertex[k]].position) - origin,
                                              wall.normal)) > plane_share * size)
                            return;
                    region[use.triangle] = seed;
                    front.push_back(use.triangle);
                });
        }
    }
}

// The same normals at both ends of an edge, of two triangles that are not in one plane.
bool Builder::smooth_across(std::uint32_t triangle, int corner, const EdgeUse& other) const {
    const Triangle &a = triangles[triangle], &b = triangles[other.triangle];
    if (glm::dot(a.normal, b.normal) < sharp_cosine) return false;
    const auto normal = [&](const Triangle& t, int k) { return soup.vertices[t.vertex[k % 3]].normal; };
    const bool opposite =
        a.welded[corner] != b.welded[other.corner]; // neighbours that turn alike run along their edge in opposite ways
    const int b_first = opposite ? other.corner + 1 : other.corner,
              b_second = opposite ? other.corner : other.corner + 1;
    const auto same = [](const glm::vec3& m, const glm::vec3& n) {
        return glm::dot(m, m) > 0.5f && glm::dot(n, n) > 0.5f && glm::dot(m, n) > smooth_cosine;
    };
    return same(normal(a, corner), normal(b, b_first)) && same(normal(a, corner + 1), normal(b, b_second));
}

std::uint64_t corner_hash(std::uint32_t surface, std::uint32_t welded, const Vertex& vertex) {
    std::uint64_t hash = surface * 0x9e3779b97f4a7c15ull + welded;
    for (const float number : {vertex.normal.x, vertex.normal.y, vertex.normal.z, vertex.uv.x, vertex.uv.y})
        hash = (hash ^ std::bit_cast<std::uint32_t>(number + 0.0f)) * 0x100000001b3ull; // -0 equals 0
    return hash;
}

Geometry Builder::geometry() {
    UnionFind joined(triangles.size());
    std::vector<bool> curved(triangles.size(), false); // by region's seed
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        for (int corner = 0; corner < 3; ++corner)
            each_neighbour(i, corner, [&](const EdgeUse& use) {
                if (use.triangle < i || region[use.triangle] == region[i] || !smooth_across(i, corner, use)) return;
                curved[region[i]] = curved[region[use.triangle]] = true;
                joined.join(region[i], region[use.triangle]);
            });
    // A wall whose normals say that it is bent keeps them, even where it meets nobody.
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 normal(soup.vertices[triangles[i].vertex[k]].normal);
            if (glm::dot(normal, normal) > 0.5 && glm::dot(normal, triangles[region[i]].normal) < std::cos(flat_angle))
                curved[region[i]] = true;
        }
    std::vector<bool> curved_surface(triangles.size(), false);
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        if (curved[region[i]]) curved_surface[joined.root(region[i])] = true;

    Geometry result;
    result.triangles.reserve(triangles.size());
    std::vector<std::uint32_t> surface_of_root(triangles.size(), none);
    IndexTable shared_vertices(triangles.size() * 3); // corners of one surface, place, normal and uv are one vertex
    std::vector<std::uint32_t> vertex_surface, vertex_weld;
    const auto add_vertex = [&](const Vertex& vertex, std::uint32_t surface, std::uint32_t welded) {
        result.vertices.push_back(vertex);
        vertex_surface.push_back(surface);
        vertex_weld.push_back(welded);
    };
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const Triangle& triangle = triangles[i];
        const std::uint32_t root = joined.root(region[i]);
        if (surface_of_root[root] == none) {
            surface_of_root[root] = static_cast<std::uint32_t>(result.surfaces.size());
            result.surfaces.push_back({triangle.object, !curved_surface[root]});
        }
        const std::uint32_t surface = surface_of_root[root];
        glm::uvec3 corners{0};
        Vertex own[3];
        for (int k = 0; k < 3; ++k) {
            own[k] = soup.vertices[triangle.vertex[k]];
            const float length = glm::length(own[k].normal);
            own[k].normal =
                curved_surface[root] && std::isfinite(length) && length > 0.5f ? own[k].normal / length : glm::vec3(0);
            const auto fresh = static_cast<std::uint32_t>(result.vertices.size());
            corners[k] = shared_vertices.find_or_insert(
                corner_hash(surface, triangle.welded[k], own[k]), fresh, [&](std::uint32_t other) {
                    return vertex_surface[other] == surface && vertex_weld[other] == triangle.welded[k] &&
                           result.vertices[other].normal == own[k].normal && result.vertices[other].uv == own[k].uv;
                });
            if (corners[k] == fresh) add_vertex(own[k], surface, triangle.welded[k]);
        }
        const auto shared = [&](int k) { return glm::dvec3(result.vertices[corners[k]].position); };
        const glm::dvec3 moved = glm::cross(shared(1) - shared(0), shared(2) - shared(0));
        if (glm::dot(moved, triangle.normal) <
            triangle.area) // under half of it is left: it is too small for the weld, and stays as it is
            for (int k = 0; k < 3; ++k) {
                corners[k] = static_cast<std::uint32_t>(result.vertices.size());
                add_vertex(own[k], surface, triangle.welded[k]);
            }
        result.triangles.push_back(corners);
        result.triangle_surface.push_back(SurfaceIndex{surface});
    }
    return result;
}

} // namespace

void measure_surfaces(Geometry& geometry) {
    geometry.surface_area.assign(geometry.surfaces.size(), 0);
    for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
        const auto corner = [&](int k) { return glm::dvec3(geometry.vertices[geometry.triangles[t][k]].position); };
        geometry.surface_area[at(geometry.triangle_surface[t])] +=
            glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
    }
}

Geometry make_geometry(const TriangleSoup& soup, const std::vector<Object>& objects,
                       std::vector<std::string>& warnings) {
    Builder builder{soup, 0, {}, {}, {}, {}, {}};
    builder.keep_sound_triangles(objects, warnings);
    builder.find_neighbours();
    builder.grow_planes();
    Geometry geometry = builder.geometry();
    measure_surfaces(geometry);
    return geometry;
}

} // namespace lueur
