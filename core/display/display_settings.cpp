#include "core/display/display_settings.h"

#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/display/display_fields.h"

namespace lueur {

namespace {

template <typename Enum, std::size_t N>
std::optional<Enum> parsed(std::string_view text, const std::array<Enum, N>& all) {
    for (const Enum value : all)
        if (text == to_string(value)) return value;
    return {};
}

struct Checker {
    std::vector<std::string> faults;

    void operator()(std::string_view key, double value, const AllowedNumber& allowed) {
        if (allowed.contains(value)) return;
        const std::string name = key == "max_display" ? "MAXDISPLAY" : std::string(key);
        faults.push_back(fmt::format("{} is {}; allowed: {}{}{}", name, value, allowed.text,
                                     allowed.unit.empty() ? "" : " ", allowed.unit));
    }
    void operator()(std::string_view key, const glm::dvec3& values, const AllowedNumber& allowed) {
        for (int c = 0; c < 3; ++c)
            if (!allowed.contains(values[c])) {
                (*this)(key, values[c], allowed);
                return;
            }
    }
    void operator()(std::string_view, const RgbSpace& primaries) {
        if (const auto space = make_rgb_space(primaries); !space)
            faults.push_back(fmt::format("primaries: {}", space.error()));
    }
    void operator()(std::string_view key, const std::vector<double>& levels) {
        if (levels.size() > most_isolines)
            faults.push_back(fmt::format("{} has {} levels; allowed: at most {}", key, levels.size(), most_isolines));
        for (const double level : levels)
            if (!allowed_scale_end.contains(level)) {
                (*this)(key, level, allowed_scale_end);
                return;
            }
    }
    void operator()(std::string_view, bool) {}
    template <typename Enum>
    requires std::is_enum_v<Enum>
    void operator()(std::string_view, Enum) {}
};

} // namespace

std::string to_string(MaxDisplayRule rule) {
    switch (rule) {
    case MaxDisplayRule::by_hand:
        return "by_hand";
    case MaxDisplayRule::percentile:
        return "percentile";
    case MaxDisplayRule::lecture:
        return "lecture";
    }
    return {};
}

std::string to_string(ToneOperator tone_operator) {
    switch (tone_operator) {
    case ToneOperator::linear:
        return "linear";
    case ToneOperator::tumblin_rushmeier:
        return "tumblin_rushmeier";
    case ToneOperator::filmic:
        return "filmic";
    }
    return {};
}

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

std::optional<MaxDisplayRule> parse_max_display_rule(std::string_view text) {
    return parsed(text, all_max_display_rules);
}
std::optional<ToneOperator> parse_tone_operator(std::string_view text) {
    return parsed(text, all_tone_operators);
}
std::optional<ClipRule> parse_clip_rule(std::string_view text) {
    return parsed(text, all_clip_rules);
}
std::optional<TransferCurve> parse_transfer_curve(std::string_view text) {
    return parsed(text, all_transfer_curves);
}

std::string to_string(const RgbSpace& primaries) {
    for (const auto& [name, space] : rgb_spaces)
        if (space == primaries) return std::string(name);
    return fmt::format("{} {} {} {} {} {} {} {}", primaries.red.x, primaries.red.y, primaries.green.x,
                       primaries.green.y, primaries.blue.x, primaries.blue.y, primaries.white.x, primaries.white.y);
}

std::optional<RgbSpace> parse_primaries(std::string_view text) {
    if (const auto known = rgb_space_named(text)) return known;
    std::array<double, 8> n{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (double& value : n) {
        while (at != end && (*at == ' ' || *at == ',')) ++at;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc()) return {};
        at = next;
    }
    if (at != end) return {};
    const auto space = make_rgb_space({{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}});
    if (!space) return {};
    return *space;
}

std::vector<std::string> check(const DisplaySettings& settings) {
    Checker checker;
    visit_display_fields(settings, checker);
    if (settings.primaries.white_luminance != 1)
        checker.faults.push_back(fmt::format("primaries have a white luminance of {}; allowed: 1, the white luminance "
                                             "of the display is a setting of its own",
                                             settings.primaries.white_luminance));
    const auto ordered = [&](const char* name, const FalseColourSettings& scale) {
        if (!(scale.low < scale.high))
            checker.faults.push_back(fmt::format("the {} scale goes from {} to {}; allowed: from a lower to a higher "
                                                 "number",
                                                 name, scale.low, scale.high));
    };
    ordered("luminance", settings.luminance_scale);
    ordered("illuminance", settings.illuminance_scale);
    return std::move(checker.faults);
}

} // namespace lueur
