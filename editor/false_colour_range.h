// The automatic range of false colours: of the whole scene and not of what the camera sees, so that it stays while one
// walks about and is the same in the window and in files.
#pragma once

#include <vector>

#include "core/display/false_colour.h"
#include "core/solve/field.h"
#include "core/view/picture.h"

namespace lueur {

// `areas`: vertex_areas of the field's mesh. Luminance: of reflected light, since a lamp a thousand times brighter than
// its room would have the scale for itself.
FalseColourSettings fitted_to(const FalseColourSettings& scale, const Field& field, const std::vector<float>& areas,
                              PictureQuantity quantity);

} // namespace lueur
