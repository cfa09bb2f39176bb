// The automatic range of false colours: of the whole scene and not of what the camera sees, so that it stays while one
// walks about and is the same in the window and in files.
#pragma once

#include <string_view>
#include <vector>

#include "core/display/false_colour.h"
#include "core/solve/field.h"
#include "core/view/picture.h"

namespace lueur {

// `areas`: vertex_areas of the field's mesh. Luminance: of reflected light, since a lamp a thousand times brighter than
// its room would have the scale for itself.
FalseColourSettings fitted_to(const FalseColourSettings& scale, const Field& field, const std::vector<float>& areas,
                              PictureQuantity quantity);

// The scale and the unit of a quantity that false colours show; that of colour differences is the same for all.
const FalseColourSettings& scale_of(const DisplaySettings& display, PictureQuantity quantity);
std::string_view unit_of(PictureQuantity quantity);

} // namespace lueur
