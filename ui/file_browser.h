// A small file browser: folders and files of some kinds, by name. Opens as a modal box over the window.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ui/ui_state.h"

namespace lueur {

class FileBrowser {
public:
    // `extensions` in lower case with the dot. Saving asks for a name and before it overwrites.
    void open(std::string title, std::vector<std::string> extensions, bool saving, std::filesystem::path start);
    bool is_open() const { return open_; }

    // Draws the box; a path once, when one has been chosen.
    std::optional<std::filesystem::path> draw(UiState& state);

private:
    struct Entry {
        std::filesystem::path path;
        std::string name;
        bool folder = false;
        std::string size;
    };
    void list(std::filesystem::path folder);

    bool open_ = false, appearing_ = false, saving_ = false, overwrite_ = false;
    std::string title_, name_, complaint_, address_;
    std::vector<std::string> extensions_;
    std::filesystem::path folder_;
    std::vector<Entry> entries_;
};

} // namespace lueur
