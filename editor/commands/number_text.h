// Numbers as people write them, checked: nothing is guessed and nothing after the number is overlooked.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace lueur {

// A finite number with a decimal point, in the whole of `text`; independent of the locale.
inline std::optional<double> number_from_text(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
    return value;
}

inline std::optional<long> integer_from_text(std::string_view text) {
    long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

} // namespace lueur
