#include "core/scene/toml_display.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/display/display_fields.h"

namespace lueur {

namespace {

NumberRange range_of(const AllowedNumber& allowed) {
    return {allowed.low, allowed.high, true, std::string(allowed.text)};
}

struct KeyReader {
    TomlTable& table;

    void operator()(const char* key, double& field, const AllowedNumber& allowed) const {
        field = table.number(key, range_of(allowed)).value_or(field);
    }
    void operator()(const char* key, bool& field) const { field = table.boolean(key).value_or(field); }
    void operator()(const char* key, MaxDisplayRule& field) const { word(key, field, all_max_display_rules); }
    void operator()(const char* key, ToneOperator& field) const { word(key, field, all_tone_operators); }
    void operator()(const char* key, ClipRule& field) const { word(key, field, all_clip_rules); }
    void operator()(const char* key, TransferCurve& field) const { word(key, field, all_transfer_curves); }

    // One number for all channels, or three.
    void operator()(const char* key, glm::dvec3& field, const AllowedNumber& allowed) const {
        const toml::node* node = table.find(key);
        if (!node) return;
        if (node->is_array()) {
            if (const auto v = read_numbers(table.file(), *node, 3, range_of(allowed), key))
                field = {(*v)[0], (*v)[1], (*v)[2]};
        } else if (const auto value = read_number(table.file(), *node, range_of(allowed), key)) {
            field = glm::dvec3(*value);
        }
    }
    // A preset's name, or x y of red, green, blue and white.
    void operator()(const char* key, RgbSpace& field) const {
        const toml::node* node = table.find(key);
        if (!node) return;
        if (node->is_array()) {
            const auto v = read_numbers(table.file(), *node, 8, {-2, 2, true, "-2..2"}, key);
            if (!v) return;
            const auto space =
                make_rgb_space({{(*v)[0], (*v)[1]}, {(*v)[2], (*v)[3]}, {(*v)[4], (*v)[5]}, {(*v)[6], (*v)[7]}});
            if (space)
                field = *space;
            else
                table.file().error(*node, space.error());
            return;
        }
        const auto name = read_text(table.file(), *node, key);
        if (!name) return;
        if (const auto space = rgb_space_named(*name)) {
            field = *space;
            return;
        }
        std::vector<std::string> names;
        for (const auto& known : rgb_spaces) names.emplace_back(known.name);
        table.file().error(*node, fmt::format("{} = \"{}\" is not known; {}, or [xr, yr, xg, yg, xb, yb, xw, yw]", key,
                                              *name, allowed_words(*name, names)));
    }
    // Contour levels.
    void operator()(const char* key, std::vector<double>& field) const {
        const toml::node* node = table.find(key);
        if (!node) return;
        const toml::array* array = node->as_array();
        if (!array || array->size() > most_isolines) {
            table.file().error(*node, fmt::format("{} must be a list of at most {} numbers", key, most_isolines));
            return;
        }
        if (const auto levels = read_numbers(table.file(), *node, array->size(), range_of(allowed_scale_end), key))
            field = *levels;
    }

private:
    template <typename Enum, std::size_t N>
    void word(const char* key, Enum& field, const std::array<Enum, N>& all) const {
        std::vector<std::pair<std::string, Enum>> words;
        for (const Enum value : all) words.emplace_back(to_string(value), value);
        field = table.choice(key, words).value_or(field);
    }
};

std::string toml(double value) {
    return fmt::format("{}", value);
}
std::string toml(bool value) {
    return value ? "true" : "false";
}
std::string toml(const glm::dvec3& v) {
    return v.x == v.y && v.y == v.z ? toml(v.x) : fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}
std::string toml(const std::vector<double>& values) {
    return fmt::format("[{}]", fmt::join(values, ", "));
}
std::string toml(const RgbSpace& space) {
    for (const auto& known : rgb_spaces)
        if (known.space == space) return fmt::format("\"{}\"", known.name);
    return fmt::format("[{}, {}, {}, {}, {}, {}, {}, {}]", space.red.x, space.red.y, space.green.x, space.green.y,
                       space.blue.x, space.blue.y, space.white.x, space.white.y);
}
template <typename Enum>
requires std::is_enum_v<Enum> std::string toml(Enum value) {
    return fmt::format("\"{}\"", to_string(value));
}

} // namespace

void read_toml_display(TomlTable& table, DisplaySettings& display) {
    visit_display_fields(display, KeyReader{table});
    const auto ordered = [&](const char* low, const char* high, const FalseColourSettings& scale) {
        if (scale.low < scale.high) return;
        if (const toml::node* node = table.find(table.table().contains(low) ? low : high))
            table.file().error(*node, fmt::format("{} is not below {}; a lower number is allowed", low, high));
    };
    ordered("luminance_low", "luminance_high", display.luminance_scale);
    ordered("illuminance_low", "illuminance_high", display.illuminance_scale);
}

std::string toml_from_display(const DisplaySettings& display) {
    constexpr std::array always{"max_display_rule", "max_display", "locked", "operator", "clip", "curve", "gamma"};
    std::vector<std::string> usual;
    const DisplaySettings defaults{};
    visit_display_fields(defaults,
                         [&](const char*, const auto& field, const auto&...) { usual.push_back(toml(field)); });
    std::string lines;
    std::size_t i = 0;
    visit_display_fields(display, [&](const char* key, const auto& field, const auto&...) {
        const std::string value = toml(field);
        if (value != usual[i++] || std::ranges::find(always, std::string_view(key)) != always.end())
            lines += fmt::format("{} = {}\n", key, value);
    });
    return lines;
}

} // namespace lueur
