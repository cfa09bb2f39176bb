#include "core/solve/hierarchy_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/transport/bisection.h"
#include "core/transport/sampling.h"

namespace lueur {

namespace {

int corner_count(const ElementNode& node) {
    return node.shape == ElementShape::quadrilateral ? 4 : 3;
}

glm::vec3 twice_area_vector(const ElementTree& tree, const ElementNode& node) {
    const auto p = [&](int k) { return tree.vertices[node.corners[static_cast<std::size_t>(k)]]; };
    if (node.shape == ElementShape::quadrilateral) return glm::cross(p(2) - p(0), p(3) - p(1));
    return glm::cross(p(1) - p(0), p(2) - p(0));
}

void measure(const ElementTree& tree, ElementNode& node) {
    const int count = corner_count(node);
    node.centre = glm::vec3(0);
    for (int k = 0; k < count; ++k)
        node.centre += tree.vertices[node.corners[static_cast<std::size_t>(k)]] / static_cast<float>(count);
    node.radius = 0;
    for (int k = 0; k < count; ++k)
        node.radius =
            std::max(node.radius, glm::distance(node.centre, tree.vertices[node.corners[static_cast<std::size_t>(k)]]));
    const glm::vec3 area = twice_area_vector(tree, node);
    const float length = glm::length(area);
    node.area = length / 2;
    node.normal = length > 0 ? area / length : glm::vec3(0, 1, 0);
}

std::uint32_t middle_of(ElementTree& tree, std::uint32_t a, std::uint32_t b) {
    const auto [found, fresh] =
        tree.edge_middle.try_emplace(Bisection::edge_key(a, b), static_cast<std::uint32_t>(tree.vertices.size()));
    if (fresh) tree.vertices.push_back(0.5f * (tree.vertices[a] + tree.vertices[b]));
    return found->second;
}

// The quadrilateral of two triangles at a common edge, if it is planar and convex: its largest |cosine| at a corner, 0
// for a rectangle; 2 where it is none.
float how_oblique(const Mesh& mesh, const std::array<std::uint32_t, 4>& corners, glm::vec3 normal) {
    float worst = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto p = [&](std::size_t n) { return mesh.vertices[corners[n % 4]].position; };
        const glm::vec3 in = p(k + 1) - p(k), out = p(k + 2) - p(k + 1);
        const float lengths = glm::length(in) * glm::length(out);
        if (!(glm::dot(glm::cross(in, out), normal) > 0.05f * lengths)) return 2;
        worst = std::max(worst, std::abs(glm::dot(in, out)) / lengths);
    }
    return worst;
}

std::array<std::uint32_t, 4> joined(const glm::uvec3& a, const glm::uvec3& b) {
    for (int k = 0; k < 3; ++k) // corner k of a is the one that b does not have
        if (a[k] != b.x && a[k] != b.y && a[k] != b.z)
            for (int l = 0; l < 3; ++l)
                if (b[l] != a.x && b[l] != a.y && b[l] != a.z) return {a[k], a[(k + 1) % 3], b[l], a[(k + 2) % 3]};
    return {no_index, no_index, no_index, no_index};
}

// Every triangle takes the neighbour with which it is nearest to a rectangle; no_index: it stays a triangle.
std::vector<std::uint32_t> pair_triangles(const Scene& scene, const Mesh& mesh) {
    std::unordered_map<std::uint64_t, std::array<std::uint32_t, 2>> at_edge;
    const auto normal_of = [&](std::uint32_t e) {
        const glm::uvec3 v = mesh.nodes[e].vertices;
        const glm::vec3 a = mesh.vertices[v.x].position;
        return glm::normalize(glm::cross(mesh.vertices[v.y].position - a, mesh.vertices[v.z].position - a));
    };
    for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e) {
        if (!scene.geometry->surfaces[mesh.coarse_surface[e]].planar) continue;
        const glm::uvec3 v = mesh.nodes[e].vertices;
        for (int k = 0; k < 3; ++k) {
            auto& both = at_edge.try_emplace(Bisection::edge_key(v[k], v[(k + 1) % 3]), std::array{no_index, no_index})
                             .first->second;
            (both[0] == no_index ? both[0] : both[1]) = e;
        }
    }
    std::vector<std::uint32_t> partner(mesh.coarse_element_count, no_index);
    for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e) {
        if (partner[e] != no_index || !scene.geometry->surfaces[mesh.coarse_surface[e]].planar) continue;
        const glm::uvec3 v = mesh.nodes[e].vertices;
        const glm::vec3 normal = normal_of(e);
        float best = 0.95f;
        for (int k = 0; k < 3; ++k) {
            const auto& both = at_edge.at(Bisection::edge_key(v[k], v[(k + 1) % 3]));
            const std::uint32_t other = both[0] == e ? both[1] : both[0];
            if (other == no_index || partner[other] != no_index || mesh.coarse_surface[other] != mesh.coarse_surface[e])
                continue;
            if (glm::dot(normal_of(other), normal) < 1 - 1e-6f) continue;
            const auto corners = joined(v, mesh.nodes[other].vertices);
            if (corners[0] == no_index) continue;
            const float oblique = how_oblique(mesh, corners, normal);
            if (oblique < best) best = oblique, partner[e] = other;
        }
        if (partner[e] != no_index) partner[partner[e]] = e;
    }
    return partner;
}

class ClusterBuilder {
public:
    ClusterBuilder(const Scene& scene, ElementTree& tree)
        : scene_(scene)
        , tree_(tree) {}

    void build() {
        std::vector<std::uint32_t> roots(tree_.root_count);
        std::iota(roots.begin(), roots.end(), 0u);
        // By object, then by the axis that a root looks along.
        const auto key = [&](std::uint32_t r) {
            const ElementNode& node = tree_.nodes[r];
            int axis = 0;
            for (int k = 1; k < 3; ++k)
                if (std::abs(node.normal[k]) > std::abs(node.normal[axis]) + 1e-4f) axis = k;
            return std::uint64_t(at(scene_.geometry->surfaces[node.surface].object)) * 6 +
                   static_cast<std::uint64_t>(2 * axis + (node.normal[axis] < 0));
        };
        std::stable_sort(roots.begin(), roots.end(), [&](auto a, auto b) { return key(a) < key(b); });
        tree_.root_order = roots;
        std::vector<std::vector<Group>> objects;
        for (std::uint32_t first = 0; first < roots.size();) {
            std::uint32_t last = first;
            while (last < roots.size() && key(roots[last]) == key(roots[first])) ++last;
            if (objects.empty() || key(roots[first]) / 6 != key(roots[first - 1]) / 6) objects.emplace_back();
            objects.back().push_back({first, last});
            first = last;
        }
        // Objects are put in an order of their own, so that a cluster of objects has its roots together too.
        std::vector<std::uint32_t> order;
        for (const auto& groups : objects)
            objects_.push_back({groups, box_of(groups.front().first, groups.back().last)});
        tree_.top = objects_.empty() ? no_index : over_objects(0, static_cast<std::uint32_t>(objects_.size()));
        tree_.cluster_count = static_cast<std::uint32_t>(tree_.nodes.size()) - tree_.root_count;
        tree_.root_order = std::move(placed_);
        for (std::uint32_t n = tree_.root_count; n < tree_.nodes.size(); ++n) measure_cluster(n);
    }

private:
    struct Group {
        std::uint32_t first, last;
    };
    struct Box {
        glm::vec3 low{1e30f}, high{-1e30f};
    };
    struct ObjectGroups {
        std::vector<Group> groups;
        Box box;
    };

    Box box_of(std::uint32_t first, std::uint32_t last) const {
        Box box;
        for (std::uint32_t k = first; k < last; ++k) {
            const glm::vec3 c = tree_.nodes[tree_.root_order[k]].centre;
            box.low = glm::min(box.low, c), box.high = glm::max(box.high, c);
        }
        return box;
    }
    static int widest_axis(const Box& box) {
        const glm::vec3 size = box.high - box.low;
        return size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    }
    std::uint32_t new_cluster() {
        ElementNode cluster;
        cluster.shape = ElementShape::cluster;
        cluster.first_root = static_cast<std::uint32_t>(placed_.size());
        tree_.nodes.push_back(cluster);
        return static_cast<std::uint32_t>(tree_.nodes.size()) - 1;
    }
    void close_cluster(std::uint32_t n, std::uint32_t a, std::uint32_t b) {
        tree_.nodes[n].children[0] = a, tree_.nodes[n].children[1] = b;
        tree_.nodes[a].parent = tree_.nodes[b].parent = n;
        tree_.nodes[n].root_count = static_cast<std::uint32_t>(placed_.size()) - tree_.nodes[n].first_root;
    }
    std::uint32_t over_objects(std::uint32_t first, std::uint32_t last) {
        if (last - first == 1) return over_groups(objects_[first].groups);
        Box box;
        for (std::uint32_t k = first; k < last; ++k)
            box.low = glm::min(box.low, objects_[k].box.low + objects_[k].box.high),
            box.high = glm::max(box.high, objects_[k].box.low + objects_[k].box.high);
        const int axis = widest_axis(box);
        std::stable_sort(objects_.begin() + first, objects_.begin() + last, [&](const auto& a, const auto& b) {
            return a.box.low[axis] + a.box.high[axis] < b.box.low[axis] + b.box.high[axis];
        });
        const std::uint32_t n = new_cluster(), middle = (first + last) / 2;
        const std::uint32_t a = over_objects(first, middle), b = over_objects(middle, last);
        close_cluster(n, a, b);
        return n;
    }
    std::uint32_t over_groups(const std::vector<Group>& groups) {
        if (groups.size() == 1) return over_roots(groups[0].first, groups[0].last);
        const auto half = static_cast<std::ptrdiff_t>(groups.size() / 2);
        const std::uint32_t n = new_cluster();
        const std::uint32_t a = over_groups({groups.begin(), groups.begin() + half});
        const std::uint32_t b = over_groups({groups.begin() + half, groups.end()});
        close_cluster(n, a, b);
        return n;
    }
    std::uint32_t over_roots(std::uint32_t first, std::uint32_t last) {
        if (last - first == 1) {
            placed_.push_back(tree_.root_order[first]);
            return tree_.root_order[first];
        }
        const int axis = widest_axis(box_of(first, last));
        const std::uint32_t middle = (first + last) / 2;
        std::sort(tree_.root_order.begin() + first, tree_.root_order.begin() + last, [&](auto a, auto b) {
            const float x = tree_.nodes[a].centre[axis], y = tree_.nodes[b].centre[axis];
            return x != y ? x < y : a < b;
        });
        const std::uint32_t n = new_cluster();
        const std::uint32_t a = over_roots(first, middle), b = over_roots(middle, last);
        close_cluster(n, a, b);
        return n;
    }
    void measure_cluster(std::uint32_t n) {
        ElementNode& cluster = tree_.nodes[n];
        Box box;
        glm::dvec3 sum(0);
        double area = 0;
        for (std::uint32_t k = cluster.first_root; k < cluster.first_root + cluster.root_count; ++k) {
            const ElementNode& root = tree_.nodes[tree_.root_order[k]];
            area += root.area;
            sum += double(root.area) * glm::dvec3(root.normal);
            for (int c = 0; c < corner_count(root); ++c) {
                const glm::vec3 p = tree_.vertices[root.corners[static_cast<std::size_t>(c)]];
                box.low = glm::min(box.low, p), box.high = glm::max(box.high, p);
            }
        }
        cluster.centre = 0.5f * (box.low + box.high);
        cluster.radius = 0.5f * glm::distance(box.low, box.high);
        cluster.area = static_cast<float>(area);
        const double length = glm::length(sum);
        cluster.normal = length > 1e-3 * area ? glm::vec3(sum / length) : glm::vec3(0);
        cluster.flatness = 1;
        for (std::uint32_t k = cluster.first_root; k < cluster.first_root + cluster.root_count; ++k)
            cluster.flatness =
                std::min(cluster.flatness, glm::dot(tree_.nodes[tree_.root_order[k]].normal, cluster.normal));
    }

    const Scene& scene_;
    ElementTree& tree_;
    std::vector<ObjectGroups> objects_;
    std::vector<std::uint32_t> placed_;
};

} // namespace

ElementTree make_element_tree(const Scene& scene, bool clusters) {
    constexpr double never_cut = 1e30;
    const Mesh mesh = make_mesh(scene, {never_cut});
    ElementTree tree;
    for (const MeshVertex& v : mesh.vertices) tree.vertices.push_back(v.position);
    const std::vector<std::uint32_t> partner = pair_triangles(scene, mesh);
    tree.root_of_triangle.assign(mesh.coarse_element_count, {no_index, no_index});
    for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e) {
        if (partner[e] < e) continue;
        ElementNode node;
        const glm::uvec3 v = mesh.nodes[e].vertices;
        node.corners = {v.x, v.y, v.z, no_index};
        if (partner[e] != no_index) {
            node.shape = ElementShape::quadrilateral;
            node.corners = joined(v, mesh.nodes[partner[e]].vertices);
        }
        node.surface = mesh.coarse_surface[e];
        node.back = mesh.coarse_back[e] != 0;
        measure(tree, node);
        const std::uint32_t root = static_cast<std::uint32_t>(tree.nodes.size());
        tree.root_of_triangle[mesh.coarse_triangle[e]][node.back] = root;
        if (partner[e] != no_index) tree.root_of_triangle[mesh.coarse_triangle[partner[e]]][node.back] = root;
        tree.nodes.push_back(node);
    }
    tree.root_count = static_cast<std::uint32_t>(tree.nodes.size());
    tree.root_order.resize(tree.root_count);
    std::iota(tree.root_order.begin(), tree.root_order.end(), 0u);
    if (clusters) ClusterBuilder(scene, tree).build();
    tree.root_area_before.assign(1, 0);
    for (const std::uint32_t r : tree.root_order)
        tree.root_area_before.push_back(tree.root_area_before.back() + double(tree.nodes[r].area));
    return tree;
}

void cut_element(ElementTree& tree, std::uint32_t n) {
    const ElementNode parent = tree.nodes[n];
    const int count = corner_count(parent);
    std::array<std::uint32_t, 4> middle{};
    for (int k = 0; k < count; ++k)
        middle[static_cast<std::size_t>(k)] = middle_of(tree, parent.corners[static_cast<std::size_t>(k)],
                                                        parent.corners[static_cast<std::size_t>((k + 1) % count)]);
    std::array<std::array<std::uint32_t, 4>, 4> corners;
    const auto& c = parent.corners;
    if (count == 4) {
        const std::uint32_t centre = static_cast<std::uint32_t>(tree.vertices.size());
        tree.vertices.push_back(0.5f * (tree.vertices[middle[0]] + tree.vertices[middle[2]]));
        corners = {{{c[0], middle[0], centre, middle[3]},
                    {middle[0], c[1], middle[1], centre},
                    {centre, middle[1], c[2], middle[2]},
                    {middle[3], centre, middle[2], c[3]}}};
    } else {
        corners = {{{c[0], middle[0], middle[2], no_index},
                    {middle[0], c[1], middle[1], no_index},
                    {middle[2], middle[1], c[2], no_index},
                    {middle[0], middle[1], middle[2], no_index}}};
    }
    for (std::size_t k = 0; k < 4; ++k) {
        ElementNode child = parent;
        child.parent = n;
        child.children = {no_index, no_index, no_index, no_index};
        child.corners = corners[k];
        child.level = static_cast<std::uint16_t>(parent.level + 1);
        measure(tree, child);
        child.normal = parent.normal;
        tree.nodes[n].children[k] = static_cast<std::uint32_t>(tree.nodes.size());
        tree.nodes.push_back(child);
    }
}

std::uint32_t leaf_under(const ElementTree& tree, std::uint32_t root, glm::vec3 point) {
    std::uint32_t n = root;
    while (!tree.nodes[n].is_leaf()) {
        // Children are parted by straight lines (of a bilinear quadrilateral too): the one that the point is deepest
        // in.
        float best = -1e30f;
        std::uint32_t inside = tree.nodes[n].children[0];
        for (const std::uint32_t child : tree.nodes[n].children) {
            const ElementNode& node = tree.nodes[child];
            const int count = corner_count(node);
            float depth = 1e30f;
            for (int k = 0; k < count; ++k) {
                const glm::vec3 a = tree.vertices[node.corners[static_cast<std::size_t>(k)]],
                                b = tree.vertices[node.corners[static_cast<std::size_t>((k + 1) % count)]];
                const glm::vec3 inward = glm::cross(node.normal, b - a);
                const float length = glm::length(inward);
                if (length > 0) depth = std::min(depth, glm::dot(point - a, inward) / length);
            }
            if (depth > best) best = depth, inside = child;
        }
        n = inside;
    }
    return n;
}

SurfacePoint point_on(const ElementTree& tree, std::uint32_t n, glm::vec2 u) {
    if (tree.nodes[n].is_cluster()) {
        const ElementNode& cluster = tree.nodes[n];
        const double first = tree.root_area_before[cluster.first_root],
                     last = tree.root_area_before[cluster.first_root + cluster.root_count];
        const double target = first + double(u.x) * (last - first);
        const auto begin = tree.root_area_before.begin() + cluster.first_root + 1;
        const auto found = std::upper_bound(begin, begin + cluster.root_count - 1, target);
        const std::size_t k = static_cast<std::size_t>(found - tree.root_area_before.begin()) - 1;
        const double size = tree.root_area_before[k + 1] - tree.root_area_before[k];
        u.x = size > 0 ? static_cast<float>(std::clamp((target - tree.root_area_before[k]) / size, 0.0, 1.0)) : 0.5f;
        n = tree.root_order[k];
    }
    const ElementNode& node = tree.nodes[n];
    const auto p = [&](std::size_t k) { return tree.vertices[node.corners[k]]; };
    glm::vec3 a = p(0), b = p(1), c = p(2);
    if (node.shape == ElementShape::quadrilateral) {
        const float first = glm::length(glm::cross(b - a, c - a)), second = glm::length(glm::cross(c - a, p(3) - a));
        const float share = first / std::max(first + second, 1e-30f);
        if (u.x < share) {
            u.x /= share;
        } else {
            u.x = std::min((u.x - share) / std::max(1 - share, 1e-30f), 1.0f);
            b = c, c = p(3);
        }
    }
    const glm::vec2 w = triangle_point(u);
    return {a + w.x * (b - a) + w.y * (c - a), node.normal, node.centre};
}

std::array<float, 4> corner_weights(const ElementTree& tree, std::uint32_t n, glm::vec3 point) {
    const ElementNode& node = tree.nodes[n];
    const glm::dvec3 a = tree.vertices[node.corners[0]], b = tree.vertices[node.corners[1]],
                     c = tree.vertices[node.corners[2]], q = point, normal = node.normal;
    if (node.shape != ElementShape::quadrilateral) {
        const double whole = glm::dot(glm::cross(b - a, c - a), normal);
        if (!(whole > 0)) return {1, 0, 0, 0};
        double wb = std::clamp(glm::dot(glm::cross(q - a, c - a), normal) / whole, 0.0, 1.0);
        double wc = std::clamp(glm::dot(glm::cross(b - a, q - a), normal) / whole, 0.0, 1.0);
        const double over = std::max(1.0, wb + wc);
        wb /= over, wc /= over;
        return {static_cast<float>(1 - wb - wc), static_cast<float>(wb), static_cast<float>(wc), 0};
    }
    // Newton on the bilinear map; it is nearly affine in a convex quadrilateral, so few steps do.
    const glm::dvec3 d = tree.vertices[node.corners[3]];
    double u = 0.5, v = 0.5;
    for (int step = 0; step < 6; ++step) {
        const glm::dvec3 du = (1 - v) * (b - a) + v * (c - d), dv = (1 - u) * (d - a) + u * (c - b);
        const glm::dvec3 off = q - ((1 - u) * (1 - v) * a + u * (1 - v) * b + u * v * c + (1 - u) * v * d);
        const double whole = glm::dot(glm::cross(du, dv), normal);
        if (!(whole > 0)) break;
        u = std::clamp(u + glm::dot(glm::cross(off, dv), normal) / whole, 0.0, 1.0);
        v = std::clamp(v + glm::dot(glm::cross(du, off), normal) / whole, 0.0, 1.0);
    }
    return {static_cast<float>((1 - u) * (1 - v)), static_cast<float>(u * (1 - v)), static_cast<float>(u * v),
            static_cast<float>((1 - u) * v)};
}

void vertices_on_edge(const ElementTree& tree, std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& between) {
    const auto found = tree.edge_middle.find(Bisection::edge_key(a, b));
    if (found == tree.edge_middle.end()) return;
    vertices_on_edge(tree, a, found->second, between);
    between.push_back(found->second);
    vertices_on_edge(tree, found->second, b, between);
}

} // namespace lueur
