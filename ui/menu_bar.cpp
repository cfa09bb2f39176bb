#include "ui/menu_bar.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/asset_path.h"

namespace lueur {
namespace {

void item(UiState& state, Command command, bool ticked = false, bool enabled = true, const char* text = nullptr) {
    const auto& entry = info(command);
    if (ImGui::MenuItem(text ? text : entry.text, entry.keys, ticked, enabled)) state.commands.push_back(command);
    state.layout_log.widget(std::string("menu:") + entry.text);
}

bool menu(UiState& state, const char* name) {
    const bool open = ImGui::BeginMenu(name);
    if (!open) state.layout_log.widget(std::string("menu:") + name);
    return open;
}

} // namespace

std::vector<std::filesystem::path> example_scenes() {
    std::vector<std::filesystem::path> scenes;
    std::error_code error;
    for (const auto& file : std::filesystem::directory_iterator(asset_path(""), error))
        if (file.path().extension() == ".toml") scenes.push_back(file.path());
    std::ranges::sort(scenes);
    return scenes;
}

double menu_bar(const Document& document, const Preferences& preferences, UiState& state) {
    double chosen_scale = 0;
    if (!ImGui::BeginMainMenuBar()) return 0;
    if (menu(state, "File")) {
        item(state, Command::open);
        if (ImGui::BeginMenu("Open recent", !preferences.recent.empty())) {
            for (const auto& file : preferences.recent)
                if (ImGui::MenuItem(file.string().c_str())) state.files_to_open.push_back(file);
            ImGui::EndMenu();
        }
        if (ImGui::BeginMenu("Examples")) {
            for (const auto& file : example_scenes())
                if (ImGui::MenuItem(file.stem().string().c_str())) state.files_to_open.push_back(file);
            ImGui::EndMenu();
        }
        ImGui::Separator();
        item(state, Command::save);
        item(state, Command::save_as);
        item(state, Command::screenshot);
        item(state, Command::screenshot_as);
        item(state, Command::spectral_picture_as);
        ImGui::Separator();
        item(state, Command::quit);
        ImGui::EndMenu();
    }
    if (menu(state, "Edit")) {
        const auto undo = document.can_undo() ? "Undo: " + document.undo_text() : std::string("Undo");
        const auto redo = document.can_redo() ? "Redo: " + document.redo_text() : std::string("Redo");
        item(state, Command::undo, false, document.can_undo(), undo.c_str());
        item(state, Command::redo, false, document.can_redo(), redo.c_str());
        ImGui::Separator();
        item(state, Command::deselect, false, state.selected.has_value());
        ImGui::EndMenu();
    }
    if (menu(state, "View")) {
        item(state, Command::view_shaded, state.view == ViewMode::shaded);
        item(state, Command::view_elements, state.view == ViewMode::elements);
        item(state, Command::view_unshot, state.view == ViewMode::unshot);
        item(state, Command::view_luminance, state.view == ViewMode::luminance);
        item(state, Command::view_illuminance, state.view == ViewMode::illuminance);
        item(state, Command::view_side_by_side, state.view == ViewMode::side_by_side);
        item(state, Command::view_difference, state.view == ViewMode::difference);
        item(state, Command::view_error, state.view == ViewMode::error);
        ImGui::Separator();
        item(state, Command::frame_selection);
        item(state, Command::home);
        ImGui::Separator();
        item(state, Command::toggle_panels, state.layout.panels_visible);
        item(state, Command::toggle_probe, state.layout.probe_at_cursor);
        ImGui::Separator();
        item(state, Command::toggle_links, state.links_shown);
        item(state, Command::toggle_levels, state.levels_shown);
        ImGui::Separator();
        if (ImGui::BeginMenu("Size of the interface")) {
            for (const double scale : {0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75, 2.0, 2.5})
                if (ImGui::MenuItem(fmt::format("{:.0f} %", 100 * scale).c_str(), nullptr,
                                    std::abs(preferences.scale - scale) < 0.01))
                    chosen_scale = scale;
            ImGui::EndMenu();
        }
        ImGui::EndMenu();
    }
    if (menu(state, "Solve")) {
        item(state, Command::pause, state.paused);
        item(state, Command::step, false, state.paused);
        item(state, Command::restart);
        ImGui::EndMenu();
    }
    if (menu(state, "Help")) {
        item(state, Command::help);
        item(state, Command::log);
        item(state, Command::about);
        ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
    return chosen_scale;
}

} // namespace lueur
