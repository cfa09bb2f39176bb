// A picture says all that is needed to make it again.
#include "editor/picture_metadata.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace lueur {
namespace {

using ::testing::HasSubstr;

Scene scene_of_odd_numbers() {
    Scene scene;
    scene.name = "Büro \"3\"";
    scene.solve.solver = SolverKind::gauss_seidel;
    scene.solve.form_factors = FormFactorMethod::point_to_disk;
    scene.solve.form_factor_samples = 12;
    scene.solve.oracle = RefinementOracle::flux;
    scene.solve.link_tolerance = 1.0 / 3;
    scene.solve.matrix_memory = 77;
    scene.solve.wavelengths = {WavelengthRule::uniform, 17};
    scene.solve.target_error = 1.0 / 30;
    scene.solve.element_size = 0.1 + 0.2;
    scene.solve.max_rays = 77;
    scene.solve.seed = 4294967295u;
    scene.display.max_display = 100.0 / 3;
    scene.display.tone_operator = ToneOperator::filmic;
    scene.display.gamma = {1.8, 2.2, 2.4};
    scene.display.curve = TransferCurve::gamma;
    scene.display.primaries = {{0.61, 0.35}, {0.29, 0.59}, {0.15, 0.063}, {0.28, 0.29}};
    scene.display.illuminance_scale = {false, 10, 3000, false, true, {100, 300}};
    scene.camera.position = {1e-7, -2.0 / 3, 12345.678};
    scene.camera.target = {0.1, 0.2, 0.3};
    scene.camera.vertical_fov_degrees = 39.3077;
    scene.camera.mirrored = true;
    return scene;
}

TEST(PictureMetadata, ThePictureCanBeMadeAgainFromItsFile) {
    const test::TemporaryFolder folder;
    const Scene scene = scene_of_odd_numbers();
    ImageMetadata metadata =
        picture_metadata(scene, folder.path() / "room.toml", scene.camera, SolveStatus{}, PictureQuantity::illuminance);
    add_display_metadata(metadata, scene.display, true);
    for (const char* name : {"a.png", "a.jpg", "a.tif"}) {
        const auto file = folder.path() / name;
        const auto written = write_display_image(file, DisplayImage{1, 1, {{1, 2, 3}}}, metadata);
        ASSERT_TRUE(written) << written.error();
        const auto read = read_image_metadata(file);
        ASSERT_TRUE(read) << read.error();
        const auto recipe = recipe_from_metadata(*read);
        ASSERT_TRUE(recipe) << recipe.error();
        EXPECT_EQ(recipe->version, LUEUR_VERSION);
        EXPECT_EQ(recipe->scene_name, scene.name);
        EXPECT_EQ(recipe->scene_file, folder.path() / "room.toml");
        EXPECT_EQ(recipe->quantity, PictureQuantity::illuminance);
        EXPECT_TRUE(recipe->false_colour);
        EXPECT_EQ(recipe->camera, scene.camera);
        EXPECT_EQ(recipe->display, scene.display);
        EXPECT_EQ(recipe->solve, scene.solve);
    }
    const auto file = folder.path() / "a.exr"; // radiance: as it is, before any display
    ASSERT_TRUE(write_radiance_image(file, RadianceImage{1, 1, {glm::vec3(1)}},
                                     picture_metadata(scene, "room.toml", scene.camera, {}, PictureQuantity::colour)));
    const auto recipe = recipe_from_metadata(*read_image_metadata(file));
    ASSERT_TRUE(recipe) << recipe.error();
    EXPECT_EQ(recipe->camera, scene.camera);
    EXPECT_EQ(recipe->display, DisplaySettings{});
    EXPECT_FALSE(recipe->false_colour);
}

TEST(PictureMetadata, WhatIsMissingOrBrokenIsNamed) {
    const Scene scene = scene_of_odd_numbers();
    const ImageMetadata whole = picture_metadata(scene, "room.toml", scene.camera, {}, PictureQuantity::colour);
    ASSERT_TRUE(recipe_from_metadata(whole).has_value());
    for (const char* key : {"version", "quantity", "solver", "wavelengths", "seed", "target_error", "camera_position",
                            "camera_mirrored"}) {
        ImageMetadata part = whole;
        part.erase(std::string("lueur:") + key);
        EXPECT_THAT(recipe_from_metadata(part).error(), HasSubstr(key));
        if (std::string(key) == "version") continue; // any text will do
        part[std::string("lueur:") + key] = "x y z";
        EXPECT_THAT(recipe_from_metadata(part).error(), HasSubstr(std::string(key) + " = \"x y z\" cannot be read"));
    }
    EXPECT_FALSE(recipe_from_metadata({}).has_value());
}

} // namespace
} // namespace lueur
