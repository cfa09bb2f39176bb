// The rules of the house: who may include whom, and what lies where.
//
// core/spectrum <- core/display <- core/scene <- core/transport <- core/solve <- core/view <- editor <- ui: a room
// includes itself and what stands to its left. Each foreign library that is not plain mathematics or text has one
// place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lueur {

// One #include of a file, as written: path without its brackets or quotes.
struct Include {
    std::string path;
    bool quoted = false; // "..." instead of <...>
    int line = 0;
};

std::vector<Include> includes_of(std::string_view source);

// Why `file` (relative to the repository's root, with '/') may not have that include; empty when it may.
std::optional<std::string> include_fault(std::string_view file, const Include& include);

// Why an entry of the repository's root does not belong there; empty when it does.
std::optional<std::string> root_entry_fault(std::string_view name, bool is_folder);

// Why a file under assets/ may not be there; empty when it may.
std::optional<std::string> asset_fault(std::string_view file, std::uintmax_t bytes);

} // namespace lueur
