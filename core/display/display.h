// From the radiance of a pixel to what a monitor is sent: XYZ -> RGB -> /MAXDISPLAY -> clip -> gamma -> 0..255.
// (Lecture, chapter 11; Hall 1989 for the clipping rules. Gamma comes after the scaling: LECTURE corrections 19.)
// The window's shader (ui/shaders) implements the same function; a test holds the two within 1/255.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/spectrum/colour.h"

namespace lueur {

enum class ClipRule {
    clamp,             // each component to 0..MAXDISPLAY (the lecture's choice)
    keep_chromaticity, // scale the colour until its largest component fits; negatives clamped
    desaturate,        // keep luminance and hue, mix with grey of the same luminance until it fits
    scale_all,         // MAXDISPLAY is raised to the largest component of the picture: nothing is cut
};
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored                                                                                         \
    "-Wshadow" // GCC takes the scoped enumerator for a declaration that hides the colour space `srgb`
enum class TransferCurve { gamma, srgb };
#pragma GCC diagnostic pop

struct DisplaySettings {
    double max_display = 100;       // cd m^-2 shown as full white; > 0
    bool max_display_auto = true;   // follow the scene: chosen once when a scene is opened, and again on demand
    bool max_display_locked = true; // an edit never rescales the picture unasked
    ClipRule clip = ClipRule::clamp;
    TransferCurve curve = TransferCurve::srgb;
    double gamma = 2.2; // of TransferCurve::gamma; 0.1..10
    bool operator==(const DisplaySettings&) const = default;
};

std::string to_string(ClipRule rule);
std::string to_string(TransferCurve curve);
std::optional<ClipRule> parse_clip_rule(std::string_view text);
std::optional<TransferCurve> parse_transfer_curve(std::string_view text);

// Empty when the settings are usable; else one line a fault, with what is allowed (max_display finite and > 0, ...).
std::vector<std::string> check(const DisplaySettings& settings);

// One pixel, radiance as XYZ in cd m^-2 -> encoded RGB in 0..1. Not-finite input gives black.
glm::dvec3 display_pixel(const Xyz& radiance, const DisplaySettings& settings);

// A scene-referred picture: row-major from the top left, XYZ in cd m^-2.
struct RadianceImage {
    int width = 0, height = 0;
    std::vector<glm::vec3> xyz;
};
struct DisplayImage {
    int width = 0, height = 0;
    std::vector<std::array<std::uint8_t, 3>> rgb;
};

DisplayImage display_image(const RadianceImage& image, const DisplaySettings& settings); // resolves scale_all
double largest_component(const RadianceImage& image); // of linear RGB: what scale_all puts in the place of MAXDISPLAY

// MAXDISPLAY that shows `share` (0..1) of the pixels' or vertices' luminances unclipped, with 10 % headroom; ignores
// zeros.
double auto_max_display(std::vector<float> luminances, double share = 0.98);

} // namespace lueur
