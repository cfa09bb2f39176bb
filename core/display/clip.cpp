#include "core/display/clip.h"

#include <algorithm>

namespace lueur {

namespace {

Rgb desaturated(const Rgb& rgb, const glm::dvec3& luminance_weights) {
    const double grey = glm::dot(luminance_weights, rgb);
    if (grey >= 1) return Rgb(1); // nothing else has that luminance, or as much of it
    if (grey <= 0) return Rgb(0);
    double share = 1; // of the colour that is kept
    for (int c = 0; c < 3; ++c) {
        if (rgb[c] > 1) share = std::min(share, (1 - grey) / (rgb[c] - grey));
        if (rgb[c] < 0) share = std::min(share, grey / (grey - rgb[c]));
    }
    return Rgb(grey) + share * (rgb - Rgb(grey));
}

} // namespace

Rgb clipped(const Rgb& rgb, ClipRule rule, const glm::dvec3& luminance_weights) {
    switch (rule) {
    case ClipRule::scale_all:
    case ClipRule::clamp:
        return glm::clamp(rgb, 0.0, 1.0);
    case ClipRule::keep_chromaticity: {
        const Rgb positive = glm::max(rgb, 0.0);
        return positive / std::max({1.0, positive.r, positive.g, positive.b});
    }
    case ClipRule::desaturate:
        return glm::clamp(desaturated(rgb, luminance_weights), 0.0, 1.0); // the clamp takes off rounding only
    }
    return {};
}

} // namespace lueur
