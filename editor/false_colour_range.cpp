#include "editor/false_colour_range.h"

namespace lueur {

FalseColourSettings fitted_to(const FalseColourSettings& scale, const Field& field, const std::vector<float>& areas,
                              PictureQuantity quantity) {
    if (!scale.automatic) return scale;
    const auto& xyz = quantity == PictureQuantity::illuminance ? field.irradiance_xyz : field.reflected_xyz;
    std::vector<float> values;
    values.reserve(xyz.size());
    for (const glm::vec3& value : xyz) values.push_back(value.y);
    return fitted(scale, values, areas);
}

const FalseColourSettings& scale_of(const DisplaySettings& display, PictureQuantity quantity) {
    switch (quantity) {
    case PictureQuantity::colour:
    case PictureQuantity::luminance:
        return display.luminance_scale;
    case PictureQuantity::illuminance:
        return display.illuminance_scale;
    case PictureQuantity::colour_difference:
        return colour_difference_scale();
    case PictureQuantity::error:
        return error_scale();
    }
    return display.luminance_scale;
}

std::string_view unit_of(PictureQuantity quantity) {
    switch (quantity) {
    case PictureQuantity::colour:
    case PictureQuantity::luminance:
        return "cd/m2";
    case PictureQuantity::illuminance:
        return "lx";
    case PictureQuantity::colour_difference:
        return "dE2000";
    case PictureQuantity::error:
        return "%";
    }
    return {};
}

} // namespace lueur
