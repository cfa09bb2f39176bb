// Pairs of polygons with occluders, as `lueur form-factors` reads them.
//
//     {"cases": [{"name": "walls", "polygon1": [[0, 0, 0], [1, 0, 0], [1, 1, 0]], "polygon2": [...],
//                 "occluders": [[[x, y, z], ...], ...]}]}
//
// Planar convex polygons in metres (or any one unit: form factors do not depend on it), each facing the side from which
// its vertices run counter-clockwise. name (default: case 1, case 2, ...) and occluders may be missing; unknown keys
// are ignored.
#pragma once

#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "core/transport/planar_polygon.h"

namespace lueur {

struct FormFactorCase {
    std::string name;
    PlanarPolygon polygon1, polygon2;
    std::vector<PlanarPolygon> occluders;
};

// All errors in one go, each `FILE:LINE:COLUMN: what is wrong; what is allowed`.
std::expected<std::vector<FormFactorCase>, std::vector<std::string>> parse_form_factor_cases(std::string_view text,
                                                                                             const std::string& file);

} // namespace lueur
