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

TEST(Exposure, AnotherRuleChoosesAnew) {
    Editor editor;
    const auto first = editor.settled(Stage::mesh);
    ASSERT_TRUE(editor.update(*first));
    const double by_percentile = *editor.exposure.chosen;
    auto display = editor.document.scene().display;
    display.max_display_rule = MaxDisplayRule::lecture;
    ASSERT_TRUE(editor.document.apply(SetDisplay{display}));
    ASSERT_TRUE(editor.update(*first));
    // 2000 lm on 16 m^2 of floor, everything of reflectance 0.5: 2 * 1.2049760 * 0.5 * 2000 / (pi 16) cd m^-2.
    EXPECT_NEAR(*editor.exposure.chosen, 2 * 1.2049760 * 0.5 * 2000 / (3.14159265 * 16), 0.01);
    EXPECT_FALSE(editor.update(*first)) << "once";
    display.max_display_rule = MaxDisplayRule::percentile;
    display.percentile = 50;
    ASSERT_TRUE(editor.document.apply(SetDisplay{display}));
    ASSERT_TRUE(editor.update(*first));
    EXPECT_LT(*editor.exposure.chosen, by_percentile);
}

TEST(Exposure, AdaptationFollowsThePictureWhereMaxDisplayDoesNot) {
    Editor editor;
    auto display = editor.document.scene().display;
    display.max_display_rule = MaxDisplayRule::by_hand;
    display.max_display = 123;
    display.tone_operator = ToneOperator::tumblin_rushmeier;
    ASSERT_TRUE(editor.document.apply(SetDisplay{display}));
    ASSERT_TRUE(editor.update(*editor.settled(Stage::mesh)));
    const auto used = display_in_use(editor.document.scene().display, editor.exposure);
    EXPECT_EQ(used.max_display, 123);
    EXPECT_NE(used.adaptation_luminance, display.adaptation_luminance);
    EXPECT_GT(used.adaptation_luminance, 1);
    EXPECT_LT(used.adaptation_luminance, 1000);
}

// Everything of the display: no ray, no sweep. The window does not even ask (tests/e2e counts that): it draws from the
// document, frame by frame.
TEST(Exposure, EditsOfTheDisplayAskNothingOfTheSolver) {
    Editor editor;
    const auto before = editor.settled(Stage::mesh);
    DisplaySettings display = editor.document.scene().display;
    std::vector<DisplaySettings> edits;
    const auto with = [&](auto change) {
        change(display);
        edits.push_back(display);
    };
    with([](DisplaySettings& d) { d.gamma = {1.8, 2.0, 2.4}; });
    with([](DisplaySettings& d) { d.curve = TransferCurve::gamma; });
    with([](DisplaySettings& d) { d.max_display = 77, d.max_display_rule = MaxDisplayRule::by_hand; });
    for (const auto clip : all_clip_rules) with([&](DisplaySettings& d) { d.clip = clip; });
    for (const auto tone_operator : all_tone_operators)
        with([&](DisplaySettings& d) { d.tone_operator = tone_operator; });
    with([](DisplaySettings& d) { d.primaries = rec2020; });
    with([](DisplaySettings& d) { d.mark_clipped = true; });
    with([](DisplaySettings& d) { d.illuminance_scale.levels = {100, 200}; });
    for (const auto& edit : edits) {
        EXPECT_EQ(first_stale_stage(SetDisplay{edit}, editor.document.scene()), Stage::display);
        const auto stage = editor.document.apply(SetDisplay{edit});
        ASSERT_TRUE(stage) << stage.error();
        // Even handed over it is no work.
        editor.worker.submit(editor.document.shared_scene(), editor.document.revision(), *stage);
        ASSERT_TRUE(editor.worker.wait_settled(editor.document.revision(), 60));
    }
    const auto after = editor.worker.latest();
    EXPECT_EQ(after->field->irradiance_xyz, before->field->irradiance_xyz) << "the same light";
    EXPECT_EQ(after->mesh, before->mesh);
    EXPECT_EQ(after->world, before->world);
    EXPECT_EQ(after->status.rays, before->status.rays);
    EXPECT_EQ(after->status.sweeps, before->status.sweeps);
    EXPECT_EQ(after->status.shots, before->status.shots);
}

TEST(Exposure, AValueOfTheSceneIsLeftAlone) {
    Editor editor;
    auto display = editor.document.scene().display;
    display.max_display_rule = MaxDisplayRule::by_hand;
    display.max_display = 123;
    ASSERT_TRUE(editor.document.apply(SetDisplay{display}));
    EXPECT_FALSE(editor.update(*editor.settled(Stage::mesh)));
    EXPECT_EQ(display_in_use(editor.document.scene().display, editor.exposure).max_display, 123);
}

} // namespace
} // namespace lueur
