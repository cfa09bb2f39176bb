// Form factors that do not depend on any sampling: without occluders, and behind a few of them.
#pragma once

#include <cstdint>
#include <span>

#include "core/transport/planar_polygon.h"

namespace lueur {

struct ExactFormFactor {
    double value = 0;
    double bound = 0; // of the absolute error: of rounding, or of the quadrature
    std::uint64_t evaluations = 0;
};

// Polygon to polygon without occlusion; what lies behind the plane of the other is cut away first. From polygons far
// apart to shared edges the error is below 1e-9 of the value; the bound says where rounding makes it more.
ExactFormFactor exact_form_factor(const PlanarPolygon& from, const PlanarPolygon& to);

// Behind opaque convex occluders: from each point of a quadrature over `from` the visible part of `to` is found
// exactly, by cutting the shadows out of it. Refined until the estimated error is `tolerance` of the value or `most`
// points are used.
ExactFormFactor occluded_form_factor(const PlanarPolygon& from, const PlanarPolygon& to,
                                     std::span<const PlanarPolygon> occluders, double tolerance, std::uint64_t most);

// Lambert's formula for a polygon that lies above the element's horizon; its magnitude is that of the terms, which
// cancel. Signed: below 0 where the polygon is seen from behind.
struct LambertSum {
    double value, magnitude;
};
LambertSum lambert_sum(glm::dvec3 point, glm::dvec3 normal, std::span<const glm::dvec3> corners);

} // namespace lueur
