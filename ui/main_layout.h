// Where everything is: viewport with its toolbar, the column of panels at the right, the strip with plot and probe, the
// status line.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "editor/document.h"
#include "editor/snapshot.h"
#include "ui/ui_state.h"

namespace lueur {

// Draws the whole area below the menu bar. `draw_viewport` fills what is left for the picture and may return a camera
// edit.
std::vector<Edit> main_layout(const Document& document, const Snapshot& snapshot, UiState& state,
                              const std::function<std::optional<Edit>()>& draw_viewport);

} // namespace lueur
