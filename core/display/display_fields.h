// Every setting of the display once: its name in files, its place in the struct, its allowed range. The scene file, the
// metadata of pictures and the checks are written over this list, so that none of them forgets a setting.
#pragma once

#include <string_view>

#include "core/display/display_settings.h"

namespace lueur {

struct AllowedNumber {
    double low = 0, high = 0;
    std::string_view text;                                                      // "0.1..10"
    std::string_view unit;                                                      // of it, may be empty
    bool contains(double value) const { return value >= low && value <= high; } // false for NaN
};

// From the darkest luminance one would show as white to the brightest, with room on both sides for any unit the
// radiance of a scene may have been given in. Single precision holds a colour divided by either end.
inline constexpr AllowedNumber allowed_max_display{1e-30, 1e30, "1e-30..1e30", "cd/m2"};
inline constexpr AllowedNumber allowed_gamma{0.1, 10, "0.1..10", ""};
inline constexpr AllowedNumber allowed_percentile{1, 100, "1..100", "%"};
// The exponents of Tumblin & Rushmeier are positive above 1.6e-4 cd m^-2.
inline constexpr AllowedNumber allowed_adaptation{1e-3, 1e6, "0.001..1e6", "cd/m2"};
inline constexpr AllowedNumber allowed_contrast{2, 1e6, "2..1e6", ""};
inline constexpr AllowedNumber allowed_filmic_white{1, 100, "1..100", "times MAXDISPLAY"};
inline constexpr AllowedNumber allowed_white_luminance{1, 1e5, "1..1e5", "cd/m2"};
inline constexpr AllowedNumber allowed_scale_end{1e-6, 1e12, "1e-6..1e12", ""};
inline constexpr std::size_t most_isolines = 16;

// visit(key, field) for words, truths, primaries and levels; visit(key, field, allowed) for numbers.
template <typename Settings, typename Visit> // Settings: DisplaySettings or const DisplaySettings
void visit_display_fields(Settings& settings, Visit&& visit) {
    visit("max_display_rule", settings.max_display_rule);
    visit("max_display", settings.max_display, allowed_max_display);
    visit("percentile", settings.percentile, allowed_percentile);
    visit("locked", settings.max_display_locked);
    visit("operator", settings.tone_operator);
    visit("adaptation_auto", settings.adaptation_automatic);
    visit("adaptation", settings.adaptation_luminance, allowed_adaptation);
    visit("display_contrast", settings.display_contrast, allowed_contrast);
    visit("filmic_white", settings.filmic_white, allowed_filmic_white);
    visit("clip", settings.clip);
    visit("curve", settings.curve);
    visit("gamma", settings.gamma, allowed_gamma);
    visit("primaries", settings.primaries);
    visit("white_luminance", settings.white_luminance, allowed_white_luminance);
    visit("mark_clipped", settings.mark_clipped);
    visit("mark_out_of_gamut", settings.mark_out_of_gamut);
    visit("luminance_auto", settings.luminance_scale.automatic);
    visit("luminance_low", settings.luminance_scale.low, allowed_scale_end);
    visit("luminance_high", settings.luminance_scale.high, allowed_scale_end);
    visit("luminance_log", settings.luminance_scale.logarithmic);
    visit("luminance_isolines", settings.luminance_scale.isolines);
    visit("luminance_levels", settings.luminance_scale.levels);
    visit("illuminance_auto", settings.illuminance_scale.automatic);
    visit("illuminance_low", settings.illuminance_scale.low, allowed_scale_end);
    visit("illuminance_high", settings.illuminance_scale.high, allowed_scale_end);
    visit("illuminance_log", settings.illuminance_scale.logarithmic);
    visit("illuminance_isolines", settings.illuminance_scale.isolines);
    visit("illuminance_levels", settings.illuminance_scale.levels);
}

} // namespace lueur
