// The [display] table of a scene file (scene_file.h has the format).
#pragma once

#include <string>

#include "core/display/display_settings.h"
#include "core/scene/toml_values.h"

namespace lueur {

// Changes what the table names; mistakes are told.
void read_toml_display(TomlTable& table, DisplaySettings& display);

// Lines of the table, without its head: the settings that say most, and all that differ from the default.
std::string toml_from_display(const DisplaySettings& display);

} // namespace lueur
