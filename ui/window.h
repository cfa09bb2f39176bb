// The window of the operating system with its OpenGL context and Dear ImGui inside: the only code that sees GLFW's
// callbacks.
#pragma once

#include <array>
#include <deque>
#include <expected>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ui/damage.h"
#include "ui/stretch.h"
#include "ui/theme.h"

struct GLFWwindow;

namespace lueur {

struct WindowParams {
    int width = 1280, height = 800; // screen coordinates
    bool maximized = false;
    bool visible = true;
    double scale = 1; // on top of the monitor's own
};

// What has come since the last look.
struct WindowEvents {
    bool any = false;
    bool close = false;
    struct Key {
        int key, modifiers;
    };
    std::vector<Key> keys; // pressed
    std::vector<std::filesystem::path> dropped;
    bool scale_changed = false;
};

class Window {
public:
    // The error is one line for a person.
    static std::expected<std::unique_ptr<Window>, std::string> open(const WindowParams& params);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    void wait(double seconds); // for events; 0: only takes what is there; < 0: as long as it takes
    static void wake();        // from any thread: ends a wait
    WindowEvents take_events();

    void set_scale(double scale); // the user's own, on top of the monitor's
    void set_title(const std::string& title);
    void begin_frame();
    bool has_more_input() const { return !mouse_events_.empty(); } // for the next frame
    // What lies under the panels: a framebuffer (of a texture) stretched over a part of the window, in pixels from the
    // top left.
    struct Underlay {
        unsigned framebuffer = 0;
        int from_width = 0, from_height = 0;
        int x = 0, y = 0, width = 0, height = 0;
    };
    void end_frame(const Underlay& underlay); // draws and shows

    float scale() const { return scale_; } // pixels for each unscaled pixel
    const Fonts& fonts() const { return fonts_; }
    const std::string& font_complaint() const { return font_complaint_; }
    int width() const; // screen coordinates
    int height() const;
    void pointer(double& x, double& y) const;
    bool maximized() const;
    double now() const; // s

private:
    Window() = default;
    void make_fonts();
    void replay_mouse();
    void find_copy_sub_buffer();
    void draw_underlay(const Underlay& under, const PixelBox& place, int height);
    static Window& of(GLFWwindow* window);

    GLFWwindow* window_ = nullptr;
    WindowEvents events_;
    struct MouseEvent {
        int button = -1; // -1: a movement
        bool down = false;
        double x = 0, y = 0;
    };
    std::deque<MouseEvent> mouse_events_;
    MouseEvent mouse_; // where it is now, as ImGui has been told
    std::array<bool, 3> mouse_down_{};
    double user_scale_ = 1;
    float scale_ = 1;
    bool fonts_stale_ = false;
    Fonts fonts_;
    FrameDamage damage_;
    Stretch stretch_;
    // GLX_MESA_copy_sub_buffer, from the back buffer's bottom left; null: a whole frame is swapped.
    void (*copy_sub_buffer_)(void* display, unsigned long drawable, int x, int y, int width, int height) = nullptr;
    void* display_ = nullptr;
    unsigned long drawable_ = 0;
    std::string font_complaint_, title_;
};

} // namespace lueur
