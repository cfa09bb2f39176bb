// False colours in the window: their range, and the legend over the picture.
#pragma once

#include <memory>

#include "core/display/false_colour.h"
#include "editor/snapshot.h"
#include "ui/ui_state.h"

namespace lueur {

// The ranges in use, remembered for the field they were fitted to.
struct FittedScales {
    std::shared_ptr<const Mesh> mesh;
    std::vector<float> areas; // of its vertices
    std::shared_ptr<const Field> field;
    FalseColourSettings luminance, illuminance;         // as set
    FalseColourSettings luminance_now, illuminance_now; // as used
};
// Puts the ranges in use into the settings to display with.
void fit_scales(FittedScales& fitted, const Snapshot& snapshot, DisplaySettings& display);

// A bar with round numbers and, where contours are drawn, a mark at each level. Its lower left corner is at (x, y), in
// pixels.
void draw_legend(const UiState& state, float x, float y, const char* title, const FalseColourSettings& scale);

// "100", "1 000", "0.02": a round number as the legend writes it.
std::string tick_text(double value);

} // namespace lueur
