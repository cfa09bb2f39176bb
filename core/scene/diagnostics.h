// Errors and warnings of a file, collected while it is read: `FILE:LINE:COLUMN: what is wrong; what is allowed`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace lueur {

struct Place {
    std::uint32_t line = 0, column = 0; // 1-based; 0: the file as a whole
};

struct Diagnostics {
    std::vector<std::string> errors, warnings;

    void error(const std::string& file, Place place, std::string_view what) {
        errors.push_back(text(file, place, what));
    }
    void warning(const std::string& file, Place place, std::string_view what) {
        warnings.push_back(text(file, place, what));
    }

private:
    static std::string text(const std::string& file, Place place, std::string_view what) {
        if (place.line == 0) return fmt::format("{}: {}", file, what);
        return fmt::format("{}:{}:{}: {}", file, place.line, place.column, what);
    }
};

} // namespace lueur
