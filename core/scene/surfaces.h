// Triangles -> surfaces: coplanar neighbours become one wall, neighbours that share smooth normals one curved patch.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace lueur {

// A triangle soup as a file gives it: positions in metres, Y up, and which object each triangle belongs to.
struct TriangleSoup {
    std::vector<Vertex> vertices;
    std::vector<glm::uvec3> triangles;
    std::vector<ObjectIndex> triangle_object;
};

// Drops degenerate (area 0 or height under 1e-7 of the longest edge) and not-finite triangles and says how many, of
// which object. Neighbours share an edge (positions welded at 1e-6 of the scene's size), the same object, and lie
// within 0.2 degrees and 1e-5 of the size of one plane; or have the same not-flat normals at both ends of the edge.
Geometry make_geometry(const TriangleSoup& soup, const std::vector<Object>& objects,
                       std::vector<std::string>& warnings);

// Fills Geometry::surface_area from its triangles; make_geometry has done it.
void measure_surfaces(Geometry& geometry);

} // namespace lueur
