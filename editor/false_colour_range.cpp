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

} // namespace lueur
