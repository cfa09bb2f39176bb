// A button that shows which spectrum of the library is used and opens the library to choose another.
#pragma once

#include <optional>

#include "core/scene/spectra.h"
#include "ui/ui_state.h"

namespace lueur {

// As wide as the next item. `current`: its name, empty when there is none yet. The chosen spectrum once.
std::optional<LibrarySpectrum> library_button(UiState& state, const char* id, LibraryKind kind,
                                              const std::string& current);

// By name, without the picker; nothing when it is not there or cannot be read.
std::optional<LibrarySpectrum> from_library(UiState& state, LibraryKind kind, const std::string& name);

} // namespace lueur
