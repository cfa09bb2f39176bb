#include "ui/dialogs.h"

#include <array>

#include <imgui.h>

#include "ui/widgets.h"

namespace lueur {
namespace {

void centre_next() {
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
}

bool escape() {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
}

constexpr ImGuiWindowFlags box_flags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings;

void key_row(const UiState& state, const char* keys, const char* text) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(colours::accent, "%s", keys);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text);
    (void)state;
}

} // namespace

void errors_dialog(UiState& state) {
    if (state.open_errors.empty()) return;
    const char* id = "Could not open##errors";
    if (!ImGui::IsPopupOpen(id)) ImGui::OpenPopup(id);
    centre_next();
    ImGui::SetNextWindowSize({680 * state.scale, 320 * state.scale}, ImGuiCond_Appearing);
    if (!ImGui::BeginPopupModal(id, nullptr, box_flags)) return;
    ImGui::TextWrapped("%s could not be opened. The scene you had is still there.", state.open_errors_file.c_str());
    ImGui::Dummy({0, 2 * state.scale});
    std::string all;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImVec4(0.125f, 0.125f, 0.125f, 1));
    ImGui::BeginChild("##list", {0, -ImGui::GetFrameHeightWithSpacing() - 4 * state.scale}, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_HorizontalScrollbar);
    for (const auto& error : state.open_errors) {
        ImGui::TextUnformatted(error.c_str());
        all += error + "\n";
    }
    ImGui::EndChild();
    ImGui::PopStyleColor();
    if (ImGui::Button("Copy", {96 * state.scale, 0})) ImGui::SetClipboardText(all.c_str());
    ImGui::SameLine();
    if (ImGui::Button("Close", {96 * state.scale, 0}) || escape()) {
        state.open_errors.clear();
        ImGui::CloseCurrentPopup();
    }
    state.layout_log.widget("errors:close");
    ImGui::EndPopup();
}

void help_dialog(UiState& state) {
    if (!state.help_open) return;
    centre_next();
    ImGui::SetNextWindowSize({640 * state.scale, 0}, ImGuiCond_Appearing);
    if (ImGui::Begin("Keys and mouse", &state.help_open, box_flags | ImGuiWindowFlags_NoResize)) {
        ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {8 * state.scale, 2 * state.scale});
        if (ImGui::BeginTable("##columns", 2)) {
            ImGui::TableNextColumn();
            section(state, "Mouse, over the picture");
            if (ImGui::BeginTable("##mouse", 2, ImGuiTableFlags_SizingFixedFit)) {
                static constexpr std::array<std::array<const char*, 2>, 11> rows{{
                    {"Click", "select what is under the pointer"},
                    {"Drag", "turn round the target"},
                    {"Shift + drag", "move sideways"},
                    {"Wheel", "nearer, further"},
                    {"Right drag", "look around"},
                    {"W A S D", "walk ahead, left, back, right"},
                    {"E  Q", "up, down"},
                    {"Shift", "walk four times as fast"},
                    {"Drop a scene", "opens it"},
                    {"Drop a picture", "texture of the surface there"},
                    {"Ctrl + click", "on a slider: type the value"},
                }};
                for (const auto& row : rows) key_row(state, row[0], row[1]);
                ImGui::EndTable();
            }
            ImGui::TableNextColumn();
            section(state, "Keys");
            if (ImGui::BeginTable("##keys", 2, ImGuiTableFlags_SizingFixedFit)) {
                for (const auto& command : all_commands())
                    if (*command.keys) key_row(state, command.keys, command.text);
                ImGui::EndTable();
            }
            ImGui::EndTable();
        }
        ImGui::PopStyleVar();
        if (ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows) && escape()) state.help_open = false;
    }
    ImGui::End();
}

void about_dialog(UiState& state) {
    if (!state.about_open) return;
    centre_next();
    if (ImGui::Begin("About Lueur", &state.about_open,
                     box_flags | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_AlwaysAutoResize)) {
        ImGui::PushFont(state.fonts.heading);
        ImGui::TextUnformatted("Lueur " LUEUR_VERSION);
        ImGui::PopFont();
        ImGui::TextUnformatted("A live lighting editor: radiosity, in spectra.");
        ImGui::TextColored(colours::dim, "After Kadi Bouatouch's lectures on global illumination.");
        if (ImGui::IsWindowFocused() && escape()) state.about_open = false;
    }
    ImGui::End();
}

UnsavedAnswer unsaved_dialog(const Document& document, bool& open, UiState& state) {
    const char* id = "Unsaved changes##unsaved";
    if (open) {
        ImGui::OpenPopup(id);
        open = false;
    }
    centre_next();
    if (!ImGui::BeginPopupModal(id, nullptr, box_flags | ImGuiWindowFlags_AlwaysAutoResize)) return UnsavedAnswer::none;
    auto answer = UnsavedAnswer::none;
    const auto name = document.scene().name.empty() ? document.file().filename().string() : document.scene().name;
    ImGui::Text("%s has changes that are not saved.", name.empty() ? "The scene" : name.c_str());
    ImGui::Dummy({360 * state.scale, 4 * state.scale});
    const ImVec2 size{112 * state.scale, 0};
    if (ImGui::Button("Save", size)) answer = UnsavedAnswer::save;
    ImGui::SameLine();
    if (ImGui::Button("Do not save", size)) answer = UnsavedAnswer::discard;
    state.layout_log.widget("unsaved:discard");
    ImGui::SameLine();
    if (ImGui::Button("Cancel", size) || escape()) answer = UnsavedAnswer::cancel;
    state.layout_log.widget("unsaved:cancel");
    if (answer != UnsavedAnswer::none) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return answer;
}

} // namespace lueur
