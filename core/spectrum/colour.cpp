#include "core/spectrum/colour.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace lueur {

namespace {

// Twice the signed area of the triangle a b c.
double turn(const Chromaticity& a, const Chromaticity& b, const Chromaticity& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

} // namespace

std::optional<RgbSpace> rgb_space_named(std::string_view name) {
    const auto* const found = std::ranges::find(rgb_spaces, name, &NamedRgbSpace::name);
    if (found == rgb_spaces.end()) return {};
    return found->space;
}

std::expected<RgbSpace, std::string> make_rgb_space(const RgbSpace& wanted) {
    const auto& [red, green, blue, white, luminance] = wanted;
    for (const Chromaticity& c : {red, green, blue, white})
        if (!std::isfinite(c.x) || !std::isfinite(c.y) || std::abs(c.x) > 2 || std::abs(c.y) > 2)
            return std::unexpected(fmt::format("chromaticity ({}, {}); allowed: numbers from -2 to 2", c.x, c.y));
    if (!(luminance > 0) || !std::isfinite(luminance))
        return std::unexpected(fmt::format("luminance of white {}; allowed: a number above 0", luminance));
    const double area = turn(red, green, blue);
    if (std::abs(area) < 1e-6) return std::unexpected("phosphors on one line; allowed: three that span a triangle");
    for (const double side : {turn(red, green, white), turn(green, blue, white), turn(blue, red, white)})
        if (!(side / area > 0) || !(white.y > 0))
            return std::unexpected(fmt::format(
                "white ({}, {}); allowed: one inside the triangle of the phosphors and above y = 0", white.x, white.y));
    return wanted;
}

// SMPTE RP 177: the columns are the primaries' XYZ, scaled so that their sum is the white.
glm::dmat3 xyz_from_rgb(const RgbSpace& space) {
    const auto column = [](const Chromaticity& c) { return glm::dvec3(c.x, c.y, 1 - c.x - c.y); };
    const glm::dmat3 primaries(column(space.red), column(space.green), column(space.blue));
    const glm::dvec3 scale = glm::inverse(primaries) * (space.white_luminance / space.white.y * column(space.white));
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

Xyz xyz_from_chromaticity(const Chromaticity& xy, double luminance) {
    if (xy.y == 0) return Xyz(0);
    return luminance / xy.y * Xyz(xy.x, xy.y, 1 - xy.x - xy.y);
}

double srgb_encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

} // namespace lueur
