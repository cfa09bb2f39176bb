#include "core/scene/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lueur {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

// Twice the signed area.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return cross(b - a, c - a);
}

// Newell's normal (Sutherland, Sproull & Schumacker 1974): twice the area in length, sound for concave and bent
// polygons.
glm::dvec3 newell_normal(std::span<const glm::dvec3> polygon) {
    glm::dvec3 sum{0};
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += glm::cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    return sum;
}

glm::dvec3 triangle_normal(std::span<const glm::dvec3> p, const glm::uvec3& t) {
    return glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
}

// The cut of a quad: both triangles must face the quad's way; then the flatter one, then the shorter diagonal.
std::vector<glm::uvec3> quad_triangles(std::span<const glm::dvec3> p, const glm::dvec3& normal) {
    const std::vector<glm::uvec3> cuts[2] = {{{0, 1, 2}, {0, 2, 3}}, {{0, 1, 3}, {1, 2, 3}}};
    const double diagonal[2] = {glm::distance(p[0], p[2]), glm::distance(p[1], p[3])};
    double flatness[2];
    for (int i = 0; i < 2; ++i) {
        const glm::dvec3 a = triangle_normal(p, cuts[i][0]), b = triangle_normal(p, cuts[i][1]);
        const double lengths = glm::length(a) * glm::length(b);
        const bool faces = glm::dot(a, normal) > 0 && glm::dot(b, normal) > 0 && lengths > 0;
        flatness[i] = faces ? glm::dot(a, b) / lengths : -2;
    }
    if (std::max(flatness[0], flatness[1]) == -2) return {};
    if (std::abs(flatness[0] - flatness[1]) > 1e-12) return cuts[flatness[0] > flatness[1] ? 0 : 1];
    return cuts[diagonal[1] < diagonal[0] * (1 - 1e-9) ? 1 : 0];
}

struct EarClipper {
    std::vector<glm::dvec2> point; // counter-clockwise
    std::vector<std::uint32_t> next, previous;
    std::vector<double> quality; // of the ear at a vertex: its height over its longest edge; negative: no ear
    double tolerance;            // area below which a turn is straight

    explicit EarClipper(std::vector<glm::dvec2> points, double area)
        : point(std::move(points))
        , tolerance(1e-14 * area) {
        const auto n = static_cast<std::uint32_t>(point.size());
        for (std::uint32_t i = 0; i < n; ++i) {
            next.push_back((i + 1) % n);
            previous.push_back((i + n - 1) % n);
        }
        quality.resize(n);
        for (std::uint32_t i = 0; i < n; ++i) quality[i] = ear_quality(i);
    }

    double ear_quality(std::uint32_t i) const {
        const glm::dvec2 &a = point[previous[i]], &b = point[i], &c = point[next[i]];
        const double area = turn(a, b, c);
        if (area <= tolerance) return -1;
        for (std::uint32_t j = next[next[i]]; j != previous[i]; j = next[j]) {
            const glm::dvec2& p = point[j];
            if (p == a || p == b || p == c) continue; // the doubled edge of a hole
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return -1;
        }
        const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        return area / (longest * longest);
    }

    std::vector<glm::uvec3> clip() {
        std::vector<glm::uvec3> triangles;
        std::vector<std::uint32_t> left(point.size());
        std::iota(left.begin(), left.end(), 0u);
        bool all_are_fresh = true;
        while (left.size() > 2) {
            const auto best =
                std::max_element(left.begin(), left.end(), [&](auto a, auto b) { return quality[a] < quality[b]; });
            const std::uint32_t i = *best;
            if (quality[i] < 0) {
                if (!all_are_fresh) { // clipping elsewhere may have freed an ear
                    for (const std::uint32_t j : left) quality[j] = ear_quality(j);
                    all_are_fresh = true;
                    continue;
                }
                // Only straight corners and the two sides of a doubled edge may be left: they hold no area.
                const auto straight = std::find_if(left.begin(), left.end(), [&](auto j) {
                    return std::abs(turn(point[previous[j]], point[j], point[next[j]])) <= tolerance;
                });
                if (straight == left.end()) return {};
                remove(*straight, left);
                continue;
            }
            triangles.emplace_back(previous[i], i, next[i]);
            remove(i, left);
            all_are_fresh = false;
        }
        return triangles;
    }

    void remove(std::uint32_t i, std::vector<std::uint32_t>& left) {
        left.erase(std::find(left.begin(), left.end(), i));
        const std::uint32_t before = previous[i], after = next[i];
        next[before] = after;
        previous[after] = before;
        quality[before] = ear_quality(before);
        quality[after] = ear_quality(after);
    }
};

} // namespace

std::vector<glm::uvec3> triangle_fan(std::size_t vertex_count) {
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t i = 2; i < vertex_count; ++i) triangles.emplace_back(0u, i - 1, i);
    return triangles;
}

std::expected<std::vector<glm::uvec3>, std::string> triangulate(std::span<const glm::dvec3> polygon) {
    if (polygon.size() < 3) return std::unexpected("has fewer than 3 vertices");
    const glm::dvec3 sum = newell_normal(polygon);
    double perimeter = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        perimeter += glm::distance(polygon[i], polygon[(i + 1) % polygon.size()]);
    const double twice_area = glm::length(sum);
    if (!(twice_area > 1e-12 * perimeter * perimeter)) return std::unexpected("has no area");
    const glm::dvec3 normal = sum / twice_area;
    if (polygon.size() == 3) return std::vector<glm::uvec3>{{0, 1, 2}};

    std::vector<glm::uvec3> triangles;
    if (polygon.size() == 4) triangles = quad_triangles(polygon, normal);
    if (polygon.size() > 4) {
        const glm::dvec3 axis = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 u = glm::normalize(glm::cross(axis, normal)), v = glm::cross(normal, u);
        std::vector<glm::dvec2> flat;
        for (const glm::dvec3& p : polygon) flat.emplace_back(glm::dot(p - polygon[0], u), glm::dot(p - polygon[0], v));
        triangles = EarClipper(std::move(flat), twice_area).clip();
    }
    double covered =
        0; // as seen along the normal; a border that crosses itself is covered more than once or not at all
    for (const glm::uvec3& triangle : triangles) covered += glm::dot(triangle_normal(polygon, triangle), normal);
    if (std::abs(covered - twice_area) > 1e-6 * twice_area) return std::unexpected("has a border that crosses itself");
    return triangles;
}

} // namespace lueur
