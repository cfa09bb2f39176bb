// What the window remembers from one run to the next: $XDG_CONFIG_HOME/lueur/window.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ui/ui_state.h"

namespace lueur {

struct Preferences {
    int width = 1280, height = 800; // of the window, screen coordinates
    bool maximized = false;
    double scale = 1; // on top of the monitor's own
    Layout layout;
    std::vector<std::filesystem::path> recent; // newest first
};

std::filesystem::path preferences_file();
Preferences load_preferences(const std::filesystem::path& file); // defaults for all that is missing or unusable
bool save_preferences(const Preferences& preferences, const std::filesystem::path& file);
void remember_recent(Preferences& preferences, const std::filesystem::path& file);

} // namespace lueur
