#include "core/display/max_display.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/display/display_fields.h"

namespace lueur {

double lecture_max_display(double luminous_flux, double floor_area, double mean_reflectance,
                           const RgbSpace& primaries) {
    const bool usable = luminous_flux > 0 && floor_area > 0 && mean_reflectance > 0;
    if (!usable || !std::isfinite(luminous_flux / floor_area * mean_reflectance)) return 0;
    const double reference = mean_reflectance * luminous_flux / (std::numbers::pi * floor_area);
    // Equal energy has X = Y = Z: the integrals of the three functions agree within 0.03 % (corrections 17).
    const Rgb rgb = rgb_from_xyz(primaries) * Xyz(reference);
    return 2 * std::max({rgb.r, rgb.g, rgb.b});
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

double geometric_mean_luminance(const std::vector<float>& luminances) {
    double sum = 0;
    std::size_t count = 0;
    for (const float l : luminances)
        if (std::isfinite(l) && l > 0) {
            sum += std::log(static_cast<double>(l));
            ++count;
        }
    return count == 0 ? 0 : std::exp(sum / static_cast<double>(count));
}

DisplaySettings resolved(DisplaySettings settings, const std::vector<float>& luminances, double lecture) {
    const double mean = geometric_mean_luminance(luminances);
    switch (settings.max_display_rule) {
    case MaxDisplayRule::by_hand:
        break;
    case MaxDisplayRule::percentile:
        if (mean > 0) settings.max_display = auto_max_display(luminances, settings.percentile / 100);
        break;
    case MaxDisplayRule::lecture:
        if (lecture > 0) settings.max_display = lecture;
        break;
    }
    settings.max_display = std::clamp(settings.max_display, allowed_max_display.low, allowed_max_display.high);
    if (settings.adaptation_automatic && mean > 0)
        settings.adaptation_luminance = std::clamp(mean, allowed_adaptation.low, allowed_adaptation.high);
    return settings;
}

} // namespace lueur
