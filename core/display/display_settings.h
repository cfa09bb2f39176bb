// How a picture is displayed: everything between the radiance of a pixel and what a monitor is sent, as one value.
// The scene keeps it, panels and commands change it, pictures carry it in their metadata.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/spectrum/colour.h"

namespace lueur {

// Which luminance is shown as full white (core/display/max_display.h).
enum class MaxDisplayRule {
    by_hand,
    percentile, // of the picture's luminances
    lecture,    // the lighting engineers' rule of the lecture, from the lamps and the floor
};

// From the luminance of the scene to that of the display (core/display/tone_operator.h).
enum class ToneOperator { linear, tumblin_rushmeier, filmic };

enum class ClipRule {
    clamp,             // each component to 0..MAXDISPLAY (the lecture's choice)
    keep_chromaticity, // scale the colour until its largest component fits; negatives clamped
    desaturate,        // keep luminance and hue, mix with grey of the same luminance until it fits
    scale_all,         // the whole picture is divided by its largest component: nothing is cut
};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored                                                                                         \
    "-Wshadow" // GCC takes the scoped enumerator for a declaration that hides the colour space `srgb`
enum class TransferCurve { gamma, srgb };
#pragma GCC diagnostic pop

// The range of a false-colour picture, and its contours (core/display/false_colour.h).
struct FalseColourSettings {
    bool automatic = true;        // low and high from the scene, in round numbers
    double low = 1, high = 1000;  // cd m^-2 or lx
    bool logarithmic = true;      // else linear
    bool isolines = true;         // contours
    std::vector<double> levels{}; // of the contours; none: the round numbers of the legend
    bool operator==(const FalseColourSettings&) const = default;
};

struct DisplaySettings {
    MaxDisplayRule max_display_rule = MaxDisplayRule::percentile;
    double max_display = 100;       // cd m^-2 shown as full white: what is used, whatever rule has chosen it
    double percentile = 98;         // of MaxDisplayRule::percentile
    bool max_display_locked = true; // an edit never rescales the picture unasked

    ToneOperator tone_operator = ToneOperator::linear;
    bool adaptation_automatic = true; // the geometric mean luminance of the picture, chosen when MAXDISPLAY is
    double adaptation_luminance = 20; // cd m^-2, of the eye in the scene; tumblin_rushmeier
    double display_contrast = 35;     // white to black of the display in its room; tumblin_rushmeier
    double filmic_white = 4;          // times MAXDISPLAY: shown as full white; filmic

    ClipRule clip = ClipRule::clamp;
    TransferCurve curve = TransferCurve::srgb;
    glm::dvec3 gamma{2.2}; // of each channel, with TransferCurve::gamma

    RgbSpace primaries = srgb;   // of the display; its white is at 1 here, whatever its luminance
    double white_luminance = 80; // cd m^-2, of the display's white (IEC 61966-2-1); tumblin_rushmeier

    bool mark_clipped = false, mark_out_of_gamut = false;
    FalseColourSettings luminance_scale, illuminance_scale;

    bool operator==(const DisplaySettings&) const = default;
};

inline constexpr std::array all_max_display_rules{MaxDisplayRule::by_hand, MaxDisplayRule::percentile,
                                                  MaxDisplayRule::lecture};
inline constexpr std::array all_tone_operators{ToneOperator::linear, ToneOperator::tumblin_rushmeier,
                                               ToneOperator::filmic};
inline constexpr std::array all_clip_rules{ClipRule::clamp, ClipRule::keep_chromaticity, ClipRule::desaturate,
                                           ClipRule::scale_all};
inline constexpr std::array all_transfer_curves{TransferCurve::srgb, TransferCurve::gamma};

std::string to_string(MaxDisplayRule rule);
std::string to_string(ToneOperator tone_operator);
std::string to_string(ClipRule rule);
std::string to_string(TransferCurve curve);
std::optional<MaxDisplayRule> parse_max_display_rule(std::string_view text);
std::optional<ToneOperator> parse_tone_operator(std::string_view text);
std::optional<ClipRule> parse_clip_rule(std::string_view text);
std::optional<TransferCurve> parse_transfer_curve(std::string_view text);

// A preset's name, or "0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329": x y of red, green, blue and white.
std::string to_string(const RgbSpace& primaries);
// Either of the above, commas as good as spaces; nothing where it is neither, or no display can have it.
std::optional<RgbSpace> parse_primaries(std::string_view text);

// Empty when the settings are usable; else one line a fault, with what is allowed. The ranges are those of
// core/display/display_fields.h, which the scene file and the command line hold to as well.
std::vector<std::string> check(const DisplaySettings& settings);

} // namespace lueur
