// The chromaticity diagram: what colours there are, which of them the display shows, and where the scene's lie.
#pragma once

#include <string>
#include <vector>

#include "core/spectrum/colour.h"
#include "ui/ui_state.h"

namespace lueur {

enum class MarkShape { disc, ring, square };
struct ChromaticityMark {
    Chromaticity xy;
    std::string label;
    MarkShape shape = MarkShape::disc;
    bool selected = false;
};

// `width` by `height` pixels at the cursor. Returns the number of the mark that was clicked.
std::optional<std::size_t> chromaticity_diagram(const RgbSpace& display, const std::vector<ChromaticityMark>& marks,
                                                UiState& state, float width, float height);

} // namespace lueur
