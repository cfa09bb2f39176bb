#include "ui/window.h"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace lueur {
namespace {

std::string last_glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

double environment_scale() {
    if (const char* text = std::getenv("LUEUR_SCALE"))
        if (const double scale = std::strtod(text, nullptr); scale >= 0.5 && scale <= 4) return scale;
    return 1;
}

} // namespace

Window& Window::of(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

std::expected<std::unique_ptr<Window>, std::string> Window::open(const WindowParams& params) {
    if (!glfwInit()) return std::unexpected("no display to open a window on (" + last_glfw_error() + ")");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, params.visible ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_MAXIMIZED, params.maximized ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    auto* handle = glfwCreateWindow(params.width, params.height, "Lueur", nullptr, nullptr);
    if (!handle) {
        auto reason = "OpenGL 3.3 is not to be had (" + last_glfw_error() + ")";
        glfwTerminate();
        return std::unexpected(std::move(reason));
    }
    std::unique_ptr<Window> window(new Window);
    window->window_ = handle;
    window->user_scale_ = params.scale;
    glfwMakeContextCurrent(handle);
    glfwSwapInterval(1);
    glfwSetWindowSizeLimits(handle, 640, 480, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwSetWindowUserPointer(handle, window.get());

    glfwSetKeyCallback(handle, [](GLFWwindow* w, int key, int, int action, int modifiers) {
        auto& events = of(w).events_;
        events.any = true;
        if (action != GLFW_RELEASE) events.keys.push_back({key, modifiers});
    });
    glfwSetDropCallback(handle, [](GLFWwindow* w, int count, const char** paths) {
        auto& events = of(w).events_;
        events.any = true;
        for (int i = 0; i < count; ++i) events.dropped.emplace_back(paths[i]);
    });
    glfwSetWindowCloseCallback(handle, [](GLFWwindow* w) {
        of(w).events_.any = of(w).events_.close = true;
        glfwSetWindowShouldClose(w, GLFW_FALSE); // the program asks about unsaved changes first
    });
    glfwSetWindowContentScaleCallback(handle, [](GLFWwindow* w, float, float) {
        of(w).events_.any = of(w).events_.scale_changed = true;
        of(w).fonts_stale_ = true;
    });
    glfwSetCursorPosCallback(handle, [](GLFWwindow* w, double x, double y) {
        of(w).events_.any = true;
        of(w).mouse_events_.push_back({-1, false, x, y});
    });
    glfwSetCursorEnterCallback(handle, [](GLFWwindow* w, int) { of(w).events_.any = true; });
    glfwSetMouseButtonCallback(handle, [](GLFWwindow* w, int button, int action, int) {
        of(w).events_.any = true;
        MouseEvent event{button, action == GLFW_PRESS, 0, 0};
        glfwGetCursorPos(w, &event.x, &event.y);
        of(w).mouse_events_.push_back(event);
    });
    glfwSetScrollCallback(handle, [](GLFWwindow* w, double, double) { of(w).events_.any = true; });
    glfwSetCharCallback(handle, [](GLFWwindow* w, unsigned) { of(w).events_.any = true; });
    glfwSetWindowFocusCallback(handle, [](GLFWwindow* w, int) { of(w).events_.any = true; });
    // What was drawn, or what was shown of it, may be lost.
    glfwSetWindowRefreshCallback(handle, [](GLFWwindow* w) {
        of(w).events_.any = true;
        of(w).damage_.forget();
    });
    glfwSetFramebufferSizeCallback(handle, [](GLFWwindow* w, int, int) {
        of(w).events_.any = true;
        of(w).damage_.forget();
    });
    glfwSetWindowIconifyCallback(handle, [](GLFWwindow* w, int) {
        of(w).events_.any = true;
        of(w).damage_.forget();
    });

    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    auto& io = ImGui::GetIO();
    io.IniFilename = nullptr; // what is remembered is in the preferences
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    ImGui_ImplGlfw_InitForOpenGL(handle, true); // keeps the callbacks above and adds its own
    ImGui_ImplOpenGL3_Init("#version 330 core");
    window->make_fonts();
    auto stretch = Stretch::make();
    if (!stretch) return std::unexpected("a shader does not compile: " + stretch.error());
    window->stretch_ = std::move(*stretch);
    window->find_copy_sub_buffer();
    window->events_.any = true;
    return window;
}

Window::~Window() {
    stretch_ = {}; // while there is a context
    if (ImGui::GetCurrentContext()) {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    if (window_) glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::make_fonts() {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    int logical = 0, physical = 0;
    glfwGetWindowSize(window_, &logical, nullptr);
    glfwGetFramebufferSize(window_, &physical, nullptr);
    // Where screen coordinates are already scaled (Wayland, macOS) ImGui scales by itself.
    const float given = logical > 0 && physical > 0 ? static_cast<float>(physical) / static_cast<float>(logical) : 1.0f;
    scale_ = std::clamp(
        static_cast<float>(user_scale_ * environment_scale()) * std::max(x, 0.5f) / std::max(given, 0.5f), 0.5f, 6.0f);
    apply_theme(scale_);
    fonts_ = load_fonts(scale_, font_complaint_);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    damage_.forget();
    fonts_stale_ = false;
}

void Window::wait(double seconds) {
    if (seconds < 0)
        glfwWaitEvents();
    else if (seconds == 0)
        glfwPollEvents();
    else
        glfwWaitEventsTimeout(seconds);
}

void Window::wake() {
    glfwPostEmptyEvent();
}

WindowEvents Window::take_events() {
    return std::exchange(events_, {});
}

void Window::set_scale(double scale) {
    user_scale_ = scale;
    fonts_stale_ = true;
}

void Window::set_title(const std::string& title) {
    if (title == title_) return;
    title_ = title;
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::begin_frame() {
    if (fonts_stale_) make_fonts();
    // Tab hides the panels; it goes from field to field only while text is typed.
    ImGui::GetIO().KeyMap[ImGuiKey_Tab] = ImGui::GetIO().WantTextInput ? GLFW_KEY_TAB : -1;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    replay_mouse();
    ImGui::NewFrame();
}

// ImGui 1.86 sees the mouse as it is at the start of a frame. Where frames are slow, a drag and its end fall into one
// frame and the last part of the drag would be lost: so a frame gets either movements or one button, in the order in
// which they came.
void Window::replay_mouse() {
    bool moved = false;
    while (!mouse_events_.empty()) {
        const auto event = mouse_events_.front();
        if (event.button >= 0 && moved) break;
        mouse_events_.pop_front();
        mouse_ = event;
        if (event.button < 0) {
            moved = true;
            continue;
        }
        if (event.button < static_cast<int>(mouse_down_.size()))
            mouse_down_[static_cast<std::size_t>(event.button)] = event.down;
        break;
    }
    auto& io = ImGui::GetIO();
    if (io.MousePos.x > -1e30f)
        io.MousePos = {static_cast<float>(mouse_.x), static_cast<float>(mouse_.y)}; // else outside
    for (std::size_t i = 0; i < mouse_down_.size(); ++i) io.MouseDown[i] = mouse_down_[i];
}

// A software renderer shows a frame by copying its back buffer, which stays as it is: so it need be drawn, and copied,
// only where it has changed. (After a swap it is undefined, and a graphics processor draws a frame in no time.)
void Window::find_copy_sub_buffer() {
    const std::string renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    if (!renderer.starts_with("llvmpipe") && !renderer.starts_with("softpipe")) return;
    if (!glfwExtensionSupported("GLX_MESA_copy_sub_buffer")) return;
    const auto display = reinterpret_cast<void* (*)()>(glfwGetProcAddress("glXGetCurrentDisplay"));
    const auto drawable = reinterpret_cast<unsigned long (*)()>(glfwGetProcAddress("glXGetCurrentDrawable"));
    if (!display || !drawable) return;
    display_ = display();
    drawable_ = drawable();
    copy_sub_buffer_ = reinterpret_cast<decltype(copy_sub_buffer_)>(glfwGetProcAddress("glXCopySubBufferMESA"));
}

// Not drawn by ImGui: a software renderer blends a million pixels for nothing.
void Window::draw_underlay(const Underlay& under, const PixelBox& place, int height) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, under.framebuffer);
    if (under.from_width == under.width && under.from_height == under.height) {
        glBlitFramebuffer(0, 0, under.width, under.height, place.left, height - place.bottom, place.right,
                          height - place.top, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    } else {
        GLint texture = 0;
        glGetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                              GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &texture);
        stretch_.draw(static_cast<GLuint>(texture), place, height);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Window::end_frame(const Underlay& under) {
    ImGui::Render();
    auto& data = *ImGui::GetDrawData();
    const auto all = whole_frame(data);
    if (all.empty()) return; // iconified
    const PixelBox picture =
        under.framebuffer ? PixelBox{under.x, under.y, under.x + under.width, under.y + under.height} : PixelBox{};
    const auto boxes = copy_sub_buffer_ ? damage_.next(data, picture) : std::vector{all};
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    for (const auto& box : boxes)
        draw_box(data, box, [&] {
            if (!intersection(box, picture).empty()) draw_underlay(under, picture, all.bottom);
        });
    glDisable(GL_SCISSOR_TEST);
    if (!copy_sub_buffer_)
        glfwSwapBuffers(window_);
    else
        for (const auto& box : boxes)
            copy_sub_buffer_(display_, drawable_, box.left, all.bottom - box.bottom, box.right - box.left,
                             box.bottom - box.top);
}

int Window::width() const {
    int w = 0;
    glfwGetWindowSize(window_, &w, nullptr);
    return w;
}
int Window::height() const {
    int h = 0;
    glfwGetWindowSize(window_, nullptr, &h);
    return h;
}
void Window::pointer(double& x, double& y) const {
    glfwGetCursorPos(window_, &x, &y);
}
bool Window::maximized() const {
    return glfwGetWindowAttrib(window_, GLFW_MAXIMIZED);
}
double Window::now() const {
    return glfwGetTime();
}

} // namespace lueur
