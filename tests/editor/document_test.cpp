// Undo, redo, drags, opening and saving.
#include "editor/document.h"

#include <fstream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/asset_path.h"
#include "tests/editor/small_scene.h"
#include "tests/support/temporary_folder.h"

namespace lueur {
namespace {

TEST(Document, StartsUnmodifiedWithNothingToUndo) {
    Document document(small_scene());
    EXPECT_FALSE(document.modified());
    EXPECT_FALSE(document.can_undo());
    EXPECT_FALSE(document.can_redo());
    EXPECT_EQ(document.undo(), Stage::nothing);
    EXPECT_EQ(document.redo(), Stage::nothing);
    EXPECT_EQ(document.undo_text(), "");
}

TEST(Document, UndoTakesBackAndRedoDoesAgain) {
    Document document(small_scene());
    const Scene first = document.scene();
    const auto revision = document.revision();
    EXPECT_EQ(document.apply(SetDimmer{LuminaireIndex(0), 0.5}), Stage::sources);
    const Scene second = document.scene();
    EXPECT_GT(document.revision(), revision);
    EXPECT_TRUE(document.modified());
    EXPECT_EQ(document.undo_text(), "Dim lamp");
    EXPECT_EQ(document.undo(), Stage::sources);
    EXPECT_EQ(document.scene(), first);
    EXPECT_FALSE(document.modified());
    EXPECT_EQ(document.redo_text(), "Dim lamp");
    EXPECT_EQ(document.redo(), Stage::sources);
    EXPECT_EQ(document.scene(), second);
    EXPECT_GE(document.revision(), revision + 3) << "undo and redo are changes too";
}

TEST(Document, KeepsTheSceneWhenAnEditIsRefused) {
    Document document(small_scene());
    const auto before = document.shared_scene();
    const auto revision = document.revision();
    const auto refused = document.apply(SetReflectance{MaterialIndex(0), 2.0});
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(document.shared_scene(), before);
    EXPECT_EQ(document.revision(), revision);
    EXPECT_FALSE(document.can_undo());
}

TEST(Document, AnEditThatChangesNothingIsNoStep) {
    Document document(small_scene());
    EXPECT_EQ(document.apply(SetDimmer{LuminaireIndex(0), 1.0}), Stage::nothing);
    EXPECT_FALSE(document.can_undo());
    EXPECT_EQ(document.revision(), 1u);
}

TEST(Document, ADragIsOneStepUntilItEnds) {
    Document document(small_scene());
    const Scene first = document.scene();
    for (const double dimmer : {0.9, 0.8, 0.7}) document.apply(SetDimmer{LuminaireIndex(0), dimmer});
    document.end_drag();
    for (const double dimmer : {0.6, 0.5}) document.apply(SetDimmer{LuminaireIndex(0), dimmer});
    document.undo();
    EXPECT_EQ(document.scene().luminaires[0].dimmer, 0.7);
    document.undo();
    EXPECT_EQ(document.scene(), first);
    EXPECT_FALSE(document.can_undo());
    document.redo();
    EXPECT_EQ(document.scene().luminaires[0].dimmer, 0.7);
}

TEST(Document, AnotherTargetEndsADrag) {
    Document document(small_scene());
    document.apply(SetDimmer{LuminaireIndex(0), 0.9});
    document.apply(SetReflectance{MaterialIndex(0), 0.1});
    document.apply(SetReflectance{MaterialIndex(0), 0.2});
    document.apply(SetDimmer{LuminaireIndex(0), 0.8});
    int steps = 0;
    for (; document.can_undo(); ++steps) document.undo();
    EXPECT_EQ(steps, 3);
}

// After undo a drag's next value starts a step of its own: else it would overwrite what undo brought back.
TEST(Document, UndoEndsADrag) {
    Document document(small_scene());
    document.apply(SetDimmer{LuminaireIndex(0), 0.9});
    document.end_drag();
    document.apply(SetDimmer{LuminaireIndex(0), 0.8});
    document.undo();
    document.apply(SetDimmer{LuminaireIndex(0), 0.7});
    document.undo();
    EXPECT_EQ(document.scene().luminaires[0].dimmer, 0.9);
}

// One combo box and one slider of the same settings in one drag: undo must redo the dearest of what they made stale.
TEST(Document, AMergedStepKeepsTheEarliestStage) {
    Document document(small_scene());
    SolveSettings solve = document.scene().solve;
    solve.element_size = 0.1;
    document.apply(SetSolve{solve});
    solve.target_error = 0.01;
    document.apply(SetSolve{solve});
    EXPECT_EQ(document.undo(), Stage::mesh);
    EXPECT_FALSE(document.can_undo());
}

TEST(Document, ANewEditForgetsWhatCouldBeRedone) {
    Document document(small_scene());
    document.apply(SetDimmer{LuminaireIndex(0), 0.9});
    document.undo();
    document.apply(SetReflectance{MaterialIndex(0), 0.1});
    EXPECT_FALSE(document.can_redo());
}

TEST(Document, TheCameraIsNoStepAndStaysThroughUndo) {
    Document document(small_scene());
    document.apply(SetDimmer{LuminaireIndex(0), 0.5});
    Camera camera = document.scene().camera;
    camera.position.x += 3;
    EXPECT_EQ(document.apply(SetCamera{camera}), Stage::view);
    document.undo();
    EXPECT_EQ(document.scene().luminaires[0].dimmer, 1);
    EXPECT_EQ(document.scene().camera, camera);
    EXPECT_TRUE(document.can_redo());
    EXPECT_FALSE(document.modified()) << "where one stands is not a change of the room";
    document.redo();
    EXPECT_EQ(document.scene().luminaires[0].dimmer, 0.5);
    EXPECT_EQ(document.scene().camera, camera);
}

TEST(Document, AnotherSceneBringsItsCameraAndUndoTheOldOne) {
    Document document(small_scene());
    const Scene first = document.scene();
    Scene other = small_scene();
    other.camera.position = {9, 9, 9};
    EXPECT_EQ(document.apply(ReplaceScene{other}), Stage::mesh);
    EXPECT_EQ(document.scene().camera, other.camera);
    EXPECT_EQ(document.undo(), Stage::mesh);
    EXPECT_EQ(document.scene(), first);
}

Edit random_edit(std::mt19937& random, const Scene& scene) {
    const auto number = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const auto one_of = [&](std::size_t count) {
        return std::uniform_int_distribution<std::uint32_t>(0, static_cast<std::uint32_t>(count) - 1)(random);
    };
    switch (one_of(11)) {
    case 0:
        return SetReflectance{MaterialIndex(one_of(scene.materials.size())), number(0, 1)};
    case 1:
        return SetReflectance{MaterialIndex(one_of(scene.materials.size())),
                              Rgb(number(0, 1), number(0, 1), number(0, 1))};
    case 2:
        return SetTwoSided{MaterialIndex(one_of(scene.materials.size())), one_of(2) == 0};
    case 3:
        return GiveOwnMaterial{ObjectIndex(one_of(scene.objects.size()))};
    case 4:
        return AssignMaterial{ObjectIndex(one_of(scene.objects.size())), MaterialIndex(one_of(scene.materials.size()))};
    case 5:
        return SetDimmer{LuminaireIndex(0), number(0, 2)};
    case 6:
        return SetPower{LuminaireIndex(0), one_of(2) ? PowerUnit::watt : PowerUnit::lumen, number(0, 5000)};
    case 7:
        return SetEmissionSpectrum{LuminaireIndex(0), Blackbody{number(2000, 9000)}};
    case 8:
        return SetEmitSide{LuminaireIndex(0), EmitSide(one_of(3))};
    case 9: {
        DisplaySettings display = scene.display;
        display.gamma = glm::dvec3(number(1, 3));
        return SetDisplay{display};
    }
    default: {
        SolveSettings solve = scene.solve;
        solve.seed = one_of(100);
        return SetSolve{solve};
    }
    }
}

// Whatever is done, undoing everything gives the first scene, redoing everything the last, and every stop on the way is
// met again.
TEST(Document, UndoOfAllIsTheFirstSceneAndRedoOfAllTheLast) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        std::mt19937 random(seed);
        Document document(small_scene());
        const Scene first = document.scene();
        for (int i = 0; i < 60; ++i) {
            const bool dragging = random() % 3 == 0;
            if (!dragging) document.end_drag();
            const Edit edit = random_edit(random, document.scene());
            const auto applied = document.apply(edit);
            ASSERT_TRUE(applied.has_value()) << applied.error();
        }
        const Scene last = document.scene();
        std::vector<Scene> back{last};
        while (document.can_undo()) {
            document.undo();
            back.push_back(document.scene());
        }
        EXPECT_EQ(document.scene(), first) << "seed " << seed;
        EXPECT_GT(back.size(), 20u);
        for (std::size_t i = back.size() - 1; i-- > 0;) {
            ASSERT_TRUE(document.can_redo());
            document.redo();
            ASSERT_EQ(document.scene(), back[i]) << "seed " << seed << ", step " << i;
        }
        EXPECT_FALSE(document.can_redo());
        EXPECT_EQ(document.scene(), last);
    }
}

TEST(Document, AFailedOpenKeepsTheScene) {
    const test::TemporaryFolder folder;
    std::ofstream(folder.path() / "broken.toml") << "units = \"furlong\"\nnonsense = 3\n";
    std::ofstream(folder.path() / "empty.toml");
    Document document(small_scene(), "small.toml");
    document.apply(SetDimmer{LuminaireIndex(0), 0.5});
    const auto before = document.shared_scene();
    for (const std::filesystem::path& file :
         {folder.path() / "broken.toml", folder.path() / "empty.toml", folder.path() / "absent.toml", folder.path()}) {
        std::vector<std::string> warnings;
        const auto opened = document.open(file, warnings);
        ASSERT_FALSE(opened.has_value()) << file;
        ASSERT_FALSE(opened.error().empty()) << file;
        EXPECT_THAT(opened.error().front(), testing::StartsWith(file.string())) << file;
        EXPECT_EQ(document.shared_scene(), before);
        EXPECT_EQ(document.file(), "small.toml");
        EXPECT_TRUE(document.can_undo());
    }
}

TEST(Document, OpensAndSavesAndOpensTheSame) {
    const test::TemporaryFolder folder;
    Document document;
    std::vector<std::string> warnings;
    const auto opened = document.open(asset_path("furnace.toml"), warnings);
    ASSERT_TRUE(opened.has_value()) << opened.error().front();
    EXPECT_FALSE(document.modified());
    EXPECT_FALSE(document.can_undo());
    ASSERT_TRUE(document.apply(SetReflectance{MaterialIndex(0), 0.25}).has_value());
    EXPECT_TRUE(document.modified());
    const auto file = folder.path() / "copy.toml";
    const auto saved = document.save(file);
    ASSERT_TRUE(saved.has_value()) << saved.error();
    EXPECT_FALSE(document.modified());
    EXPECT_EQ(document.file(), file);
    EXPECT_TRUE(document.can_undo()) << "saving is not the end of undo";

    Document again;
    const auto reopened = again.open(file, warnings);
    ASSERT_TRUE(reopened.has_value()) << reopened.error().front();
    EXPECT_EQ(again.scene().materials, document.scene().materials);
    EXPECT_EQ(again.scene().luminaires, document.scene().luminaires);
    EXPECT_EQ(*again.scene().geometry, *document.scene().geometry);
}

TEST(Document, SavesAsTomlOnly) {
    const test::TemporaryFolder folder;
    Document document(small_scene());
    document.apply(SetDimmer{LuminaireIndex(0), 0.5});
    EXPECT_FALSE(document.save(folder.path() / "room.obj").has_value());
    EXPECT_FALSE(document.save(folder.path() / "no folder" / "room.toml").has_value());
    EXPECT_TRUE(document.modified());
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

} // namespace
} // namespace lueur
