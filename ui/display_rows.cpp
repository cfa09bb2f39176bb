#include "ui/display_rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "ui/widgets.h"

namespace lueur {

namespace {
float reset_width(const UiState& state) {
    return 22 * state.scale;
}
} // namespace

void value_row(const UiState& state, const char* label, const char* tip) {
    row_label(state, label, tip);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - reset_width(state));
}

bool reset_button(UiState& state, const char* id, bool is_other, const char* tip) {
    if (!is_other) return false;
    ImGui::SameLine(0, 0);
    const auto corner = ImGui::GetCursorScreenPos();
    const float width = reset_width(state), height = ImGui::GetFrameHeight();
    const bool pressed = ImGui::InvisibleButton((std::string("##reset_") + id).c_str(), {width, height});
    state.layout_log.widget(std::string("reset:") + id);
    const bool hovered = ImGui::IsItemHovered();
    tooltip(state, tip);
    // An arrow that goes round.
    auto* draw = ImGui::GetWindowDrawList();
    const float radius = 4.2f * state.scale;
    const ImVec2 centre{corner.x + 0.5f * width + state.scale, corner.y + 0.5f * height};
    const ImU32 colour = packed(hovered ? colours::accent : colours::dim);
    constexpr float pi = std::numbers::pi_v<float>;
    draw->PathArcTo(centre, radius, -0.75f * pi, 0.85f * pi, 20);
    draw->PathStroke(colour, 0, 1.4f * state.scale);
    const float head = 3.2f * state.scale;
    const ImVec2 tip_at{centre.x + radius * std::cos(-0.75f * pi), centre.y + radius * std::sin(-0.75f * pi)};
    draw->AddTriangleFilled({tip_at.x - 0.9f * head, tip_at.y + 0.55f * head},
                            {tip_at.x + 0.75f * head, tip_at.y + 0.75f * head},
                            {tip_at.x - 0.25f * head, tip_at.y - 0.95f * head}, colour);
    return pressed;
}

bool number_row(UiState& state, const NumberRow& row, double& value, double usual) {
    value_row(state, row.label, row.tip);
    const auto flags = row.logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
    bool changed = ImGui::SliderScalar((std::string("##") + row.id).c_str(), ImGuiDataType_Double, &value, &row.low,
                                       &row.high, row.format, flags);
    state.layout_log.widget(row.id);
    const auto tip = fmt::format("Back to {}", short_number(usual));
    if (reset_button(state, row.id, value != usual, tip.c_str())) {
        value = usual;
        changed = true;
    }
    return changed;
}

} // namespace lueur
