#include "ui/main_layout.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <imgui.h>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBackground;

struct Area {
    float x, y, width, height;
};

bool begin(const char* name, const Area& area, ImGuiWindowFlags more = 0) {
    ImGui::SetNextWindowPos({area.x, area.y});
    ImGui::SetNextWindowSize({area.width, area.height});
    return ImGui::Begin(name, nullptr, fixed | more);
}

// The ground is the window's own (Window::end_frame); a line is all that parts the panels.
void divide(const Area& area) {
    ImGui::GetBackgroundDrawList()->AddRectFilled({area.x, area.y}, {area.x + area.width, area.y + area.height},
                                                  packed(colours::backdrop));
}

enum class Across { columns, rows };

// A line that can be dragged; `value` is the unscaled size of what lies after it.
void splitter(const char* name, const Area& line, Across across, float& value, float least, float most, float scale) {
    const float grip = 6 * scale;
    Area area = line;
    (across == Across::columns ? area.x : area.y) -= 0.5f * grip;
    (across == Across::columns ? area.width : area.height) = grip;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    begin(name, area);
    ImGui::InvisibleButton("##grip", {std::max(area.width, 1.0f), std::max(area.height, 1.0f)});
    const bool active = ImGui::IsItemActive(), hovered = ImGui::IsItemHovered();
    if (active || hovered) {
        ImGui::SetMouseCursor(across == Across::columns ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
        ImGui::GetWindowDrawList()->AddRectFilled(
            {line.x - (across == Across::columns ? scale : 0), line.y - (across == Across::rows ? scale : 0)},
            {line.x + line.width + (across == Across::columns ? scale : 0),
             line.y + line.height + (across == Across::rows ? scale : 0)},
            packed(colours::accent, active ? 0.9f : 0.5f));
    }
    if (active) {
        const auto delta = ImGui::GetIO().MouseDelta;
        value =
            std::clamp(value - (across == Across::columns ? delta.x : delta.y) / scale, least, std::max(least, most));
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
}

void toolbar(UiState& state, const Snapshot& snapshot) {
    const float scale = state.scale;
    ImGui::SetNextItemWidth(std::min(430 * scale, 0.55f * ImGui::GetContentRegionAvail().x));
    int view = static_cast<int>(state.view);
    if (segmented(state, "view",
                  {{"Shaded", "The light as the eye at the camera sees it (1)"},
                   {"Elements", "The triangles that the light is computed on (2)"},
                   {"Unshot", "Light that has not been sent on yet (3)"},
                   {"Luminance", "cd/m² in false colours, with contours (4)"},
                   {"Illuminance", "lx in false colours, with isolux lines (5)"}},
                  view))
        state.view = static_cast<ViewMode>(view);
    ImGui::SameLine(0, 18 * scale);
    const auto button = [&](const char* name, const char* tip, Command command) {
        ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0, 0, 0, 0));
        if (ImGui::Button(name)) state.commands.push_back(command);
        ImGui::PopStyleColor();
        tooltip(state, tip);
        state.layout_log.widget(std::string("toolbar:") + name);
        ImGui::SameLine(0, 2 * scale);
    };
    button("Frame", "Move the camera so that the selection, or everything, fills the picture (F)",
           Command::frame_selection);
    button("Home", "The scene's own camera (Home)", Command::home);
    button(state.paused ? "Go on" : "Pause", "Space", Command::pause);
    button("Save picture", "A PNG in the current folder, with how it was made in its metadata (P or F12)",
           Command::screenshot);
    (void)snapshot;
}

template <typename Panel>
void tab(const Document& document, const Snapshot& snapshot, UiState& state, const char* name, bool bring_to_front,
         std::vector<Edit>& edits, Panel panel) {
    const bool open = ImGui::BeginTabItem(name, nullptr, bring_to_front ? ImGuiTabItemFlags_SetSelected : 0);
    state.layout_log.widget(std::string("tab:") + name);
    if (!open) return;
    ImGui::BeginChild("##panel", {0, 0}, false);
    if (auto edit = panel(document, snapshot, state)) edits.push_back(std::move(*edit));
    ImGui::EndChild();
    ImGui::EndTabItem();
}

} // namespace

std::vector<Edit> main_layout(const Document& document, const Snapshot& snapshot, UiState& state,
                              const std::function<std::optional<Edit>()>& draw_viewport) {
    const float scale = state.scale;
    auto& layout = state.layout;
    state.spectrum_target = {}; // a panel that is drawn says what it has open
    const auto* screen = ImGui::GetMainViewport();
    const float line = std::max(1.0f, std::floor(scale));
    const float status_height = std::floor(ImGui::GetTextLineHeight() + 10 * scale);
    const Area all{screen->WorkPos.x, screen->WorkPos.y, screen->WorkSize.x, screen->WorkSize.y - status_height};
    const bool panels = layout.panels_visible;
    const float column =
        panels ? std::floor(std::clamp(layout.column_width * scale, 200 * scale, 0.6f * all.width)) : 0;
    const float strip = panels ? std::floor(std::clamp(layout.strip_height * scale, 80 * scale, 0.6f * all.height)) : 0;
    const float gap = panels ? line : 0;
    const float left = std::floor(all.width - column - gap);
    std::vector<Edit> edits;

    // The panels first: their edits of this frame are not shown before the next, the picture is the newest either way.
    if (panels) {
        const float lower = std::floor(std::clamp(layout.lower_height * scale, 100 * scale, 0.75f * all.height));
        const float x = all.x + left + gap;
        begin("##upper", {x, all.y, column, all.height - lower - gap});
        if (ImGui::BeginTabBar("##scene")) {
            const bool luminaires_first = std::exchange(state.show_luminaires, false);
            tab(document, snapshot, state, "Materials", false, edits, materials_panel);
            tab(document, snapshot, state, "Luminaires", luminaires_first, edits, luminaires_panel);
            tab(document, snapshot, state, "Colour", false, edits, [](const Document& d, const Snapshot&, UiState& s) {
                colour_panel(d, s);
                return std::optional<Edit>();
            });
            ImGui::EndTabBar();
        }
        ImGui::End();
        begin("##lower", {x, all.y + all.height - lower, column, lower});
        if (ImGui::BeginTabBar("##output")) {
            tab(document, snapshot, state, "Display", false, edits, display_panel);
            tab(document, snapshot, state, "Solver", false, edits, solver_panel);
            tab(document, snapshot, state, "Chart", false, edits, chart_panel);
            ImGui::EndTabBar();
        }
        ImGui::End();

        const float probe_width = std::min(330 * scale, 0.42f * left);
        begin("##plot", {all.x, all.y + all.height - strip, left - probe_width - gap, strip},
              ImGuiWindowFlags_NoScrollWithMouse);
        const auto room = ImGui::GetContentRegionAvail();
        convergence_plot(snapshot, document.scene().solve.target_error, state, room.x, room.y);
        ImGui::End();
        begin("##probe", {all.x + left - probe_width, all.y + all.height - strip, probe_width, strip},
              ImGuiWindowFlags_NoScrollWithMouse);
        probe_readout(document, state);
        ImGui::End();
        divide({all.x + left, all.y, gap, all.height});
        divide({all.x, all.y + all.height - strip - gap, left, gap});
        divide({all.x + left - probe_width - gap, all.y + all.height - strip, gap, strip});
        divide({x, all.y + all.height - lower - gap, column, gap});
        splitter("##split_column", {all.x + left, all.y, gap, all.height}, Across::columns, layout.column_width, 260,
                 0.6f * all.width / scale, scale);
        splitter("##split_strip", {all.x, all.y + all.height - strip - gap, left, gap}, Across::rows,
                 layout.strip_height, 100, 0.6f * all.height / scale, scale);
        splitter("##split_panels", {x, all.y + all.height - lower - gap, column, gap}, Across::rows,
                 layout.lower_height, 140, 0.75f * all.height / scale, scale);
    }

    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * scale, 5 * scale});
    const float bar = std::floor(ImGui::GetFrameHeight() + 10 * scale);
    begin("##toolbar", {all.x, all.y, left, bar}, ImGuiWindowFlags_NoScrollWithMouse);
    toolbar(state, snapshot);
    ImGui::End();
    ImGui::PopStyleVar();

    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    begin("##picture", {all.x, all.y + bar, left, all.height - bar - strip - gap}, ImGuiWindowFlags_NoScrollWithMouse);
    if (auto edit = draw_viewport()) edits.push_back(std::move(*edit));
    ImGui::End();
    ImGui::PopStyleVar();

    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12 * scale, 5 * scale});
    ImGui::GetBackgroundDrawList()->AddRectFilled({all.x, all.y + all.height},
                                                  {all.x + all.width, all.y + all.height + status_height},
                                                  packed({0.125f, 0.125f, 0.125f, 1}));
    begin("##status", {all.x, all.y + all.height, all.width, status_height}, ImGuiWindowFlags_NoScrollWithMouse);
    status_line(document, snapshot, state);
    ImGui::End();
    ImGui::PopStyleVar();
    return edits;
}

} // namespace lueur
