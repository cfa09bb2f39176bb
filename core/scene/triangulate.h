// A polygon in space -> triangles over its own vertices.
#pragma once

#include <expected>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace lueur {

// Triangles turn as the polygon does. Concave polygons, and holes joined to the border by a doubled edge, are cut by
// ear clipping (Meisters 1975). A quad that is not planar is cut along the diagonal that bends it less. Errors: no
// area, or a border that crosses itself.
std::expected<std::vector<glm::uvec3>, std::string> triangulate(std::span<const glm::dvec3> polygon);

// Without any test, for faces that triangulate() refuses: 0-1-2, 0-2-3, ...
std::vector<glm::uvec3> triangle_fan(std::size_t vertex_count);

} // namespace lueur
