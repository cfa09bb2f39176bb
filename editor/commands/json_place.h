// Where in a JSON text a value stands, for errors that name line and column.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/scene/diagnostics.h"

namespace lueur {

Place place_at(std::string_view text, std::size_t byte);

// Steps from the root: names of members and indices of elements. `text` must be JSON that has such a value; else the
// place of the last step that is there.
using JsonStep = std::variant<std::string, std::size_t>;
Place place_of(std::string_view text, const std::vector<JsonStep>& steps);

} // namespace lueur
