// When MAXDISPLAY may change by itself: at the first light, once when settled, and never after an edit while it is
// locked.
#include "ui/exposure.h"

#include <gtest/gtest.h>

#include "editor/document.h"
#include "editor/worker.h"
#include "tests/support/scenes.h"

namespace lueur {
namespace {

Scene lit_room() {
    test::SceneBuilder builder;
    const auto paint = builder.material("paint", 0.5);
    builder.room("room", {paint, paint, paint, paint, paint, paint}, {0, 0, 0}, {4, 3, 4});
    const auto lamp = builder.polygon("lamp", paint,
                                      {{1.5f, 2.9f, 1.5f}, {2.5f, 2.9f, 1.5f}, {2.5f, 2.9f, 2.5f}, {1.5f, 2.9f, 2.5f}});
    builder.light("lamp", {lamp}, PowerUnit::lumen, 2000);
    auto& scene = builder.settings();
    scene.camera.position = {2, 1.5, 3.8};
    scene.camera.target = {2, 1.2, 0};
    scene.solve.target_error = 0.2;
    scene.solve.wavelengths = {WavelengthRule::rgb, 3};
    return builder.build();
}

struct Editor {
    Document document{lit_room()};
    Worker worker;
    Exposure exposure;

    std::shared_ptr<const Snapshot> settled(Stage stage) {
        worker.submit(document.shared_scene(), document.revision(), stage);
        EXPECT_TRUE(worker.wait_settled(document.revision(), 60));
        return worker.latest();
    }
    bool update(const Snapshot& snapshot) {
        return update_exposure(exposure, document.scene().display, snapshot, document.scene().camera, 1.5);
    }
    std::shared_ptr<const Snapshot> edited(const Edit& edit) { return settled(*document.apply(edit)); }
};

TEST(Exposure, IsChosenOnceAndALockedPictureIsNeverRescaled) {
    Editor editor;
    EXPECT_FALSE(editor.update(Snapshot{})) << "no light, nothing to choose from";
    const auto first = editor.settled(Stage::mesh);
    ASSERT_TRUE(editor.update(*first));
    const double chosen = *editor.exposure.chosen;
    EXPECT_EQ(display_in_use(editor.document.scene().display, editor.exposure).max_display, chosen);
    EXPECT_FALSE(editor.update(*first)) << "once";
    const auto dimmed = editor.edited(SetDimmer{LuminaireIndex{0}, 0.25});
    EXPECT_FALSE(editor.update(*dimmed));
    EXPECT_EQ(*editor.exposure.chosen, chosen);

    editor.exposure.asked = true; // "auto now"
    ASSERT_TRUE(editor.update(*dimmed));
    EXPECT_NEAR(*editor.exposure.chosen, 0.25 * chosen, 0.02 * chosen) << "light is linear in the dimmer";
}

TEST(Exposure, UnlockedItFollows) {
    Editor editor;
    auto display = editor.document.scene().display;
    display.max_display_locked = false;
    ASSERT_TRUE(editor.document.apply(SetDisplay{display}));
    ASSERT_TRUE(editor.update(*editor.settled(Stage::mesh)));
    const double chosen = *editor.exposure.chosen;
    EXPECT_TRUE(editor.update(*editor.edited(SetDimmer{LuminaireIndex{0}, 0.5})));
    EXPECT_NEAR(*editor.exposure.chosen, 0.5 * chosen, 0.02 * chosen);
}

TEST(Exposure, AValueOfTheSceneIsLeftAlone) {
    Editor editor;
    auto display = editor.document.scene().display;
    display.max_display_auto = false;
    display.max_display = 123;
    ASSERT_TRUE(editor.document.apply(SetDisplay{display}));
    EXPECT_FALSE(editor.update(*editor.settled(Stage::mesh)));
    EXPECT_EQ(display_in_use(editor.document.scene().display, editor.exposure).max_display, 123);
}

} // namespace
} // namespace lueur
