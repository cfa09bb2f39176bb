#include "ui/layout_log.h"

#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <imgui.h>
#include <nlohmann/json.hpp>

namespace lueur {

LayoutLog::LayoutLog() {
    if (const char* file = std::getenv("LUEUR_UI_LAYOUT")) file_ = file;
}

void LayoutLog::widget(const std::string& name) {
    if (!enabled()) return;
    const auto low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    area(name, low.x, low.y, high.x, high.y);
}

void LayoutLog::area(const std::string& name, float x0, float y0, float x1, float y1) {
    if (!enabled()) return;
    widgets_[name] = fmt::format("[{:.0f},{:.0f},{:.0f},{:.0f}]", x0, y0, x1, y1);
}

void LayoutLog::fact(const std::string& name, std::string json_value) {
    if (enabled()) facts_[name] = std::move(json_value);
}

void LayoutLog::end_frame() {
    if (!enabled()) return;
    std::string text = "{\n";
    for (const auto& [name, value] : facts_) text += fmt::format("{}: {},\n", nlohmann::json(name).dump(), value);
    text += "\"widgets\": {";
    const char* separator = "\n";
    for (const auto& [name, box] : widgets_) {
        text += fmt::format("{}{}: {}", separator, nlohmann::json(name).dump(), box);
        separator = ",\n";
    }
    text += "\n}}\n";
    widgets_.clear();
    if (text == written_) return;
    auto beside = file_;
    beside += ".part";
    std::ofstream(beside) << text;
    std::error_code error;
    std::filesystem::rename(beside, file_, error);
    if (!error) written_ = std::move(text);
}

} // namespace lueur
