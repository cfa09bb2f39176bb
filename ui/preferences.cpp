#include "ui/preferences.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <nlohmann/json.hpp>

namespace lueur {
namespace {

template <typename Number>
void read(const nlohmann::json& json, const char* key, Number& value, Number low, Number high) {
    if (json.contains(key) && json[key].is_number()) value = std::clamp(json[key].get<Number>(), low, high);
}

void read(const nlohmann::json& json, const char* key, bool& value) {
    if (json.contains(key) && json[key].is_boolean()) value = json[key].get<bool>();
}

} // namespace

std::filesystem::path preferences_file() {
    std::filesystem::path folder;
    if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config)
        folder = config;
    else if (const char* home = std::getenv("HOME"); home && *home)
        folder = std::filesystem::path(home) / ".config";
    else
        return {};
    return folder / "lueur" / "window.json";
}

Preferences load_preferences(const std::filesystem::path& file) {
    Preferences preferences;
    std::ifstream stream(file);
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    if (!json.is_object()) return preferences;
    read(json, "width", preferences.width, 640, 16384);
    read(json, "height", preferences.height, 480, 16384);
    read(json, "maximized", preferences.maximized);
    read(json, "scale", preferences.scale, 0.5, 4.0);
    auto& layout = preferences.layout;
    read(json, "column_width", layout.column_width, 260.0f, 900.0f);
    read(json, "strip_height", layout.strip_height, 90.0f, 700.0f);
    read(json, "lower_height", layout.lower_height, 120.0f, 1400.0f);
    read(json, "panels_visible", layout.panels_visible);
    read(json, "probe_at_cursor", layout.probe_at_cursor);
    if (json.contains("recent") && json["recent"].is_array())
        for (const auto& entry : json["recent"])
            if (entry.is_string() && preferences.recent.size() < 10)
                preferences.recent.emplace_back(entry.get<std::string>());
    return preferences;
}

bool save_preferences(const Preferences& preferences, const std::filesystem::path& file) {
    if (file.empty()) return false;
    nlohmann::json json{{"width", preferences.width},
                        {"height", preferences.height},
                        {"maximized", preferences.maximized},
                        {"scale", preferences.scale},
                        {"column_width", preferences.layout.column_width},
                        {"strip_height", preferences.layout.strip_height},
                        {"lower_height", preferences.layout.lower_height},
                        {"panels_visible", preferences.layout.panels_visible},
                        {"probe_at_cursor", preferences.layout.probe_at_cursor},
                        {"recent", nlohmann::json::array()}};
    for (const auto& recent : preferences.recent) json["recent"].push_back(recent.string());
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    auto beside = file;
    beside += ".part";
    {
        std::ofstream stream(beside);
        stream << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
        if (!stream) return false;
    }
    std::filesystem::rename(beside, file, error);
    return !error;
}

void remember_recent(Preferences& preferences, const std::filesystem::path& file) {
    std::error_code error;
    const auto absolute = std::filesystem::absolute(file, error).lexically_normal();
    std::erase(preferences.recent, absolute);
    preferences.recent.insert(preferences.recent.begin(), absolute);
    if (preferences.recent.size() > 10) preferences.recent.resize(10);
}

} // namespace lueur
