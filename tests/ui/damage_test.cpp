// A frame drawn only where it has changed is, pixel for pixel, the frame drawn whole.
#include "ui/damage.h"

#include <array>
#include <cstdint>
#include <memory>

#include <gtest/gtest.h>

#include "tests/e2e/virtual_screen.h"
#include "ui/gl.h"
#include "ui/window.h"

namespace lueur {
namespace {

struct Target {
    GlFramebuffer framebuffer = new_framebuffer();
    GlTexture texture = new_texture();
    int width = 0, height = 0;
};

Target make_target(int width, int height) {
    Target target;
    target.width = width, target.height = height;
    glBindTexture(GL_TEXTURE_2D, target.texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.texture, 0);
    return target;
}

std::vector<std::uint32_t> pixels_of(const Target& target) {
    std::vector<std::uint32_t> pixels(static_cast<std::size_t>(target.width * target.height));
    glBindTexture(GL_TEXTURE_2D, target.texture);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    return pixels;
}

// What the frames of this test show.
struct ShownPanels {
    PixelBox picture{20, 30, 400, 300};
    int counter = 0;
    bool second_panel = true, dialog = false, note = false, callback = false;
    ImVec2 dialog_at{350.5f, 100.25f};
};

void panel(const char* name, ImVec2 at, ImVec2 size) {
    ImGui::SetNextWindowPos(at);
    ImGui::SetNextWindowSize(size);
    ImGui::Begin(name, nullptr, ImGuiWindowFlags_NoSavedSettings);
}

void ignore(const ImDrawList*, const ImDrawCmd*) {}

ImDrawData& frame_of(Window& window, const ShownPanels& shown) {
    window.begin_frame();
    panel("left", {410, 10}, {220.6f, 200.4f});
    ImGui::Text("counter %d", shown.counter);
    ImGui::Button("a button");
    ImGui::BeginChild("rows", {100.5f, 60.5f}, true);
    for (int i = 0; i < 20; ++i) ImGui::Text("row %d", i);
    ImGui::EndChild();
    ImGui::End();
    if (shown.second_panel) {
        panel("below", {10, 320}, {380, 120.5f});
        ImGui::TextUnformatted("stays as it is");
        ImGui::End();
    }
    if (shown.dialog) { // half over the picture, half over a panel
        panel("dialog", shown.dialog_at, {150, 90});
        ImGui::TextUnformatted("a dialog");
        ImGui::End();
    }
    if (shown.note) ImGui::GetForegroundDrawList()->AddRectFilled({100.5f, 100.5f}, {180.5f, 140.5f}, 0x80ff8040u, 6);
    if (shown.callback) ImGui::GetForegroundDrawList()->AddCallback(ignore, nullptr);
    ImGui::Render();
    return *ImGui::GetDrawData();
}

class DamageTest : public testing::Test {
protected:
    static void SetUpTestSuite() {
        screen_ = std::make_unique<test::VirtualScreen>(640, 480);
        WindowParams params;
        params.width = 640, params.height = 480;
        params.visible = false;
        auto window = Window::open(params);
        if (!window) GTEST_FAIL() << window.error();
        window_ = std::move(*window);
    }
    static void TearDownTestSuite() {
        window_.reset();
        screen_.reset();
    }
    static std::unique_ptr<test::VirtualScreen> screen_;
    static std::unique_ptr<Window> window_;
};
std::unique_ptr<test::VirtualScreen> DamageTest::screen_;
std::unique_ptr<Window> DamageTest::window_;

TEST_F(DamageTest, NothingButThePictureIsDrawnAgainWhileNothingElseChanges) {
    FrameDamage damage;
    ShownPanels shown;
    for (int i = 0; i < 3; ++i) damage.next(frame_of(*window_, shown), shown.picture); // windows settle their sizes
    EXPECT_EQ(damage.next(frame_of(*window_, shown), shown.picture), std::vector{shown.picture});
    EXPECT_TRUE(damage.next(frame_of(*window_, shown), {}) == std::vector{shown.picture}) << "where it was";
    EXPECT_TRUE(damage.next(frame_of(*window_, shown), {}).empty());

    ++shown.counter;
    const auto boxes = damage.next(frame_of(*window_, shown), {});
    ASSERT_EQ(boxes.size(), 1u);
    EXPECT_FALSE(intersection(boxes[0], {410, 10, 631, 211}).empty());
    EXPECT_EQ(smallest_around(boxes[0], {409, 9, 632, 212}), (PixelBox{409, 9, 632, 212})) << "inside of its panel";

    damage.forget();
    EXPECT_EQ(damage.next(frame_of(*window_, shown), {}), std::vector{whole_frame(*ImGui::GetDrawData())});
}

TEST_F(DamageTest, DrawsWhatAWholeFrameWouldShow) {
    const auto all = whole_frame(frame_of(*window_, {}));
    const auto whole = make_target(all.right, all.bottom), kept = make_target(all.right, all.bottom);
    const auto source = make_target(61, 37);
    std::vector<std::uint32_t> colours(61 * 37);
    std::uint32_t noise = 1;
    FrameDamage damage;
    std::size_t drawn = 0, frames = 0;
    const auto compare = [&](const ShownPanels& shown, const char* what) {
        for (auto& colour : colours) colour = 0xff000000u | ((noise = noise * 1664525u + 1013904223u) >> 8);
        glBindTexture(GL_TEXTURE_2D, source.texture); // another picture each time
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 61, 37, GL_RGBA, GL_UNSIGNED_BYTE, colours.data());
        auto& data = frame_of(*window_, shown);
        const auto draw = [&](const Target& target, const PixelBox& box) {
            glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
            draw_box(data, box, [&] {
                glBindFramebuffer(GL_READ_FRAMEBUFFER, source.framebuffer);
                glBlitFramebuffer(0, 0, 61, 37, shown.picture.left, all.bottom - shown.picture.bottom,
                                  shown.picture.right, all.bottom - shown.picture.top, GL_COLOR_BUFFER_BIT, GL_LINEAR);
            });
        };
        draw(whole, all);
        const auto boxes = damage.next(data, shown.picture);
        for (const auto& box : boxes) {
            draw(kept, box);
            drawn += static_cast<std::size_t>((box.right - box.left) * (box.bottom - box.top));
        }
        ++frames;
        const auto expected = pixels_of(whole), got = pixels_of(kept);
        for (std::size_t i = 0; i < expected.size(); ++i)
            ASSERT_EQ(got[i], expected[i]) << what << ", pixel " << i % static_cast<std::size_t>(all.right) << ", row "
                                           << i / static_cast<std::size_t>(all.right) << " from below";
    };
    ShownPanels shown;
    for (int i = 0; i < 4; ++i) compare(shown, "nothing changes");
    for (shown.counter = 9; shown.counter < 12; ++shown.counter) compare(shown, "a text changes");
    shown.dialog = true;
    for (int i = 0; i < 3; ++i) compare(shown, "a dialog opens");
    for (const float x : {200.5f, 330.0f, 500.75f, 20.0f}) {
        shown.dialog_at.x = x;
        compare(shown, "a dialog moves");
    }
    shown.note = true;
    compare(shown, "a note over the picture");
    shown.picture.right = 300;
    compare(shown, "a smaller picture");
    shown.note = shown.dialog = false;
    for (int i = 0; i < 2; ++i) compare(shown, "all closes");
    shown.second_panel = false;
    compare(shown, "a panel goes");
    shown.callback = true;
    compare(shown, "a callback");
    shown.callback = false;
    shown.picture = {};
    compare(shown, "no picture");
    compare(shown, "no picture still");
    EXPECT_LT(drawn, frames * static_cast<std::size_t>(all.right * all.bottom) * 2 / 3) << "most is not drawn again";
}

} // namespace
} // namespace lueur
