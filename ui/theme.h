// How the window looks: neutral greys, so that colours in the picture are judged against nothing coloured, and one warm
// accent.
#pragma once

#include <string>

#include <imgui.h>

namespace lueur {

struct Fonts {
    ImFont* regular = nullptr;
    ImFont* heading = nullptr; // semi-bold, same size
    ImFont* small = nullptr;   // axis labels, notes
};

namespace colours {
inline const ImVec4 backdrop{0.105f, 0.105f, 0.105f, 1};
inline const ImVec4 panel{0.150f, 0.150f, 0.150f, 1};
inline const ImVec4 raised{0.185f, 0.185f, 0.185f, 1};
inline const ImVec4 frame{0.235f, 0.235f, 0.235f, 1};
inline const ImVec4 line{0.275f, 0.275f, 0.275f, 1};
inline const ImVec4 text{0.880f, 0.880f, 0.880f, 1};
inline const ImVec4 dim{0.590f, 0.590f, 0.590f, 1};
inline const ImVec4 accent{0.930f, 0.640f, 0.260f, 1};
inline const ImVec4 error_estimate{0.560f, 0.760f, 0.840f, 1};
inline const ImVec4 warning{0.960f, 0.780f, 0.360f, 1};
inline const ImVec4 error{0.940f, 0.440f, 0.380f, 1};
} // namespace colours

void apply_theme(float scale);

// Fills ImGui's font atlas. What could not be found is said in `complaint`, and ImGui's own font is used.
Fonts load_fonts(float scale, std::string& complaint);

} // namespace lueur
