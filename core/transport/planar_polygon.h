// Planar convex polygons in double precision: what form factors are taken between.
#pragma once

#include <expected>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace lueur {

struct PlanarPolygon {
    std::vector<glm::dvec3> corners; // m; counter-clockwise from the front, at least 3, convex
    glm::dvec3 normal{0};            // unit, towards the front
    double area = 0;                 // m^2, above 0
};

// The error says what is wrong with the corners: fewer than 3, not finite, no area, not planar to 1e-5 of the size
// (written with six digits it still is), not convex.
std::expected<PlanarPolygon, std::string> make_planar_polygon(std::vector<glm::dvec3> corners);

glm::dvec3 centre(const PlanarPolygon& polygon); // of area
double radius(const PlanarPolygon& polygon);     // from the centre to the furthest corner, m
double width(const PlanarPolygon& polygon);      // least distance between two parallel lines around it, m
PlanarPolygon scaled(const PlanarPolygon& polygon, glm::dvec3 origin, double factor); // (p - origin) factor

// The part where dot(normal, p) >= offset (Sutherland & Hodgman 1974); fewer than 3 corners, area 0: nothing is left.
// Corners within `tolerance` of the plane count as on it.
PlanarPolygon clipped(const PlanarPolygon& polygon, glm::dvec3 normal, double offset, double tolerance);
// What of `polygon` lies in front of the plane of `other`.
PlanarPolygon in_front_of(const PlanarPolygon& polygon, const PlanarPolygon& other);

// Least distance between two polygons, m; 0 where they touch or cut.
double distance(const PlanarPolygon& a, const PlanarPolygon& b);

// Sub-elements of about equal size and shape that cover the polygon, `count` of them or a few more.
struct SubElement {
    glm::dvec3 centre;
    double area;
    double size; // longest edge, m
};
std::vector<SubElement> sub_elements(const PlanarPolygon& polygon, int count);

// A point spread uniformly over the polygon by u in the unit square, continuous inside each triangle of its fan.
glm::dvec3 polygon_point(const PlanarPolygon& polygon, glm::dvec2 u);

} // namespace lueur
