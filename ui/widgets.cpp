#include "ui/widgets.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui_internal.h>

namespace lueur {

ImU32 packed(const ImVec4& colour, float alpha) {
    return ImGui::ColorConvertFloat4ToU32({colour.x, colour.y, colour.z, colour.w * alpha});
}

void tooltip(const UiState& state, const char* text) {
    if (!text || !*text) return;
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) ||
        ImGui::GetCurrentContext()->HoveredIdTimer < 0.45f)
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(320 * state.scale);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void row_label(const UiState& state, const char* label, const char* tip) {
    ImGui::AlignTextToFramePadding();
    const float start = ImGui::GetCursorPosX();
    ImGui::TextColored(colours::dim, "%s", label);
    if (tip && ImGui::IsItemHovered()) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(320 * state.scale);
        ImGui::TextUnformatted(tip);
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
    ImGui::SameLine(start + 104 * state.scale);
    ImGui::SetNextItemWidth(-1);
}

void section(const UiState& state, const char* title) {
    ImGui::Dummy({0, 2 * state.scale});
    ImGui::PushFont(state.fonts.heading);
    ImGui::TextUnformatted(title);
    ImGui::PopFont();
    const auto low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const float end = ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x;
    const float y = std::floor(0.5f * (low.y + high.y)) + 1;
    if (high.x + 10 * state.scale < end)
        ImGui::GetWindowDrawList()->AddLine({high.x + 10 * state.scale, y}, {end, y}, packed(colours::line));
}

bool segmented(UiState& state, const char* id, std::initializer_list<Choice> choices, int& current) {
    ImGui::PushID(id);
    const float gap = 1 * state.scale, n = static_cast<float>(choices.size());
    const float total = ImGui::CalcItemWidth(), width = std::floor((total - gap * (n - 1)) / n);
    bool changed = false;
    int index = 0;
    for (const auto& choice : choices) {
        if (index > 0) ImGui::SameLine(0, gap);
        const bool down = index == current;
        ImGui::PushStyleColor(ImGuiCol_Button, down ? ImVec4(0.36f, 0.36f, 0.36f, 1) : colours::frame);
        ImGui::PushStyleColor(ImGuiCol_Text, down ? ImVec4(1, 1, 1, 1) : ImVec4(0.72f, 0.72f, 0.72f, 1));
        if (ImGui::Button(choice.name, {width, 0}) && !down) {
            current = index;
            changed = true;
        }
        ImGui::PopStyleColor(2);
        if (down) {
            const auto low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
            ImGui::GetWindowDrawList()->AddRectFilled({low.x + 4 * state.scale, high.y - 2 * state.scale},
                                                      {high.x - 4 * state.scale, high.y}, packed(colours::accent));
        }
        tooltip(state, choice.tip);
        state.layout_log.widget(std::string(id) + ":" + choice.name);
        ++index;
    }
    ImGui::PopID();
    return changed;
}

bool log_slider(const char* id, double& value, double low, double high, const char* format) {
    return ImGui::SliderScalar(id, ImGuiDataType_Double, &value, &low, &high, format, ImGuiSliderFlags_Logarithmic);
}

void swatch(const UiState& state, const char* id, const glm::vec3& c, float size) {
    const float edge = size > 0 ? size : ImGui::GetFrameHeight() - 6 * state.scale;
    const auto corner = ImGui::GetCursorScreenPos();
    ImGui::PushID(id);
    ImGui::Dummy({edge, edge});
    ImGui::PopID();
    auto* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(corner, {corner.x + edge, corner.y + edge}, packed({c.r, c.g, c.b, 1}), 3 * state.scale);
    draw->AddRect(corner, {corner.x + edge, corner.y + edge}, IM_COL32(255, 255, 255, 46), 3 * state.scale);
}

std::string whole_number(std::uint64_t value) {
    auto digits = fmt::format("{}", value);
    for (int i = static_cast<int>(digits.size()) - 3; i > 0; i -= 3)
        digits.insert(static_cast<std::size_t>(i), "\xe2\x80\x89"); // thin space
    return digits;
}

std::string short_number(double value) {
    if (!std::isfinite(value)) return "-";
    const double size = std::abs(value);
    if (size == 0) return "0";
    if (size >= 1e7 || size < 1e-4) return fmt::format("{:.2e}", value);
    if (size >= 1000) {
        const auto digits = whole_number(static_cast<std::uint64_t>(std::llround(size)));
        return value < 0 ? fmt::format("-{}", digits) : digits;
    }
    const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 6);
    return fmt::format("{:.{}f}", value, decimals);
}

} // namespace lueur
