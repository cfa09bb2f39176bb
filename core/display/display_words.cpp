#include "core/display/display_words.h"

#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/display/display_fields.h"

namespace lueur {

namespace {

std::string text_of(bool value) {
    return value ? "yes" : "no";
}
std::string text_of(double value) {
    return fmt::format("{}", value);
}
std::string text_of(const glm::dvec3& v) { // one number where all three are the same
    return v.x == v.y && v.y == v.z ? text_of(v.x) : fmt::format("{} {} {}", v.x, v.y, v.z);
}
std::string text_of(const std::vector<double>& values) {
    return values.empty() ? "auto" : fmt::format("{}", fmt::join(values, " "));
}
template <typename Named>
std::string text_of(const Named& value) {
    return to_string(value);
}

std::optional<std::vector<double>> numbers(std::string_view text) {
    std::vector<double> values;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at != end) {
        double value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc()) return {};
        values.push_back(value);
        at = next;
        while (at != end && *at == ' ') ++at;
    }
    return values;
}

template <typename Value>
bool take(Value& field, const std::optional<Value>& value) {
    if (value) field = *value;
    return value.has_value();
}
bool read(bool& field, std::string_view text) {
    field = text == "yes";
    return text == "yes" || text == "no";
}
bool read(double& field, std::string_view text) {
    const auto values = numbers(text);
    if (!values || values->size() != 1) return false;
    field = values->front();
    return true;
}
bool read(glm::dvec3& field, std::string_view text) {
    const auto values = numbers(text);
    if (!values || (values->size() != 1 && values->size() != 3)) return false;
    field = values->size() == 1 ? glm::dvec3(values->front()) : glm::dvec3((*values)[0], (*values)[1], (*values)[2]);
    return true;
}
bool read(std::vector<double>& field, std::string_view text) {
    const auto values = text == "auto" ? std::vector<double>{} : numbers(text);
    if (values) field = *values;
    return values.has_value();
}
bool read(MaxDisplayRule& field, std::string_view text) {
    return take(field, parse_max_display_rule(text));
}
bool read(ToneOperator& field, std::string_view text) {
    return take(field, parse_tone_operator(text));
}
bool read(ClipRule& field, std::string_view text) {
    return take(field, parse_clip_rule(text));
}
bool read(TransferCurve& field, std::string_view text) {
    return take(field, parse_transfer_curve(text));
}
bool read(RgbSpace& field, std::string_view text) {
    return take(field, parse_primaries(text));
}

} // namespace

std::map<std::string, std::string> words_from_display(const DisplaySettings& settings) {
    std::map<std::string, std::string> words;
    visit_display_fields(settings,
                         [&](const char* key, const auto& field, const auto&...) { words[key] = text_of(field); });
    return words;
}

std::optional<std::string> read_display_words(DisplaySettings& settings,
                                              const std::map<std::string, std::string>& words) {
    std::optional<std::string> fault;
    visit_display_fields(settings, [&](const char* key, auto& field, const auto&...) {
        const auto word = words.find(key);
        if (word == words.end() || fault) return;
        if (!read(field, word->second)) fault = fmt::format("{} = \"{}\" cannot be read", key, word->second);
    });
    return fault;
}

} // namespace lueur
