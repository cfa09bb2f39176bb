// Where the named widgets are and what state the program is in, for tests that press real buttons: with the environment
// variable LUEUR_UI_LAYOUT=FILE set, FILE is rewritten (beside and renamed) whenever something in it changes.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace lueur {

class LayoutLog {
public:
    LayoutLog(); // reads the environment
    bool enabled() const { return !file_.empty(); }

    void widget(const std::string& name);                                       // the last ImGui item
    void area(const std::string& name, float x0, float y0, float x1, float y1); // pixels of the window
    void fact(const std::string& name, std::string json_value);
    void end_frame();

private:
    std::filesystem::path file_;
    std::map<std::string, std::string> widgets_, facts_;
    std::string written_;
};

} // namespace lueur
