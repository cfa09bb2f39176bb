// What the parts of the display panel share: rows with a value and a button that puts it back.
#pragma once

#include <optional>

#include "core/display/display.h"
#include "ui/ui_state.h"

namespace lueur {

// The settings being changed in this frame.
struct DisplayDraft {
    DisplaySettings stored; // as the document has them
    DisplaySettings now;    // with the numbers in use
    DisplaySettings changed;
    bool any = false;
};

// A label, and room for a widget with a reset button after it.
void value_row(const UiState& state, const char* label, const char* tip = nullptr);
// The button, shown only where the value is another than the default; true when pressed. Call after the widget.
bool reset_button(UiState& state, const char* id, bool is_other, const char* tip);

// Logarithmic slider over a number of the settings, with its reset button.
struct NumberRow {
    const char *id, *label, *tip;
    double low, high;   // of the slider; ctrl-click takes what is allowed
    const char* format; // printf, with the unit
    bool logarithmic = true;
};
bool number_row(UiState& state, const NumberRow& row, double& value, double usual);

// Parts of the panel.
void monitor_rows(UiState& state, DisplayDraft& draft); // primaries, curve, gamma
void calibration_rows(UiState& state, const DisplaySettings& display);
void false_colour_rows(UiState& state, DisplayDraft& draft); // of the quantity in view

} // namespace lueur
