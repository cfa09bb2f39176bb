// White light by temperature: the planckian and the daylight locus, and the nearest temperature to a colour.
#pragma once

#include <optional>

#include "core/spectrum/cieluv.h"

namespace lueur {

// Second radiation constant hc/k in nm K, exact since the SI of 2019. CIE's illuminant A is printed with 1.435e7 and
// its daylight temperatures with 1.438e7: multiply a temperature by c2 / c2_of_then.
inline constexpr double second_radiation_constant = 1.438776877e7;

// Colour of a black body, Y = 1. Planck's law summed at 1 nm over 360..830 nm; kelvin > 0.
Xyz planckian_xyz(double kelvin);

struct ColourTemperature {
    double kelvin = 0; // correlated colour temperature
    double duv = 0;    // distance from the planckian locus in uv 1960, positive above it (green), as ANSI C78.377
};

inline constexpr double least_colour_temperature = 1000, most_colour_temperature = 25000; // kelvin
inline constexpr double most_duv = 0.05; // beyond it CIE 15:2018 gives no correlated colour temperature

// The temperature whose planckian uv 1960 lies nearest, found on the locus itself (no fitted polynomial): within 0.1 K.
// None for black, for a chromaticity further than 0.05 from the locus, and outside 1000..25000 K.
std::optional<ColourTemperature> colour_temperature(const Xyz& xyz);

// CIE daylight (CIE 15:2018), 4000..25000 K: a temperature outside is held to the nearer end.
inline constexpr double least_daylight_temperature = 4000, most_daylight_temperature = 25000; // kelvin
Chromaticity daylight_chromaticity(double kelvin);
// Relative, 100 at 560 nm, each 5 nm from 300 to 830 nm. D65 is daylight(6500 * 1.4388 / 1.4380), about 6504 K.
Spectrum daylight(double kelvin);

} // namespace lueur
