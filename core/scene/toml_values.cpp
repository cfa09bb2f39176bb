#include "core/scene/toml_values.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lueur {

namespace {

std::string type_name(const toml::node& node) {
    switch (node.type()) {
    case toml::node_type::none:
        return "nothing";
    case toml::node_type::table:
        return "a table";
    case toml::node_type::array:
        return "an array";
    case toml::node_type::string:
        return "a text";
    case toml::node_type::integer:
        return "an integer";
    case toml::node_type::floating_point:
        return "a number";
    case toml::node_type::boolean:
        return "true or false";
    case toml::node_type::date:
        return "a date";
    case toml::node_type::time:
        return "a time";
    case toml::node_type::date_time:
        return "a date and time";
    }
    return "something else";
}

std::size_t edit_distance(std::string_view a, std::string_view b) { // Levenshtein 1966
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

} // namespace

void TomlFile::error(const toml::source_region& source, std::string_view what) const {
    diagnostics.error(name, {source.begin.line, source.begin.column}, what);
}

Place place_of(const toml::node& node) {
    return {node.source().begin.line, node.source().begin.column};
}

std::optional<double> read_number(const TomlFile& file, const toml::node& node, const NumberRange& range,
                                  std::string_view what) {
    double number = 0;
    if (const auto* integer = node.as_integer())
        number = static_cast<double>(integer->get());
    else if (const auto* real = node.as_floating_point())
        number = real->get();
    else {
        file.error(node, fmt::format("{} is {}; a number{}{} is allowed", what, type_name(node),
                                     range.text.empty() ? "" : " ", range.text));
        return {};
    }
    if (!std::isfinite(number)) {
        file.error(node, fmt::format("{} is not finite; {} is allowed", what,
                                     range.text.empty() ? "a finite number" : range.text));
        return {};
    }
    if (number < range.low || number > range.high || (number == range.low && !range.low_allowed)) {
        file.error(node, fmt::format("{} = {} is out of range; {} is allowed", what, number, range.text));
        return {};
    }
    return number;
}

std::optional<std::vector<double>> read_numbers(const TomlFile& file, const toml::node& node, std::size_t count,
                                                const NumberRange& range, std::string_view what) {
    const toml::array* array = node.as_array();
    if (!array || array->size() != count) {
        const std::string found = array ? fmt::format("has {} values", array->size()) : "is " + type_name(node);
        file.error(node, fmt::format("{} {}; an array of {} numbers is allowed", what, found, count));
        return {};
    }
    std::vector<double> numbers;
    for (const toml::node& element : *array)
        if (const std::optional<double> number = read_number(file, element, range, what)) numbers.push_back(*number);
    if (numbers.size() != count) return {};
    return numbers;
}

std::optional<std::string> read_text(const TomlFile& file, const toml::node& node, std::string_view what) {
    const auto* text = node.as_string();
    if (!text) {
        file.error(node, fmt::format("{} is {}; a text in quotes is allowed", what, type_name(node)));
        return {};
    }
    return text->get();
}

std::string allowed_words(std::string_view word, const std::vector<std::string>& allowed) {
    std::string nearest;
    std::size_t distance = word.size() <= 3 ? 2 : std::max<std::size_t>(2, word.size() / 3) + 1; // nearer than this
    for (const std::string& candidate : allowed)
        if (const std::size_t d = edit_distance(word, candidate); d < distance) {
            distance = d;
            nearest = candidate;
        }
    const std::string all = fmt::format("allowed: {}", fmt::join(allowed, ", "));
    return nearest.empty() ? all : fmt::format("did you mean \"{}\"? {}", nearest, all);
}

const toml::node* TomlTable::find(std::string_view key) {
    known_.emplace_back(key);
    return table_.get(key);
}

const toml::node* TomlTable::require(std::string_view key, std::string_view allowed) {
    const toml::node* node = find(key);
    if (!node) file_.error(table_, fmt::format("{} has no {}; {}", name_, key, allowed));
    return node;
}

std::optional<double> TomlTable::number(std::string_view key, const NumberRange& range) {
    const toml::node* node = find(key);
    return node ? read_number(file_, *node, range, key) : std::nullopt;
}

std::optional<std::int64_t> TomlTable::integer(std::string_view key, std::int64_t low, std::int64_t high) {
    const toml::node* node = find(key);
    if (!node) return {};
    const auto* value = node->as_integer();
    if (value && value->get() >= low && value->get() <= high) return value->get();
    const std::string found = value ? fmt::format("= {} is out of range", value->get()) : "is " + type_name(*node);
    file_.error(*node, fmt::format("{} {}; an integer {}..{} is allowed", key, found, low, high));
    return {};
}

std::optional<bool> TomlTable::boolean(std::string_view key) {
    const toml::node* node = find(key);
    if (!node) return {};
    if (const auto* value = node->as_boolean()) return value->get();
    file_.error(*node, fmt::format("{} is {}; true or false is allowed", key, type_name(*node)));
    return {};
}

std::optional<std::string> TomlTable::text(std::string_view key) {
    const toml::node* node = find(key);
    if (!node) return {};
    std::optional<std::string> text = read_text(file_, *node, key);
    if (text && text->empty()) {
        file_.error(*node, fmt::format("{} is empty; a text of at least one letter is allowed", key));
        return {};
    }
    return text;
}

std::optional<glm::dvec3> TomlTable::point(std::string_view key) {
    const toml::node* node = find(key);
    if (!node) return {};
    const auto numbers = read_numbers(file_, *node, 3, {-1e9, 1e9, true, "-1e9..1e9"}, key);
    if (!numbers) return {};
    return glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

void TomlTable::finish() const {
    for (const auto& [key, node] : table_)
        if (std::find(known_.begin(), known_.end(), key.str()) == known_.end())
            file_.error(key.source(),
                        fmt::format("{} has no key \"{}\"; {}", name_, key.str(), allowed_words(key.str(), known_)));
}

} // namespace lueur
