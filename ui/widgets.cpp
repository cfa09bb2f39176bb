#include "ui/widgets.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include "core/spectrum/colour.h"
#include "core/spectrum/observer.h"
#include "ui/swatch.h"

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

void spectrum_plot(const UiState& state, const char* id, const Spectrum& spectrum, double top) {
    const float height = 66 * state.scale, strip = 5 * state.scale, width = ImGui::GetContentRegionAvail().x;
    const auto corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(id, {std::max(width, 1.0f), height + strip + ImGui::GetTextLineHeight()});
    auto* draw = ImGui::GetWindowDrawList();
    const ImVec2 low{corner.x, corner.y}, high{corner.x + width, corner.y + height};
    draw->AddRectFilled(low, high, packed(colours::backdrop), 3 * state.scale);
    constexpr double first = 380, last = 780;
    const auto x_of = [&](double nm) { return low.x + static_cast<float>((nm - first) / (last - first)) * width; };
    if (top <= 0) {
        top = 1e-12;
        for (std::size_t i = 0; i < spectrum.nm.size(); ++i)
            if (spectrum.nm[i] >= first && spectrum.nm[i] <= last) top = std::max(top, 1.06 * spectrum.value[i]);
    }
    for (double nm = 400; nm < last; nm += 100) {
        draw->AddLine({x_of(nm), low.y}, {x_of(nm), high.y}, packed(colours::line, 0.7f));
        const auto text = fmt::format("{:.0f}{}", nm, nm == 700 ? " nm" : "");
        draw->AddText(state.fonts.small, state.fonts.small->FontSize,
                      {x_of(nm) - 10 * state.scale, high.y + strip + 1 * state.scale}, packed(colours::dim),
                      text.c_str());
    }
    const auto outside = top == 1 ? Outside::constant : Outside::zero; // a reflectance is drawn to 1
    if (!spectrum.nm.empty()) {
        // One column of pixels shows the largest value within it, so that a narrow line is never lost.
        ImVec2 before{};
        for (float x = low.x; x <= high.x; x += 1) {
            const double from = first + (last - first) * (x - low.x) / width, to = from + (last - first) / width;
            double value = value_at(spectrum, from, outside);
            auto sample = std::ranges::lower_bound(spectrum.nm, from);
            for (; sample != spectrum.nm.end() && *sample < to; ++sample)
                value = std::max(value, spectrum.value[static_cast<std::size_t>(sample - spectrum.nm.begin())]);
            const float share = static_cast<float>(std::clamp(value / top, 0.0, 1.0));
            const ImVec2 now{x, high.y - 1 - share * (height - 4 * state.scale)};
            if (x > low.x) draw->AddLine(before, now, packed(colours::accent), 1.5f * state.scale);
            before = now;
        }
    } else {
        const char* text = "no curve: a mixture of the display's primaries";
        draw->AddText(state.fonts.small, state.fonts.small->FontSize,
                      {low.x + 8 * state.scale, low.y + 22 * state.scale}, packed(colours::dim), text);
    }
    for (float x = low.x; x < high.x; x += 2) {
        const double nm = first + (last - first) * (x - low.x) / width;
        Rgb rgb = rgb_from_xyz(srgb) * observer_xyz(nm);
        rgb = glm::max(rgb, 0.0) / 1.8;
        const auto c = encoded(rgb);
        draw->AddRectFilled({x, high.y}, {std::min(x + 2, high.x), high.y + strip}, packed({c.r, c.g, c.b, 1}));
    }
    if (ImGui::IsItemHovered() && !spectrum.nm.empty()) {
        const double nm = first + (last - first) * (ImGui::GetIO().MousePos.x - low.x) / width;
        ImGui::SetTooltip("%.0f nm: %s", nm, short_number(value_at(spectrum, nm, outside)).c_str());
    }
}

bool file_row(UiState& state, const SpectrumFile& file) {
    row_label(state, "From");
    ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {0, 0.5f});
    const bool pressed = ImGui::Button((file.path + "##file").c_str(), {-1, 0});
    ImGui::PopStyleVar();
    const auto whole =
        file.path + (file.column.empty() ? "" : ", column " + file.column) + "\nPress to choose another file.";
    tooltip(state, whole.c_str());
    state.layout_log.widget("spectrum_file");
    row_label(state, "Column", "Name of the column to read from the next file you choose; empty: the first.");
    ImGui::InputTextWithHint("##column", file.column.empty() ? "first" : file.column.c_str(), &state.spectrum_column);
    return pressed;
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
