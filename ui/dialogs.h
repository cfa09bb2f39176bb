// The boxes that open over the window.
#pragma once

#include "editor/document.h"
#include "ui/ui_state.h"

namespace lueur {

// Errors of a file that could not be opened, in a list that scrolls and can be copied.
void errors_dialog(UiState& state);
void help_dialog(UiState& state);
void about_dialog(UiState& state);

enum class UnsavedAnswer { none, save, discard, cancel };
// Asks what to do with unsaved changes; `open` on the first frame.
UnsavedAnswer unsaved_dialog(const Document& document, bool& open, UiState& state);

} // namespace lueur
