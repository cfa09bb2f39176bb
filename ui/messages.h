// What the program tells its user: short-lived notes over the viewport, and a list of all of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lueur {

enum class Severity { note, warning, error };

struct Message {
    Severity severity = Severity::note;
    std::string text;
    double time = 0; // s since the start of the program
};

struct Messages {
    std::vector<Message> all;
    void add(Severity severity, std::string text, double now);
};

double display_seconds(Severity severity); // how long a note stays over the viewport

// Draws the notes that are still young at the bottom right of the area given. Returns in how many seconds it will look
// different.
std::optional<double> draw_notes(const Messages& messages, double now, float right, float bottom, float scale);
void draw_log(const Messages& messages, bool& open, float scale);

} // namespace lueur
