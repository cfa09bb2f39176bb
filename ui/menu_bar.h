// The menu bar. What it is asked for goes to UiState::commands, files to open to UiState::files_to_open.
#pragma once

#include "editor/document.h"
#include "ui/preferences.h"
#include "ui/ui_state.h"

namespace lueur {

// Returns the interface size that was chosen, or 0.
double menu_bar(const Document& document, const Preferences& preferences, UiState& state);

// Scenes that come with the program.
std::vector<std::filesystem::path> example_scenes();

} // namespace lueur
