// The few compound widgets that panels share.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

#include <glm/glm.hpp>
#include <imgui.h>

#include "ui/ui_state.h"

namespace lueur {

// A dim label at the left of the row, the next item takes the rest of it. `tip` is shown when the label or the item is
// hovered.
void row_label(const UiState& state, const char* label, const char* tip = nullptr);
void tooltip(const UiState& state, const char* text); // for the last item
void section(const UiState& state, const char* title);

struct Choice {
    const char* name;
    const char* tip;
};
// Buttons side by side of which one is down; true when another was pressed. Widgets are logged as `id:name`.
bool segmented(UiState& state, const char* id, std::initializer_list<Choice> choices, int& current);

// Logarithmic slider in double; ctrl-click to type.
bool log_slider(const char* id, double& value, double low, double high, const char* format);

void swatch(const UiState& state, const char* id, const glm::vec3& encoded_colour, float size = 0);

std::string short_number(double value); // 3 significant figures, thousands with a thin space: "1 240", "0.0317"

std::string whole_number(std::uint64_t value);

ImU32 packed(const ImVec4& colour, float alpha = 1);

} // namespace lueur
