#include "core/spectrum/colour.h"

#include <cmath>

namespace lueur {

// SMPTE RP 177: the columns are the primaries' XYZ, scaled so that their sum is the white.
glm::dmat3 xyz_from_rgb(const RgbSpace& space) {
    const auto column = [](const Chromaticity& c) { return glm::dvec3(c.x, c.y, 1 - c.x - c.y); };
    const glm::dmat3 primaries(column(space.red), column(space.green), column(space.blue));
    const glm::dvec3 scale = glm::inverse(primaries) * (column(space.white) / space.white.y);
    return {primaries[0] * scale[0], primaries[1] * scale[1], primaries[2] * scale[2]};
}

glm::dmat3 rgb_from_xyz(const RgbSpace& space) {
    return glm::inverse(xyz_from_rgb(space));
}

Chromaticity chromaticity(const Xyz& xyz) {
    const double sum = xyz.x + xyz.y + xyz.z;
    if (sum == 0) return {};
    return {xyz.x / sum, xyz.y / sum};
}

double srgb_encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

} // namespace lueur
