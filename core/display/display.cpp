#include "core/display/display.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/matrix_access.hpp>

#include "core/display/clip.h"
#include "core/display/false_colour.h"

namespace lueur {

namespace {

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double encoded(double linear, TransferCurve curve, double gamma) {
    switch (curve) {
    case TransferCurve::gamma:
        return linear <= 0 ? 0 : std::pow(linear, 1 / gamma);
    case TransferCurve::srgb:
        return srgb_encode(linear);
    }
    return 0;
}

template <typename Code>
std::array<Code, 3> codes(const glm::dvec3& encoded_colour) {
    constexpr double top = std::numeric_limits<Code>::max();
    const glm::dvec3 c = glm::round(top * encoded_colour);
    return {static_cast<Code>(c.r), static_cast<Code>(c.g), static_cast<Code>(c.b)};
}

DisplayFunction function_for(const RadianceImage& image, const DisplaySettings& settings) {
    DisplayFunction function = make_display_function(settings);
    if (settings.clip == ClipRule::scale_all) function.divisor = std::max(1.0, largest_component(image, settings));
    return function;
}

template <typename Code>
CodeImage<Code> displayed(const RadianceImage& image, const DisplaySettings& settings) {
    const DisplayFunction function = function_for(image, settings);
    CodeImage<Code> shown{image.width, image.height, {}};
    shown.rgb.reserve(image.xyz.size());
    const auto width = static_cast<std::size_t>(std::max(image.width, 1));
    for (std::size_t i = 0; i < image.xyz.size(); ++i) {
        const Rgb linear = linear_display_rgb(function, Xyz(image.xyz[i]));
        const glm::dvec3 colour = marked(encoded_rgb(function, linear), faults_of(linear), settings,
                                         static_cast<int>(i % width), static_cast<int>(i / width));
        shown.rgb.push_back(codes<Code>(colour));
    }
    return shown;
}

template <typename Code>
CodeImage<Code> in_false_colour(const RadianceImage& image, const FalseColourSettings& scale) {
    const std::vector<double> levels = isoline_levels(scale);
    const auto value = [&](int x, int y) -> double { // 0: nothing there
        if (x < 0 || y < 0 || x >= image.width || y >= image.height) return 0;
        const float v =
            image.xyz[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)]
                .y;
        return std::isfinite(v) ? static_cast<double>(v) : 0.0;
    };
    CodeImage<Code> shown{image.width, image.height, {}};
    shown.rgb.reserve(image.xyz.size());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double here = value(x, y);
            const double line = isoline_strength(
                levels, here, {value(x - 1, y), value(x + 1, y), value(x, y - 1), value(x, y + 1)}, isoline_width);
            shown.rgb.push_back(codes<Code>(glm::dvec3(with_isoline(false_colour(place_on_scale(scale, here)), line))));
        }
    return shown;
}

} // namespace

DisplayFunction make_display_function(const DisplaySettings& settings) {
    RgbSpace primaries = settings.primaries;
    primaries.white_luminance = 1;
    DisplayFunction function;
    function.rgb_from_xyz = rgb_from_xyz(primaries) / settings.max_display;
    function.luminance_weights = glm::row(xyz_from_rgb(primaries), 1);
    function.tone = make_tone_curve(settings);
    function.clip = settings.clip;
    function.curve = settings.curve;
    function.gamma = settings.gamma;
    return function;
}

Rgb linear_display_rgb(const DisplayFunction& function, const Xyz& radiance) {
    if (!is_finite(radiance)) return Rgb(0);
    Rgb rgb = function.rgb_from_xyz * radiance;
    if (glm::any(glm::isnan(rgb))) return Rgb(0); // of radiances near the end of double precision
    rgb = glm::clamp(rgb, -largest_rgb, largest_rgb);
    return toned(function.tone, rgb, function.luminance_weights) / function.divisor;
}

glm::dvec3 encoded_rgb(const DisplayFunction& function, const Rgb& linear) {
    const Rgb shown = clipped(linear, function.clip, function.luminance_weights);
    glm::dvec3 result(0);
    for (int c = 0; c < 3; ++c) result[c] = encoded(shown[c], function.curve, function.gamma[c]);
    return result;
}

glm::dvec3 display_pixel(const Xyz& radiance, const DisplayFunction& function) {
    return encoded_rgb(function, linear_display_rgb(function, radiance));
}

glm::dvec3 display_pixel(const Xyz& radiance, const DisplaySettings& settings) {
    return display_pixel(radiance, make_display_function(settings));
}

PixelFaults faults_of(const Rgb& linear) {
    const double largest = std::max({linear.r, linear.g, linear.b}), least = std::min({linear.r, linear.g, linear.b});
    constexpr double rounding = 1e-4; // single precision, and colours on the edge of the gamut
    return {largest > 1 + rounding, least < -rounding * std::max(largest, 0.0) && largest > 0};
}

glm::dvec3 marked(const glm::dvec3& encoded_colour, const PixelFaults& faults, const DisplaySettings& settings, int x,
                  int y) {
    constexpr int stripe = 4; // pixels
    const auto on = [](int distance) { return (distance / stripe) % 2 == 0; };
    constexpr int far = 1 << 20; // a multiple of two stripes, keeps the difference above 0
    if (settings.mark_clipped && faults.clipped && on(x + y)) return {1, 0.1, 0.15};
    if (settings.mark_out_of_gamut && faults.out_of_gamut && on(x - y + far)) return {0.1, 0.85, 1};
    return encoded_colour;
}

DisplayImage display_image(const RadianceImage& image, const DisplaySettings& settings) {
    return displayed<std::uint8_t>(image, settings);
}

DeepDisplayImage deep_display_image(const RadianceImage& image, const DisplaySettings& settings) {
    return displayed<std::uint16_t>(image, settings);
}

DisplayImage false_colour_image(const RadianceImage& image, const FalseColourSettings& scale) {
    return in_false_colour<std::uint8_t>(image, scale);
}

DeepDisplayImage deep_false_colour_image(const RadianceImage& image, const FalseColourSettings& scale) {
    return in_false_colour<std::uint16_t>(image, scale);
}

double largest_component(const RadianceImage& image, const DisplaySettings& settings) {
    const DisplayFunction function = make_display_function(settings);
    double largest = 0;
    for (const glm::vec3& xyz : image.xyz) {
        const Rgb rgb = linear_display_rgb(function, Xyz(xyz));
        largest = std::max({largest, rgb.r, rgb.g, rgb.b});
    }
    return largest;
}

DisplayShares display_shares(const RadianceImage& image, const DisplaySettings& settings) {
    const DisplayFunction function = function_for(image, settings);
    std::size_t clipped_pixels = 0, outside = 0;
    for (const glm::vec3& xyz : image.xyz) {
        const PixelFaults faults = faults_of(linear_display_rgb(function, Xyz(xyz)));
        clipped_pixels += faults.clipped;
        outside += faults.out_of_gamut;
    }
    const auto count = static_cast<double>(std::max<std::size_t>(image.xyz.size(), 1));
    return {static_cast<double>(clipped_pixels) / count, static_cast<double>(outside) / count};
}

} // namespace lueur
