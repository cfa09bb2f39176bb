// The exact form factor from a differential element to a polygon, without occlusion.
#pragma once

#include <span>

#include <glm/glm.hpp>

namespace lueur {

// Lambert 1760 (Baum, Rushmeier & Winget 1989, eq. 6): F = 1/(2 pi) sum_k Gamma_k . n, Gamma_k along v_k x v_(k+1) with
// the length of the angle between them, after the polygon is cut at the element's horizon. `polygon` is relative to any
// origin, counter-clockwise seen from its emitting side; at most 30 vertices. 0 when the element is behind the polygon.
// Dimensionless, 0..1.
double polygon_form_factor(glm::dvec3 point, glm::dvec3 normal, std::span<const glm::dvec3> polygon);

} // namespace lueur
