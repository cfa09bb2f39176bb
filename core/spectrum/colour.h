// Colour spaces of displays: matrices from chromaticities, never typed in.
#pragma once

#include <array>
#include <expected>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/spectrum/wavelengths.h"

namespace lueur {

struct Chromaticity {
    double x = 0, y = 0;
    bool operator==(const Chromaticity&) const = default;
};

// The lecture's display: chromaticities x_r y_r .. of its phosphors, x_w y_w of its white point, and Y_w, the luminance
// of its white in cd m^-2, or 1 where colours are relative to it.
struct RgbSpace {
    Chromaticity red, green, blue, white;
    double white_luminance = 1;
    bool operator==(const RgbSpace&) const = default;
};

inline constexpr Chromaticity d65_white{0.3127, 0.3290};                             // ITU-R BT.709, as rounded there
inline constexpr RgbSpace srgb{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, d65_white}; // IEC 61966-2-1
inline constexpr RgbSpace rec2020{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, d65_white};    // ITU-R BT.2020
inline constexpr RgbSpace display_p3{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, d65_white}; // SMPTE EG 432-1
// The lecture names no phosphors, only the white D6500 and its source for displays, Hall 1989 ("Illumination and Color
// in Computer Generated Imagery"): these are the colour monitor of that book.
inline constexpr RgbSpace lecture_monitor{{0.628, 0.346}, {0.268, 0.588}, {0.150, 0.070}, {0.313, 0.329}};

struct NamedRgbSpace {
    std::string_view name;
    RgbSpace space;
};
inline constexpr std::array rgb_spaces{
    NamedRgbSpace{"srgb", srgb},
    NamedRgbSpace{"rec709", srgb}, // the same phosphors; the transfer curve differs
    NamedRgbSpace{"rec2020", rec2020},
    NamedRgbSpace{"display_p3", display_p3},
    NamedRgbSpace{"lecture", lecture_monitor},
};
std::optional<RgbSpace> rgb_space_named(std::string_view name);

// A display of one's own: refuses phosphors on one line, a white outside their triangle, luminances not above 0 and
// numbers that are not finite. The error says what is allowed.
std::expected<RgbSpace, std::string> make_rgb_space(const RgbSpace& wanted);

glm::dmat3 xyz_from_rgb(const RgbSpace& space); // RGB (1,1,1) -> the white point with Y = white_luminance
glm::dmat3 rgb_from_xyz(const RgbSpace& space);

// xyY: a chromaticity and Y. Black, whose chromaticity is not defined, has (0,0).
Chromaticity chromaticity(const Xyz& xyz);
Xyz xyz_from_chromaticity(const Chromaticity& xy, double luminance); // (0,0,0) where y is 0

double srgb_encode(double linear); // IEC 61966-2-1 piecewise curve, 0..1 -> 0..1
double srgb_decode(double encoded);

} // namespace lueur
