// Colour spaces of displays: matrices from chromaticities, never typed in.
#pragma once

#include <glm/glm.hpp>

#include "core/spectrum/wavelengths.h"

namespace lueur {

struct Chromaticity {
    double x = 0, y = 0;
    bool operator==(const Chromaticity&) const = default;
};

struct RgbSpace {
    Chromaticity red, green, blue, white;
    bool operator==(const RgbSpace&) const = default;
};

inline constexpr RgbSpace srgb{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}}; // IEC 61966-2-1

glm::dmat3 xyz_from_rgb(const RgbSpace& space); // RGB (1,1,1) -> the white point with Y = 1
glm::dmat3 rgb_from_xyz(const RgbSpace& space);

Chromaticity chromaticity(const Xyz& xyz); // (0,0) for black

double srgb_encode(double linear); // IEC 61966-2-1 piecewise curve, 0..1 -> 0..1
double srgb_decode(double encoded);

} // namespace lueur
