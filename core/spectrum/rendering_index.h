// How true colours look under a light: the colour rendering indices of CIE 13.3-1995.
#pragma once

#include <array>
#include <optional>

#include "core/spectrum/colour_temperature.h"

namespace lueur {

inline constexpr int test_colour_count = 14;

// Reflectance of test-colour sample 1..14 of CIE 13.3-1995, 380..780 nm at 5 nm. R9 is strong red, R13 the European
// complexion, R14 a leaf.
const Spectrum& test_colour_sample(int number);

struct ColourRendering {
    ColourTemperature temperature;                   // of the light, and of the reference it is held against
    double reference_distance = 0;                   // Delta C: from the reference in uv 1960
    std::array<double, test_colour_count> special{}; // R1 .. R14, not rounded; below 0 where a colour is lost
    double general = 0;                              // Ra, the mean of R1 .. R8
};

// CIE 13.3 allows no further distance from the reference: beyond it the indices are computed but say little.
inline constexpr double most_reference_distance = 5.4e-3;
bool within_reference(const ColourRendering& rendering);

// `light` in any unit; what is emitted outside 360..830 nm does not count. The reference is Planck's law below 5000 K
// and CIE daylight from there on. None where the light has no correlated colour temperature.
std::optional<ColourRendering> colour_rendering(const Spectrum& light);

} // namespace lueur
