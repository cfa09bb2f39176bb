#include "core/transport/planar_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace lueur {

namespace {

glm::dvec3 area_vector(std::span<const glm::dvec3> corners) { // Newell's, seen from the first corner
    glm::dvec3 sum(0);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        sum += glm::cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    return 0.5 * sum;
}

double squared(glm::dvec3 v) {
    return glm::dot(v, v);
}

// Least distance between two segments (Ericson 2005, 5.1.9).
double segment_distance(glm::dvec3 p, glm::dvec3 p2, glm::dvec3 q, glm::dvec3 q2) {
    const glm::dvec3 d1 = p2 - p, d2 = q2 - q, r = p - q;
    const double a = squared(d1), e = squared(d2), b = glm::dot(d1, d2), c = glm::dot(d1, r), f = glm::dot(d2, r);
    const double across = a * e - b * b;
    double s = across > 1e-14 * a * e ? std::clamp((b * f - c * e) / across, 0.0, 1.0) : 0.0;
    double t = (b * s + f) / e;
    if (t < 0) {
        t = 0;
        s = std::clamp(-c / a, 0.0, 1.0);
    } else if (t > 1) {
        t = 1;
        s = std::clamp((b - c) / a, 0.0, 1.0);
    }
    return glm::length((p + s * d1) - (q + t * d2));
}

bool over_polygon(const PlanarPolygon& polygon, glm::dvec3 point) {
    const std::size_t n = polygon.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const glm::dvec3 edge = polygon.corners[(k + 1) % n] - polygon.corners[k];
        if (glm::dot(glm::cross(polygon.normal, edge), point - polygon.corners[k]) < 0) return false;
    }
    return true;
}

// From the points of the edges of `a` to the inside of `b`; 0 where an edge goes through.
double distance_to_face(const PlanarPolygon& a, const PlanarPolygon& b) {
    double least = std::numeric_limits<double>::max();
    const std::size_t n = a.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const glm::dvec3 p = a.corners[k], q = a.corners[(k + 1) % n];
        const double hp = glm::dot(b.normal, p - b.corners[0]), hq = glm::dot(b.normal, q - b.corners[0]);
        if (over_polygon(b, p)) least = std::min(least, std::abs(hp));
        if ((hp < 0) != (hq < 0) && over_polygon(b, p + (hp / (hp - hq)) * (q - p))) return 0;
    }
    return least;
}

struct Triangle {
    glm::dvec3 a, b, c;
};

} // namespace

std::expected<PlanarPolygon, std::string> make_planar_polygon(std::vector<glm::dvec3> corners) {
    if (corners.size() < 3)
        return std::unexpected(fmt::format("has {} corners; at least 3 are allowed", corners.size()));
    double size = 0;
    for (const glm::dvec3& p : corners) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return std::unexpected(std::string("has a corner that is not finite; finite numbers are allowed"));
        size = std::max(size, glm::length(p - corners[0]));
    }
    const glm::dvec3 vector = area_vector(corners);
    PlanarPolygon polygon{std::move(corners), {}, glm::length(vector)};
    if (!(polygon.area > 1e-14 * size * size))
        return std::unexpected(std::string("has no area; a polygon that is not a line or a point is allowed"));
    polygon.normal = vector / polygon.area;
    const std::size_t n = polygon.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const glm::dvec3 p = polygon.corners[k], next = polygon.corners[(k + 1) % n],
                         after = polygon.corners[(k + 2) % n];
        if (std::abs(glm::dot(polygon.normal, p - polygon.corners[0])) > 1e-5 * size)
            return std::unexpected(
                std::string("is not planar; corners within 0.00001 of its size of one plane are allowed"));
        if (glm::dot(glm::cross(next - p, after - next), polygon.normal) <
            -1e-6 * glm::length(next - p) * glm::length(after - next))
            return std::unexpected(std::string("is not convex; cut it into convex polygons"));
    }
    return polygon;
}

glm::dvec3 centre(const PlanarPolygon& polygon) {
    const auto& p = polygon.corners;
    glm::dvec3 sum(0);
    double weight = 0;
    for (std::size_t k = 1; k + 1 < p.size(); ++k) {
        const double area = 0.5 * glm::dot(glm::cross(p[k] - p[0], p[k + 1] - p[0]), polygon.normal);
        sum += area / 3 * ((p[k] - p[0]) + (p[k + 1] - p[0]));
        weight += area;
    }
    return p[0] + sum / weight;
}

double radius(const PlanarPolygon& polygon) {
    const glm::dvec3 c = centre(polygon);
    double most = 0;
    for (const glm::dvec3& p : polygon.corners) most = std::max(most, glm::length(p - c));
    return most;
}

double width(const PlanarPolygon& polygon) {
    double least = std::numeric_limits<double>::max();
    const std::size_t n = polygon.corners.size();
    for (std::size_t k = 0; k < n; ++k) { // the least width of a convex polygon is across one of its edges
        const glm::dvec3 edge = polygon.corners[(k + 1) % n] - polygon.corners[k];
        if (squared(edge) == 0) continue;
        const glm::dvec3 inward = glm::normalize(glm::cross(polygon.normal, edge));
        double across = 0;
        for (const glm::dvec3& p : polygon.corners) across = std::max(across, glm::dot(inward, p - polygon.corners[k]));
        least = std::min(least, across);
    }
    return least;
}

PlanarPolygon scaled(const PlanarPolygon& polygon, glm::dvec3 origin, double factor) {
    PlanarPolygon result = polygon;
    for (glm::dvec3& p : result.corners) p = (p - origin) * factor;
    result.area *= factor * factor;
    return result;
}

PlanarPolygon clipped(const PlanarPolygon& polygon, glm::dvec3 normal, double offset, double tolerance) {
    const std::size_t n = polygon.corners.size();
    std::vector<double> height(n);
    bool any_behind = false, any_before = false;
    for (std::size_t k = 0; k < n; ++k) {
        height[k] = glm::dot(normal, polygon.corners[k]) - offset;
        if (std::abs(height[k]) <= tolerance) height[k] = 0;
        any_behind = any_behind || height[k] < 0;
        any_before = any_before || height[k] > 0;
    }
    if (!any_before) return {{}, polygon.normal, 0};
    if (!any_behind) return polygon;
    PlanarPolygon result{{}, polygon.normal, 0};
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t next = (k + 1) % n;
        if (height[k] >= 0) result.corners.push_back(polygon.corners[k]);
        if ((height[k] > 0 && height[next] < 0) || (height[k] < 0 && height[next] > 0))
            result.corners.push_back(polygon.corners[k] + (height[k] / (height[k] - height[next])) *
                                                              (polygon.corners[next] - polygon.corners[k]));
    }
    result.area = result.corners.size() < 3 ? 0 : glm::dot(area_vector(result.corners), polygon.normal);
    if (!(result.area > 0)) return {{}, polygon.normal, 0};
    return result;
}

PlanarPolygon in_front_of(const PlanarPolygon& polygon, const PlanarPolygon& other) {
    double size = 0; // heights are rounded by as much as the coordinates they come from
    PlanarPolygon local = polygon;
    for (glm::dvec3& p : local.corners) size = std::max(size, glm::length(p -= other.corners[0]));
    PlanarPolygon result = clipped(local, other.normal, 0, 1e-14 * size);
    for (glm::dvec3& p : result.corners) p += other.corners[0];
    return result;
}

double distance(const PlanarPolygon& a, const PlanarPolygon& b) {
    double least = std::min(distance_to_face(a, b), distance_to_face(b, a));
    const std::size_t n = a.corners.size(), m = b.corners.size();
    for (std::size_t k = 0; k < n && least > 0; ++k)
        for (std::size_t l = 0; l < m; ++l)
            least = std::min(
                least, segment_distance(a.corners[k], a.corners[(k + 1) % n], b.corners[l], b.corners[(l + 1) % m]));
    return least;
}

std::vector<SubElement> sub_elements(const PlanarPolygon& polygon, int count) {
    const auto& p = polygon.corners;
    std::vector<SubElement> elements;
    if (count <= 1) {
        elements.push_back({centre(polygon), polygon.area, 2 * radius(polygon)});
        return elements;
    }
    if (p.size() == 4) { // cells of the bilinear map, as square as they come
        const double u = glm::length(p[1] - p[0]) + glm::length(p[2] - p[3]),
                     v = glm::length(p[2] - p[1]) + glm::length(p[3] - p[0]);
        const int across = std::clamp(static_cast<int>(std::lround(std::sqrt(count * u / v))), 1, count);
        const int along = (count + across - 1) / across;
        const auto point = [&](int i, int j) {
            const double s = double(i) / across, t = double(j) / along;
            return (1 - t) * ((1 - s) * p[0] + s * p[1]) + t * ((1 - s) * p[3] + s * p[2]);
        };
        for (int j = 0; j < along; ++j)
            for (int i = 0; i < across; ++i) {
                const PlanarPolygon cell{
                    {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)}, polygon.normal, 0};
                const double area = glm::dot(area_vector(cell.corners), polygon.normal);
                if (!(area > 0)) continue;
                const double size = std::max(glm::length(cell.corners[2] - cell.corners[0]),
                                             glm::length(cell.corners[3] - cell.corners[1]));
                elements.push_back({centre(cell), area, size});
            }
        return elements;
    }
    // Triangles of the fan, the longest edge halved until there are enough: about equal areas.
    std::vector<Triangle> triangles;
    for (std::size_t k = 1; k + 1 < p.size(); ++k) triangles.push_back({p[0], p[k], p[k + 1]});
    const auto area_of = [&](const Triangle& t) {
        return 0.5 * glm::dot(glm::cross(t.b - t.a, t.c - t.a), polygon.normal);
    };
    const auto less_area = [&](const Triangle& x, const Triangle& y) { return area_of(x) < area_of(y); };
    std::ranges::make_heap(triangles, less_area);
    while (static_cast<int>(triangles.size()) < count) {
        std::ranges::pop_heap(triangles, less_area);
        Triangle t = triangles.back();
        triangles.pop_back();
        const double ab = squared(t.b - t.a), bc = squared(t.c - t.b), ca = squared(t.a - t.c);
        if (bc >= ab && bc >= ca)
            t = {t.b, t.c, t.a};
        else if (ca >= ab)
            t = {t.c, t.a, t.b};
        const glm::dvec3 middle = 0.5 * (t.a + t.b);
        for (const Triangle& half : {Triangle{t.a, middle, t.c}, Triangle{middle, t.b, t.c}}) {
            triangles.push_back(half);
            std::ranges::push_heap(triangles, less_area);
        }
    }
    for (const Triangle& t : triangles)
        if (const double area = area_of(t); area > 0)
            elements.push_back({(t.a + t.b + t.c) / 3.0, area,
                                std::sqrt(std::max({squared(t.b - t.a), squared(t.c - t.b), squared(t.a - t.c)}))});
    return elements;
}

glm::dvec3 polygon_point(const PlanarPolygon& polygon, glm::dvec2 u) {
    const auto& p = polygon.corners;
    if (p.size() == 4 && squared((p[1] - p[0]) + (p[3] - p[2])) < 1e-24 * squared(p[2] - p[0]))
        return p[0] + u.x * (p[1] - p[0]) + u.y * (p[3] - p[0]); // a parallelogram
    double at = u.x * polygon.area;
    for (std::size_t k = 1; k + 1 < p.size(); ++k) {
        const double area = 0.5 * glm::dot(glm::cross(p[k] - p[0], p[k + 1] - p[0]), polygon.normal);
        if (at < area || k + 2 == p.size()) {
            const double s = std::clamp(at / area, 0.0, 1.0);
            // The square folded onto the triangle (Heitz 2019).
            glm::dvec2 w(s, u.y);
            if (w.y > w.x)
                w.x *= 0.5, w.y -= w.x;
            else
                w.y *= 0.5, w.x -= w.y;
            return p[0] + w.x * (p[k] - p[0]) + w.y * (p[k + 1] - p[0]);
        }
        at -= area;
    }
    return p[0];
}

} // namespace lueur
