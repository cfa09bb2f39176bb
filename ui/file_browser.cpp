#include "ui/file_browser.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/asset_path.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string size_text(std::uintmax_t bytes) {
    if (bytes < 1024) return fmt::format("{} B", bytes);
    if (bytes < 1024 * 1024) return fmt::format("{} kB", bytes / 1024);
    return fmt::format("{:.1f} MB", static_cast<double>(bytes) / (1024.0 * 1024.0));
}

} // namespace

void FileBrowser::open(std::string title, std::vector<std::string> extensions, bool saving,
                       std::filesystem::path start) {
    title_ = std::move(title);
    extensions_ = std::move(extensions);
    saving_ = saving;
    overwrite_ = false;
    open_ = appearing_ = true;
    std::error_code error;
    start = std::filesystem::absolute(start, error);
    name_ = saving && !std::filesystem::is_directory(start, error) ? start.filename().string() : std::string();
    if (!std::filesystem::is_directory(start, error)) start = start.parent_path();
    if (!std::filesystem::is_directory(start, error)) start = std::filesystem::current_path(error);
    list(start);
}

void FileBrowser::list(std::filesystem::path folder) {
    std::error_code error;
    folder = std::filesystem::weakly_canonical(folder, error);
    std::filesystem::directory_iterator files(folder, std::filesystem::directory_options::skip_permission_denied,
                                              error);
    if (error) {
        complaint_ = folder.string() + ": " + error.message();
        return;
    }
    complaint_.clear();
    overwrite_ = false;
    folder_ = folder;
    address_ = folder.string();
    entries_.clear();
    for (const auto& file : files) {
        Entry entry{file.path(), file.path().filename().string(), file.is_directory(error), {}};
        if (entry.name.starts_with('.')) continue;
        if (!entry.folder &&
            std::ranges::find(extensions_, lower(entry.path.extension().string())) == extensions_.end())
            continue;
        if (!entry.folder) entry.size = size_text(file.file_size(error));
        entries_.push_back(std::move(entry));
    }
    std::ranges::sort(entries_, {}, [](const Entry& entry) { return std::pair(!entry.folder, lower(entry.name)); });
}

std::optional<std::filesystem::path> FileBrowser::draw(UiState& state) {
    if (!open_) return {};
    const float scale = state.scale;
    const std::string id = title_ + "##file_browser";
    if (appearing_) ImGui::OpenPopup(id.c_str());
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({640 * scale, 460 * scale}, ImGuiCond_Appearing);
    std::optional<std::filesystem::path> chosen;
    bool stay = true;
    if (!ImGui::BeginPopupModal(id.c_str(), &stay, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings)) {
        open_ = false;
        return {};
    }
    std::optional<std::filesystem::path> go_to;
    const auto offer = [&](const std::filesystem::path& path) {
        std::error_code error;
        if (std::filesystem::is_directory(path, error))
            go_to = path;
        else if (saving_ && std::filesystem::exists(path, error) && !overwrite_)
            overwrite_ = true; // asked again before it is done
        else
            chosen = path;
    };

    if (ImGui::Button("Up")) go_to = folder_.parent_path();
    ImGui::SameLine();
    if (ImGui::Button("Home"))
        if (const char* home = std::getenv("HOME")) go_to = home;
    ImGui::SameLine();
    if (ImGui::Button("Examples")) go_to = asset_path("");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputText("##address", &address_, ImGuiInputTextFlags_EnterReturnsTrue)) offer(address_);
    state.layout_log.widget("browser:address");

    const float footer = ImGui::GetFrameHeightWithSpacing() +
                         (complaint_.empty() && !overwrite_ ? 0 : ImGui::GetTextLineHeightWithSpacing());
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImVec4(0.125f, 0.125f, 0.125f, 1));
    ImGui::BeginChild("##files", {0, -footer - 4 * scale}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    for (const auto& entry : entries_) {
        ImGui::PushID(entry.name.c_str());
        if (ImGui::Selectable("##entry", !entry.folder && entry.name == name_, ImGuiSelectableFlags_AllowDoubleClick)) {
            if (entry.folder)
                go_to = entry.path;
            else {
                name_ = entry.name;
                overwrite_ = false;
                if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) offer(entry.path);
            }
        }
        state.layout_log.widget("browser:" + entry.name);
        const auto low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
        auto* draw = ImGui::GetWindowDrawList();
        const float x = low.x + 6 * scale, y = low.y + 2 * scale, line = ImGui::GetTextLineHeight();
        if (entry.folder) { // a folder: a tab and a body
            draw->AddRectFilled({x, y + 2 * scale}, {x + 7 * scale, y + 6 * scale}, packed(colours::accent, 0.85f),
                                1 * scale);
            draw->AddRectFilled({x, y + 4 * scale}, {x + 15 * scale, y + line - 2 * scale},
                                packed(colours::accent, 0.85f), 2 * scale);
        } else
            draw->AddRectFilled({x + 2 * scale, y + 1 * scale}, {x + 13 * scale, y + line - 1 * scale},
                                packed(colours::dim, 0.7f), 2 * scale);
        draw->AddText({x + 23 * scale, low.y + 2 * scale}, packed(colours::text), entry.name.c_str());
        const float size_x = high.x - ImGui::CalcTextSize(entry.size.c_str()).x - 8 * scale;
        draw->AddText({size_x, low.y + 2 * scale}, packed(colours::dim), entry.size.c_str());
        ImGui::PopID();
    }
    if (entries_.empty()) ImGui::TextDisabled("Nothing to choose here.");
    ImGui::EndChild();
    ImGui::PopStyleColor();

    if (!complaint_.empty()) ImGui::TextColored(colours::error, "%s", complaint_.c_str());
    if (overwrite_)
        ImGui::TextColored(colours::warning, "%s is there already. Press Overwrite to replace it.", name_.c_str());
    const float button = 96 * scale, gap = ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetNextItemWidth(-2 * (button + gap));
    const bool entered = ImGui::InputTextWithHint("##name", saving_ ? "Name of the scene" : "File name", &name_,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    if (ImGui::IsItemEdited()) overwrite_ = false;
    state.layout_log.widget("browser:name");
    ImGui::SameLine();
    ImGui::BeginDisabled(name_.empty());
    const char* action = overwrite_ ? "Overwrite" : saving_ ? "Save" : "Open";
    if ((ImGui::Button(action, {button, 0}) || entered) && !name_.empty()) {
        std::filesystem::path path = folder_ / name_;
        if (saving_ && path.extension().empty() && !extensions_.empty()) path += extensions_.front();
        offer(path);
    }
    ImGui::EndDisabled();
    state.layout_log.widget("browser:action");
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {button, 0}) ||
        (!appearing_ && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))))
        stay = false;
    appearing_ = false;
    if (go_to) list(*go_to);
    if (chosen || !stay) {
        open_ = false;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
    return chosen;
}

} // namespace lueur
