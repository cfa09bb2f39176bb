// Pictures of where the methods of form factors fail: error against distance, angle, size, length and occluder; what a
// patch that moves by parts of a pixel does.
#pragma once

#include <optional>
#include <string>

#include "editor/commands/batch_session.h"
#include "editor/commands/form_factor_cases.h"

namespace lueur {

// Families of pairs, one number each; floor squares of 1 m where nothing else is said.
FormFactorCase opposed_squares(double distance);
FormFactorCase hinged_squares(double degrees, double size); // with a common edge
FormFactorCase opposed_strips(double length);               // 1 m wide, 1 m apart
FormFactorCase behind_bar(double bar);                      // squares 1 m apart, a bar of that width half way
FormFactorCase small_above(double size);                    // a square 1 m above the middle of the floor square
PlanarPolygon rectangle_above(double x, double y, double height, double across, double along); // faces down

struct FormFactorPictures {
    std::string failures, aliasing; // SVG
};
// Nothing when it was cancelled.
std::optional<FormFactorPictures> form_factor_pictures(const FormFactorSettings& settings, BatchSession& session);

} // namespace lueur
