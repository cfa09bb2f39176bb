// The options of `lueur render` that say how its picture is displayed.
#pragma once

#include <CLI/CLI.hpp>

#include "editor/commands/command_line.h"

namespace lueur {

void add_display_options(CLI::App& app, RenderCommand& render);
void add_false_colour_options(CLI::App& app, RenderCommand& render);

// Options that would do nothing are mistakes, not noise: throws CLI::ValidationError.
void check_display_options(const CLI::App& app, const RenderCommand& render);

} // namespace lueur
