// Options of `lueur form-factors`.
#pragma once

#include <CLI/CLI.hpp>

#include "editor/commands/command_line.h"

namespace lueur {

void add_form_factor_command(CLI::App& app, FormFactorsCommand& command);
void check_form_factor_command(const CLI::App& app, FormFactorsCommand& command); // throws CLI::ValidationError

} // namespace lueur
