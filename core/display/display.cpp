#include "core/display/display.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/matrix_access.hpp>

namespace lueur {

namespace {

const glm::dmat3& rgb_from_xyz_srgb() {
    static const glm::dmat3 matrix = rgb_from_xyz(srgb);
    return matrix;
}

double luminance(const Rgb& rgb) { // of linear sRGB with white at 1
    static const glm::dvec3 weights = glm::row(xyz_from_rgb(srgb), 1);
    return glm::dot(weights, rgb);
}

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Mixes the colour with the grey of its own luminance, no more than needed to bring each component into 0..1.
Rgb desaturated(const Rgb& rgb) {
    const double grey = luminance(rgb);
    if (grey >= 1) return Rgb(1); // nothing else has that luminance, or as much of it
    if (grey <= 0) return Rgb(0);
    double share = 1; // of the colour that is kept
    for (int c = 0; c < 3; ++c) {
        if (rgb[c] > 1) share = std::min(share, (1 - grey) / (rgb[c] - grey));
        if (rgb[c] < 0) share = std::min(share, grey / (grey - rgb[c]));
    }
    return Rgb(grey) + share * (rgb - Rgb(grey));
}

// Hall 1989, "Illumination and Color in Computer Generated Imagery", section 5.3; rgb has white at 1.
Rgb clipped(const Rgb& rgb, ClipRule rule) {
    switch (rule) {
    case ClipRule::scale_all: // MAXDISPLAY has been raised for the whole picture; what remains are negatives
    case ClipRule::clamp:
        return glm::clamp(rgb, 0.0, 1.0);
    case ClipRule::keep_chromaticity: {
        const Rgb positive = glm::max(rgb, 0.0);
        return positive / std::max({1.0, positive.r, positive.g, positive.b});
    }
    case ClipRule::desaturate:
        return glm::clamp(desaturated(rgb), 0.0, 1.0); // the clamp takes off rounding only
    }
    return {};
}

double encoded(double linear, const DisplaySettings& settings) {
    switch (settings.curve) {
    case TransferCurve::gamma:
        return std::pow(linear, 1 / settings.gamma);
    case TransferCurve::srgb:
        return srgb_encode(linear);
    }
    return 0;
}

} // namespace

std::string to_string(ClipRule rule) {
    switch (rule) {
    case ClipRule::clamp:
        return "clamp";
    case ClipRule::keep_chromaticity:
        return "keep_chromaticity";
    case ClipRule::desaturate:
        return "desaturate";
    case ClipRule::scale_all:
        return "scale_all";
    }
    return {};
}

std::string to_string(TransferCurve curve) {
    switch (curve) {
    case TransferCurve::gamma:
        return "gamma";
    case TransferCurve::srgb:
        return "srgb";
    }
    return {};
}

std::optional<ClipRule> parse_clip_rule(std::string_view text) {
    for (const ClipRule rule :
         {ClipRule::clamp, ClipRule::keep_chromaticity, ClipRule::desaturate, ClipRule::scale_all})
        if (text == to_string(rule)) return rule;
    return std::nullopt;
}

std::optional<TransferCurve> parse_transfer_curve(std::string_view text) {
    for (const TransferCurve curve : {TransferCurve::gamma, TransferCurve::srgb})
        if (text == to_string(curve)) return curve;
    return std::nullopt;
}

std::vector<std::string> check(const DisplaySettings& settings) {
    std::vector<std::string> faults;
    if (!(std::isfinite(settings.max_display) && settings.max_display > 0))
        faults.push_back(
            fmt::format("MAXDISPLAY is {}; allowed: a finite number of cd/m^2 above 0", settings.max_display));
    if (!(settings.gamma >= 0.1 && settings.gamma <= 10))
        faults.push_back(fmt::format("gamma is {}; allowed: 0.1 to 10", settings.gamma));
    return faults;
}

glm::dvec3 display_pixel(const Xyz& radiance, const DisplaySettings& settings) {
    const Rgb rgb = rgb_from_xyz_srgb() * radiance / settings.max_display;
    if (!is_finite(rgb)) return glm::dvec3(0);
    const Rgb shown = clipped(rgb, settings.clip);
    return {encoded(shown.r, settings), encoded(shown.g, settings), encoded(shown.b, settings)};
}

DisplayImage display_image(const RadianceImage& image, const DisplaySettings& settings) {
    DisplaySettings resolved = settings;
    if (settings.clip == ClipRule::scale_all)
        resolved.max_display = std::max(settings.max_display, largest_component(image));
    DisplayImage shown{image.width, image.height, {}};
    shown.rgb.reserve(image.xyz.size());
    for (const glm::vec3& xyz : image.xyz) {
        const glm::dvec3 pixel = glm::round(255.0 * display_pixel(Xyz(xyz), resolved));
        shown.rgb.push_back({static_cast<std::uint8_t>(pixel.r), static_cast<std::uint8_t>(pixel.g),
                             static_cast<std::uint8_t>(pixel.b)});
    }
    return shown;
}

double largest_component(const RadianceImage& image) {
    double largest = 0;
    for (const glm::vec3& xyz : image.xyz) {
        const Rgb rgb = rgb_from_xyz_srgb() * Xyz(xyz);
        if (is_finite(rgb)) largest = std::max({largest, rgb.r, rgb.g, rgb.b});
    }
    return largest;
}

double auto_max_display(std::vector<float> luminances, double share) {
    std::erase_if(luminances, [](float l) { return !(std::isfinite(l) && l > 0); });
    if (luminances.empty()) return DisplaySettings{}.max_display;
    constexpr double headroom = 1.1;
    // The smallest luminance that at least `share` of them do not exceed.
    const double count = std::ceil(std::clamp(share, 0.0, 1.0) * static_cast<double>(luminances.size()));
    const auto chosen = luminances.begin() + std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(count) - 1, 0);
    std::nth_element(luminances.begin(), chosen, luminances.end());
    return headroom * static_cast<double>(*chosen);
}

} // namespace lueur
