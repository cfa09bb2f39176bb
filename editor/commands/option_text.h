// Options of the command line whose mistakes get one line that says what is allowed.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "editor/commands/number_text.h"

namespace lueur {

// Every value is read from its text here, so that a mistake gets one line that says what is allowed.
using Read = std::function<void(const std::string&)>;

[[noreturn]] inline void refuse(const std::string& option, const std::string& text, const std::string& allowed) {
    throw CLI::ValidationError(option, fmt::format("'{}' cannot be used; {}", text, allowed));
}

// CLI11 indents what follows a line end, and does not wrap by itself.
inline std::string wrapped(const std::string& text) {
    constexpr std::size_t width = 84;
    std::string lines;
    std::size_t column = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        if (column > 0 && column + 1 + end - at > width) {
            lines += '\n';
            column = 0;
        } else if (column > 0) {
            lines += ' ';
            ++column;
        }
        lines += text.substr(at, end - at);
        column += end - at;
        at = end + 1;
    }
    return lines;
}

inline CLI::Option* add(CLI::App& app, const std::string& name, const std::string& type, const std::string& help,
                        const Read& read) {
    return app.add_option_function<std::string>(name, read, wrapped(help))->type_name(type);
}

struct Range {
    double low, high;
    bool above_low = false; // low itself is not allowed
    bool contains(double value) const { return (above_low ? value > low : value >= low) && value <= high; }
    std::string text() const {
        if (above_low) return fmt::format("a number above {} and up to {} is allowed", low, high);
        return fmt::format("a number from {} to {} is allowed", low, high);
    }
};

template <typename Target>
CLI::Option* add_number(CLI::App& app, const std::string& name, const std::string& type, const std::string& help,
                        Range range, Target& target, double scale = 1) {
    return add(app, name, type, help, [name, range, scale, &target](const std::string& text) {
        const auto value = number_from_text(text);
        if (!value || !range.contains(*value)) refuse(name, text, range.text());
        target = *value * scale;
    });
}

template <typename Target>
CLI::Option* add_integer(CLI::App& app, const std::string& name, const std::string& help, long low, long high,
                         Target& target) {
    return add(app, name, "N", help, [name, low, high, &target](const std::string& text) {
        const auto value = integer_from_text(text);
        if (!value || *value < low || *value > high)
            refuse(name, text, fmt::format("a whole number from {} to {} is allowed", low, high));
        target = static_cast<std::uint32_t>(*value);
    });
}

template <typename Value, std::size_t N>
struct Choices {
    std::array<std::pair<const char*, Value>, N> list;
    std::string text() const {
        std::string names;
        for (const auto& [name, value] : list) names += (names.empty() ? "" : ", ") + std::string(name);
        return names;
    }
};
template <typename Value, std::size_t N, typename Target>
CLI::Option* add_choice(CLI::App& app, const std::string& name, const std::string& help,
                        const Choices<Value, N>& choices, Target& target) {
    return add(app, name, "NAME", fmt::format("{}: {}", help, choices.text()),
               [name, choices, &target](const std::string& text) {
                   for (const auto& [known, value] : choices.list)
                       if (text == known) {
                           target = value;
                           return;
                       }
                   refuse(name, text, "allowed: " + choices.text());
               });
}

} // namespace lueur
