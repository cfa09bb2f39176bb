// What of the window has to be drawn anew: on a software renderer panels that have not changed would otherwise cost as
// much as the scene. For a window whose back buffer keeps what was drawn before.
#pragma once

#include <functional>
#include <vector>

#include <imgui.h>

namespace lueur {

struct PixelBox { // from the top left, the end left out; empty where the end is not after the start
    int left = 0, top = 0, right = 0, bottom = 0;
    bool empty() const { return left >= right || top >= bottom; }
    bool operator==(const PixelBox&) const = default;
};
PixelBox intersection(const PixelBox& a, const PixelBox& b);
PixelBox smallest_around(const PixelBox& a, const PixelBox& b); // an empty box has no place

// Compares the draw lists of each frame with those of the frame before. Knows no OpenGL.
class FrameDamage {
public:
    // The boxes that differ from the last frame, and the picture, which always does. Everything after forget() and
    // where ImGui's units are not pixels.
    std::vector<PixelBox> next(const ImDrawData& data, const PixelBox& picture);
    void forget() { known_ = false; } // the back buffer is lost, or a texture has changed

private:
    struct List {
        std::vector<ImDrawVert> vertices;
        std::vector<ImDrawIdx> indices;
        std::vector<ImDrawCmd> commands;
        PixelBox box; // it draws into
    };
    std::vector<List> lists_;
    PixelBox all_, picture_;
    bool known_ = false;
};

PixelBox whole_frame(const ImDrawData& data);

// Draws one box of a frame into the present framebuffer: the ground, the picture (draw_picture puts it into its place
// and changes no scissor) and the lists over them. Every pixel is what it would be if the whole frame were drawn.
// Thread: the one that owns the current OpenGL context.
void draw_box(ImDrawData& data, const PixelBox& box, const std::function<void()>& draw_picture);

} // namespace lueur
