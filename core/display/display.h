// From the radiance of a pixel to what a monitor is sent: XYZ -> RGB of the display -> /MAXDISPLAY -> tone operator ->
// clip -> gamma -> 0..255. (Lecture, chapter 11; gamma comes after the scaling: LECTURE corrections 19.)
// The window's shader (ui/shaders) implements the same function; a test holds the two within 1/255.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/display/display_settings.h"
#include "core/display/max_display.h"
#include "core/display/tone_operator.h"

namespace lueur {

// The display function with all that is the same for every pixel worked out. The settings' numbers are taken as they
// are: rules that choose them have been resolved (core/display/max_display.h).
struct DisplayFunction {
    glm::dmat3 rgb_from_xyz{1};      // of the display, MAXDISPLAY at 1
    glm::dvec3 luminance_weights{0}; // Y of each primary, the white's at 1
    ToneCurve tone;
    double divisor = 1; // ClipRule::scale_all: the largest component of the picture, at least 1
    ClipRule clip = ClipRule::clamp;
    TransferCurve curve = TransferCurve::srgb;
    glm::dvec3 gamma{2.2};
};
DisplayFunction make_display_function(const DisplaySettings& settings); // divisor 1

inline constexpr double largest_rgb = 1e36; // components are held to this, so that single precision holds them too

// Linear RGB of the display before it is clipped, white at 1. What is not finite gives black.
Rgb linear_display_rgb(const DisplayFunction& function, const Xyz& radiance);
// Clipped and encoded, 0..1.
glm::dvec3 encoded_rgb(const DisplayFunction& function, const Rgb& linear);

// One pixel, radiance as XYZ in cd m^-2 -> encoded RGB in 0..1. Not-finite input gives black.
glm::dvec3 display_pixel(const Xyz& radiance, const DisplayFunction& function);
glm::dvec3 display_pixel(const Xyz& radiance, const DisplaySettings& settings);

// What is wrong with a colour, by linear_display_rgb of it.
struct PixelFaults {
    bool clipped = false;      // a component above 1: brighter than the display
    bool out_of_gamut = false; // a component below 0: more saturated than the display's primaries
};
PixelFaults faults_of(const Rgb& linear);
// Stripes over what is wrong, red for clipped, cyan for out of gamut; x and y in pixels from the top left.
glm::dvec3 marked(const glm::dvec3& encoded, const PixelFaults& faults, const DisplaySettings& settings, int x, int y);

// A scene-referred picture: row-major from the top left, XYZ in cd m^-2. Pictures of one quantity hold it in Y.
struct RadianceImage {
    int width = 0, height = 0;
    std::vector<glm::vec3> xyz;
};
template <typename Code>
struct CodeImage {
    int width = 0, height = 0;
    std::vector<std::array<Code, 3>> rgb;
};
using DisplayImage = CodeImage<std::uint8_t>;
using DeepDisplayImage = CodeImage<std::uint16_t>; // 16 bits a channel

// Resolves scale_all, which looks at the whole picture, and draws the marks.
DisplayImage display_image(const RadianceImage& image, const DisplaySettings& settings);
DeepDisplayImage deep_display_image(const RadianceImage& image, const DisplaySettings& settings);

// The quantity in Y as false colours with contours. Encoded sRGB.
DisplayImage false_colour_image(const RadianceImage& image, const FalseColourSettings& scale);
DeepDisplayImage deep_false_colour_image(const RadianceImage& image, const FalseColourSettings& scale);

// The largest component of linear RGB in the picture after the tone operator, the display's white at 1: what scale_all
// divides by where it is above 1.
double largest_component(const RadianceImage& image, const DisplaySettings& settings);

// Shares of the pixels, 0..1, that the marks would mark.
struct DisplayShares {
    double clipped = 0, out_of_gamut = 0;
    bool operator==(const DisplayShares&) const = default;
};
DisplayShares display_shares(const RadianceImage& image, const DisplaySettings& settings);

} // namespace lueur
