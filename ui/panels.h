// The panels: look at the document, draw, return what the user changed. They keep nothing but what is in UiState.
#pragma once

#include <optional>
#include <string>

#include "editor/document.h"
#include "editor/snapshot.h"
#include "ui/ui_state.h"

namespace lueur {

std::optional<Edit> materials_panel(const Document& document, const Snapshot& snapshot, UiState& state);
std::optional<Edit> luminaires_panel(const Document& document, const Snapshot& snapshot, UiState& state);
std::optional<Edit> display_panel(const Document& document, const Snapshot& snapshot, UiState& state);
std::optional<Edit> solver_panel(const Document& document, const Snapshot& snapshot, UiState& state);
std::optional<Edit> chart_panel(const Document& document, const Snapshot& snapshot, UiState& state);

std::string plus_minus(const Probe& probe); // " ± 1.8 %", in which 95 % of the true values lie; empty where unknown

// These only show.
void convergence_plot(const Snapshot& snapshot, double target_error, UiState& state, float width, float height);
void probe_readout(const Document& document, UiState& state);
void colour_panel(const Document& document, UiState& state);
void status_line(const Document& document, const Snapshot& snapshot, UiState& state);

} // namespace lueur
