// A picture to set the gamma of a monitor by eye.
//
// Lines of full white and black, as wide as a pixel, give a known share of white's light whatever the monitor's curve
// is; beside them stands the code that should give the same light. From some metres away, or with half-closed eyes, the
// two melt into one where the curve is right. (Both kinds of patch lie on whole rows: a monitor may blur along a row,
// not across.) One column each for red, green, blue and grey; one row each for a quarter, a half and three quarters of
// the light.
#pragma once

#include "core/display/display.h"

namespace lueur {

inline constexpr int calibration_column_count = 4, calibration_row_count = 3;

// Codes 0..255 to be sent to the monitor as they are. Each cell is striped, with a solid middle of half its width and
// height.
DisplayImage calibration_picture(int width, int height, TransferCurve curve, const glm::dvec3& gamma);

} // namespace lueur
