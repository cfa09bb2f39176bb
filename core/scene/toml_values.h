// Checked reading of TOML values: wrong types, values out of range and unknown keys each become an error with its
// place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <toml++/toml.h>

#include "core/scene/diagnostics.h"

namespace lueur {

struct TomlFile {
    std::string name; // as the user gave it
    Diagnostics& diagnostics;

    void error(const toml::node& node, std::string_view what) const { error(node.source(), what); }
    void error(const toml::source_region& source, std::string_view what) const;
};

Place place_of(const toml::node& node);

struct NumberRange {
    double low = -1e300, high = 1e300;
    bool low_allowed = true; // false: only above `low`
    std::string text;        // "0..1", for messages
};

// Each gives nothing after having told the error.
std::optional<double> read_number(const TomlFile& file, const toml::node& node, const NumberRange& range,
                                  std::string_view what);
std::optional<std::vector<double>> read_numbers(const TomlFile& file, const toml::node& node, std::size_t count,
                                                const NumberRange& range, std::string_view what);
std::optional<std::string> read_text(const TomlFile& file, const toml::node& node, std::string_view what);

// "did you mean 'x'?" in front of the allowed words, when one is near.
std::string allowed_words(std::string_view word, const std::vector<std::string>& allowed);

// One table being read. Every key asked for is a key that is allowed; finish() tells the others.
class TomlTable {
public:
    TomlTable(const TomlFile& file, const toml::table& table, std::string name)
        : file_(file)
        , table_(table)
        , name_(std::move(name)) {}

    const TomlFile& file() const { return file_; }
    const toml::table& table() const { return table_; }

    const toml::node* find(std::string_view key);
    const toml::node* require(std::string_view key, std::string_view allowed);

    // Missing key: nothing, silently. Wrong value: nothing, told.
    std::optional<double> number(std::string_view key, const NumberRange& range);
    std::optional<std::int64_t> integer(std::string_view key, std::int64_t low, std::int64_t high);
    std::optional<bool> boolean(std::string_view key);
    std::optional<std::string> text(std::string_view key); // not empty
    std::optional<glm::dvec3> point(std::string_view key);

    // One of a few words; `words` in the order of messages.
    template <typename Enum>
    std::optional<Enum> choice(std::string_view key, const std::vector<std::pair<std::string, Enum>>& words) {
        const toml::node* node = find(key);
        if (!node) return {};
        const std::optional<std::string> word = read_text(file_, *node, key);
        if (!word) return {};
        std::vector<std::string> allowed;
        for (const auto& [name, value] : words) {
            if (*word == name) return value;
            allowed.push_back(name);
        }
        file_.error(*node, fmt::format("{} = \"{}\" is not known; {}", key, *word, allowed_words(*word, allowed)));
        return {};
    }

    void finish() const;

private:
    const TomlFile& file_;
    const toml::table& table_;
    std::string name_; // "[camera]", for messages
    std::vector<std::string> known_;
};

} // namespace lueur
