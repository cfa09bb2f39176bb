#include "core/solve/hierarchy_links.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/transport/polygon_form_factor.h"
#include "core/transport/sampling.h"

namespace lueur {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

// cos cos / r^2 between two points; 0 where one is behind the other.
float exchange(glm::vec3 p, glm::vec3 n, glm::vec3 q, glm::vec3 m, float& r2) {
    const glm::vec3 d = q - p;
    r2 = glm::dot(d, d);
    const float a = glm::dot(d, n), b = -glm::dot(d, m);
    return a > 0 && b > 0 && r2 > 0 ? a * b / (r2 * r2) : 0;
}

// Exact from each point of `from` to the element `to`.
std::array<float, link_points> exact_from_points(const ElementTree& tree, const NodePoints& from, std::uint32_t to) {
    const ElementNode& node = tree.nodes[to];
    const std::size_t corners = node.shape == ElementShape::quadrilateral ? 4 : 3;
    std::array<glm::dvec3, 4> polygon;
    for (std::size_t k = 0; k < corners; ++k) polygon[k] = tree.vertices[node.corners[k]];
    std::array<float, link_points> factor{};
    for (int i = 0; i < from.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (glm::dot(from.position[k] - node.centre, node.normal) <= 0) continue;
        factor[k] =
            static_cast<float>(polygon_form_factor(from.position[k], from.normal[k], {polygon.data(), corners}));
    }
    return factor;
}

bool wholly_behind(const ElementTree& tree, const ElementNode& plane, const ElementNode& other) {
    const float tolerance = 1e-5f * (plane.radius + other.radius);
    if (glm::dot(other.centre - plane.centre, plane.normal) > other.radius) return false;
    if (other.is_cluster()) return glm::dot(other.centre - plane.centre, plane.normal) < -other.radius;
    for (const std::uint32_t c : other.corners)
        if (c != no_index && glm::dot(tree.vertices[c] - plane.centre, plane.normal) > tolerance) return false;
    return true;
}

} // namespace

NodePoints look_around(const World& world, ElementTree& tree, std::uint32_t n, float small) {
    constexpr std::uint32_t rays = 8, most_back_faces = 2; // a quarter, as find_buried
    ElementNode& node = tree.nodes[n];
    const std::uint32_t places = static_cast<std::uint32_t>(std::clamp(node.area / small, 4.0f, 32.0f));
    NodePoints points;
    std::uint32_t live = 0;
    bool closed = true;
    for (std::uint32_t k = 0; k < places; ++k) {
        const SurfacePoint p = point_on(tree, n, r2_point(k, {0.37f, 0.71f}));
        const glm::vec3 origin = ray_origin(p.position, p.normal, p.inward, world.epsilon());
        const Frame frame(p.normal);
        std::uint32_t back_faces = 0, lit = 0;
        for (std::uint32_t r = 0; r < rays; ++r) {
            const Hit hit = world.closest({origin, frame.world(cosine_direction(r2_point(k * rays + r, {0, 0})))});
            back_faces += hit.back_face, lit += hit.element != no_index;
        }
        if (back_faces > most_back_faces) continue;
        ++live;
        closed = closed && lit == rays;
        if (points.count < link_points) {
            points.position[static_cast<std::size_t>(points.count)] = origin;
            points.normal[static_cast<std::size_t>(points.count++)] = p.normal;
        }
    }
    node.live_share = static_cast<float>(live) / static_cast<float>(places);
    node.closed = closed && live > 0;
    return points;
}

double visible_corners(const World& world, const ElementTree& tree, glm::vec3 position, glm::vec3 normal,
                       std::uint32_t n, std::uint64_t& rays) {
    constexpr float inside = 0.01f; // of the way to the middle: the corner itself lies in the next wall
    const ElementNode& node = tree.nodes[n];
    if (glm::dot(position - node.centre, node.normal) <= 0) return 0;
    int before = 0, seen = 0;
    for (const std::uint32_t c : node.corners) {
        if (c == no_index) continue;
        const glm::vec3 corner = tree.vertices[c], d = corner + inside * (node.centre - corner) - position;
        if (glm::dot(d, normal) <= 0) continue;
        ++before, ++rays;
        seen += !world.occluded({position, d, 1e-5f, 1 - 1e-3f});
    }
    return before > 0 ? double(seen) / before : 0;
}

LinkEstimate estimate_link(const World& world, const ElementTree& tree, const std::vector<NodePoints>& points,
                           std::uint32_t receiver, std::uint32_t source, LinkKernel kernel) {
    LinkEstimate estimate;
    const ElementNode &r = tree.nodes[receiver], &s = tree.nodes[source];
    const NodePoints &p = points[receiver], &q = points[source];
    if (p.count == 0 || q.count == 0) return estimate;

    // Visibility between pairs of points: those on the diagonal first; where they agree, they settle it.
    std::array<std::array<float, link_points>, link_points> g{}, disk{};
    std::array<std::array<bool, link_points>, link_points> seen{}, looked{};
    const float part = std::max(r.live_area() / float(p.count), s.live_area() / float(q.count)); // m^2
    const auto looks = [&](std::size_t i, std::size_t j) {
        ++estimate.rays;
        // The same ray for both links of a pair, so that both see the same.
        const bool forward = receiver < source;
        const glm::vec3 from = forward ? p.position[i] : q.position[j], to = forward ? q.position[j] : p.position[i];
        return !world.occluded({from, to - from, 1e-5f, 1 - 1e-5f});
    };
    int facing = 0, clear = 0;
    const auto pc = static_cast<std::size_t>(p.count), qc = static_cast<std::size_t>(q.count);
    for (std::size_t i = 0; i < pc; ++i)
        for (std::size_t j = 0; j < qc; ++j) {
            float r2;
            g[i][j] = exchange(p.position[i], p.normal[i], q.position[j], q.normal[j], r2);
            disk[i][j] = g[i][j] > 0 ? g[i][j] * r2 / (pi * r2 + part) : 0;
        }
    const std::size_t most = std::max(pc, qc);
    for (std::size_t k = 0; k < most; ++k) {
        const std::size_t i = k % pc, j = k % qc;
        if (g[i][j] <= 0) continue;
        ++facing;
        looked[i][j] = true;
        seen[i][j] = looks(i, j);
        clear += seen[i][j];
    }
    const bool settled = facing >= 3 && (clear == 0 || clear == facing);
    for (std::size_t i = 0; i < pc; ++i)
        for (std::size_t j = 0; j < qc; ++j) {
            if (g[i][j] <= 0) continue;
            if (settled)
                seen[i][j] = clear > 0;
            else if (!looked[i][j])
                seen[i][j] = looks(i, j);
        }

    double all = 0, visible = 0;
    std::array<double, link_points> all_at{}, visible_at{}, disk_at{},
        disk_of{}; // of receiver points, of source points
    int pairs = 0;
    for (std::size_t i = 0; i < pc; ++i)
        for (std::size_t j = 0; j < qc; ++j) {
            all_at[i] += g[i][j];
            pairs += g[i][j] > 0;
            if (!seen[i][j]) continue;
            visible_at[i] += g[i][j];
            disk_at[i] += disk[i][j];
            disk_of[j] += disk[i][j];
        }
    for (std::size_t i = 0; i < pc; ++i) all += all_at[i], visible += visible_at[i];

    std::array<double, link_points> at_point{}; // F of each of the receiver's points
    double mean = 0, unsure = 0;                // standard error of F itself: of few points of a source, of few rays
    if (kernel == LinkKernel::disks || r.is_cluster() || s.is_cluster()) {
        for (std::size_t i = 0; i < pc; ++i) {
            at_point[i] = double(s.live_area()) * disk_at[i] / double(q.count);
            mean += at_point[i] / double(p.count);
        }
        double square = 0;
        for (std::size_t j = 0; j < qc; ++j)
            square += std::pow(double(s.live_area()) * disk_of[j] / double(p.count) - mean, 2);
        unsure = qc > 1 ? std::sqrt(square / double(qc * (qc - 1))) : 0;
    } else {
        double share = all > 0 ? visible / all : 0;
        if (!(all > 0)) { // none of the points face: slivers near an edge
            std::uint64_t rays = 0;
            for (std::size_t i = 0; i < pc; ++i)
                share = std::max(share, visible_corners(world, tree, p.position[i], p.normal[i], source, rays));
            for (std::size_t j = 0; j < qc && !(share > 0); ++j)
                share = visible_corners(world, tree, q.position[j], q.normal[j], receiver, rays);
            estimate.rays += static_cast<std::uint32_t>(rays);
        }
        const auto exact = exact_from_points(tree, p, source);
        for (std::size_t i = 0; i < pc; ++i)
            at_point[i] = double(exact[i]) * s.live_share * (all_at[i] > 0 ? visible_at[i] / all_at[i] : share);
        if (r.area < s.area || (r.area == s.area && receiver < source)) {
            for (std::size_t i = 0; i < pc; ++i) mean += exact[i] / double(p.count);
            mean *= share * s.live_share;
        } else {
            for (const float f : exact_from_points(tree, q, receiver)) mean += f / double(q.count);
            mean *= share * s.live_share * s.area / r.area; // F_sr live_r, times A_s live_s / (A_r live_r)
        }
        if (pairs > 0 && share > 0) unsure = mean * std::sqrt((1 - share) / (share * pairs));
    }
    double of_points = 0, square = 0;
    for (std::size_t i = 0; i < pc; ++i) of_points += at_point[i] / double(p.count);
    for (std::size_t i = 0; i < pc; ++i) square += (at_point[i] - of_points) * (at_point[i] - of_points);
    estimate.form_factor = static_cast<float>(std::min(mean, 1.0));
    estimate.spread =
        static_cast<float>(p.count > 1 ? std::sqrt(square / double(p.count - 1) + unsure * unsure) : mean);
    return estimate;
}

bool can_face(const ElementTree& tree, std::uint32_t a, std::uint32_t b) {
    const ElementNode &p = tree.nodes[a], &q = tree.nodes[b];
    if (!p.is_cluster() && wholly_behind(tree, p, q)) return false;
    return q.is_cluster() || !wholly_behind(tree, q, p);
}

float lecture_form_factor(const ElementTree& tree, std::uint32_t receiver, std::uint32_t source) {
    const ElementNode &r = tree.nodes[receiver], &s = tree.nodes[source];
    const glm::vec3 d = s.centre - r.centre;
    const float distance = glm::length(d);
    if (distance <= s.radius) return 1;
    const float half_angle = std::asin(s.radius / distance);
    const float theta = std::acos(std::clamp(glm::dot(d, r.normal) / distance, -1.0f, 1.0f));
    const float cosine = std::cos(std::max(0.0f, theta - half_angle));
    const float solid_angle = 2 * pi * (1 - std::cos(half_angle));
    return std::clamp(cosine * solid_angle / pi, 0.0f, 1.0f);
}

} // namespace lueur
