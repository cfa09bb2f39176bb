// What an edit costs, what it changes and what it refuses.
#include "editor/edit.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/editor/small_scene.h"

namespace lueur {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

SolveSettings settings_with(auto change) {
    SolveSettings settings = small_scene().solve;
    change(settings);
    return settings;
}
DisplaySettings display_with(auto change) {
    DisplaySettings settings = small_scene().display;
    change(settings);
    return settings;
}
Camera camera_with(auto change) {
    Camera camera = small_scene().camera;
    change(camera);
    return camera;
}
Texture grey_texture(float value) {
    Texture texture;
    texture.path = "grey.png";
    texture.image = std::make_shared<const TextureImage>(TextureImage{1, 1, {glm::vec3(value)}});
    return texture;
}
// Black left half, white right half.
Texture half_texture() {
    Texture texture;
    texture.path = "half.png";
    texture.image = std::make_shared<const TextureImage>(TextureImage{2, 1, {glm::vec3(0), glm::vec3(1)}});
    return texture;
}
Spectrum flat_spectrum(double value) {
    return {{400, 700}, {value, value}};
}

// The table of DESIGN: the later the stage, the cheaper the edit.
TEST(FirstStaleStage, IsTheEarliestThatTheEditTouches) {
    const Scene scene = small_scene();
    const std::pair<Edit, Stage> table[] = {
        {SetReflectance{MaterialIndex(0), 0.5}, Stage::reflectance},
        {SetTexture{MaterialIndex(0), grey_texture(0.5f)}, Stage::reflectance},
        {SetTexture{MaterialIndex(0), std::nullopt}, Stage::reflectance},
        {SetTwoSided{MaterialIndex(0), true}, Stage::mesh},
        {GiveOwnMaterial{ObjectIndex(1)}, Stage::reflectance},
        {AssignMaterial{ObjectIndex(0), MaterialIndex(1)}, Stage::reflectance},
        {AssignMaterial{ObjectIndex(0), MaterialIndex(2)}, Stage::mesh}, // one-sided -> two-sided
        {AssignMaterial{ObjectIndex(0), MaterialIndex(0)}, Stage::nothing},
        {SetDimmer{LuminaireIndex(0), 0.5}, Stage::sources},
        {SetPower{LuminaireIndex(0), PowerUnit::watt, 40}, Stage::sources},
        {SetEmissionSpectrum{LuminaireIndex(0), Blackbody{3000}}, Stage::sources},
        {SetEmitSide{LuminaireIndex(0), EmitSide::both}, Stage::mesh},
        {SetCamera{camera_with([](Camera& c) { c.position.x += 1; })}, Stage::view},
        {SetDisplay{display_with([](DisplaySettings& d) { d.gamma = glm::dvec3(1.8); })}, Stage::display},
        {SetSolve{scene.solve}, Stage::nothing},
        {SetSolve{settings_with([](SolveSettings& s) {
             s.wavelengths = {WavelengthRule::rgb, 3};
         })},
         Stage::reflectance},
        {SetSolve{settings_with([](SolveSettings& s) { s.solver = SolverKind::shooting; })}, Stage::reflectance},
        // Form factors and links are nothing to a solver without them.
        {SetSolve{settings_with([](SolveSettings& s) { s.form_factors = FormFactorMethod::hemicube; })},
         Stage::reflectance},
        {SetSolve{settings_with([](SolveSettings& s) { s.oracle = RefinementOracle::flux; })}, Stage::reflectance},
        {SetSolve{settings_with([](SolveSettings& s) { s.target_error = 0.01; })}, Stage::reflectance},
        {SetSolve{settings_with([](SolveSettings& s) { s.max_rays *= 2; })}, Stage::reflectance},
        {SetSolve{settings_with([](SolveSettings& s) { s.max_rays /= 2; })}, Stage::transport},
        {SetSolve{settings_with([](SolveSettings& s) { s.seed += 1; })}, Stage::transport},
        {SetSolve{settings_with([](SolveSettings& s) { s.element_size = 0.1; })}, Stage::mesh},
        {SetSolve{settings_with([](SolveSettings& s) { s.element_size = 0.1, s.solver = SolverKind::shooting; })},
         Stage::mesh},
        {ReplaceScene{small_scene()}, Stage::mesh},
    };
    for (const auto& [edit, stage] : table)
        EXPECT_EQ(first_stale_stage(edit, scene), stage) << describe(edit, scene) << ", alternative " << edit.index();
}

TEST(Edit, FormFactorsAndLinksAreTransportOfTheSolversThatKeepThem) {
    Scene scene = small_scene();
    const auto stage = [&](auto&& change) {
        SolveSettings settings = scene.solve;
        change(settings);
        return first_stale_stage(SetSolve{settings}, scene);
    };
    const auto other_method = [](SolveSettings& s) { s.form_factors = FormFactorMethod::hemicube; };
    const auto more_samples = [](SolveSettings& s) { s.form_factor_samples = 64; };
    const auto other_oracle = [](SolveSettings& s) { s.oracle = RefinementOracle::flux; };
    for (const SolverKind solver : {SolverKind::jacobi, SolverKind::gauss_seidel, SolverKind::overshooting}) {
        scene.solve.solver = solver;
        EXPECT_EQ(stage(other_method), Stage::transport);
        EXPECT_EQ(stage(more_samples), Stage::transport);
        EXPECT_EQ(stage([](SolveSettings& s) { s.matrix_memory = 64; }), Stage::transport);
        EXPECT_EQ(stage(other_oracle), Stage::reflectance);
        EXPECT_EQ(stage([](SolveSettings& s) { s.solver = SolverKind::gathering; }), Stage::reflectance);
    }
    scene.solve.solver = SolverKind::hierarchical;
    EXPECT_EQ(stage(other_method), Stage::transport);
    EXPECT_EQ(stage(other_oracle), Stage::transport);
    EXPECT_EQ(stage([](SolveSettings& s) { s.link_tolerance = 1; }), Stage::transport);
}

TEST(ApplyEdit, ChangesWhatItNames) {
    const Scene scene = small_scene();
    EXPECT_EQ(apply(SetReflectance{MaterialIndex(1), 0.25}, scene)->materials[1].reflectance, Reflectance(0.25));
    EXPECT_TRUE(apply(SetTwoSided{MaterialIndex(1), true}, scene)->materials[1].two_sided);
    EXPECT_EQ(apply(AssignMaterial{ObjectIndex(0), MaterialIndex(2)}, scene)->objects[0].material, MaterialIndex(2));
    EXPECT_EQ(apply(SetDimmer{LuminaireIndex(0), 0.25}, scene)->luminaires[0].dimmer, 0.25);
    EXPECT_EQ(apply(SetPower{LuminaireIndex(0), PowerUnit::watt, 40}, scene)->luminaires[0].unit, PowerUnit::watt);
    EXPECT_EQ(apply(SetPower{LuminaireIndex(0), PowerUnit::watt, 40}, scene)->luminaires[0].power, 40);
    EXPECT_EQ(apply(SetEmissionSpectrum{LuminaireIndex(0), Blackbody{3000}}, scene)->luminaires[0].spectrum,
              EmissionSpectrum(Blackbody{3000}));
    EXPECT_EQ(apply(SetEmitSide{LuminaireIndex(0), EmitSide::both}, scene)->luminaires[0].side, EmitSide::both);
    EXPECT_EQ(apply(SetSolve{settings_with([](SolveSettings& s) { s.seed = 9; })}, scene)->solve.seed, 9u);
}

TEST(ApplyEdit, ChangesNothingElse) {
    const Scene scene = small_scene();
    Scene after = *apply(SetDimmer{LuminaireIndex(0), 0.25}, scene);
    after.luminaires[0].dimmer = scene.luminaires[0].dimmer;
    EXPECT_EQ(after, scene);
    EXPECT_EQ(scene, [&] {
        Scene same = small_scene();
        same.geometry = scene.geometry;
        return same;
    }());
}

TEST(ApplyEdit, RefusesWhatIsNotThereOrNotAllowed) {
    const Scene scene = small_scene();
    const Edit refused[] = {
        SetReflectance{MaterialIndex(3), 0.5},
        SetReflectance{MaterialIndex(0), 1.01},
        SetReflectance{MaterialIndex(0), -0.01},
        SetReflectance{MaterialIndex(0), nan_value},
        SetReflectance{MaterialIndex(0), Rgb(0.5, 1.5, 0.5)},
        SetReflectance{MaterialIndex(0), SpectrumFile{"paint.csv", "", flat_spectrum(1.2)}},
        SetTexture{MaterialIndex(3), grey_texture(0.5f)},
        SetTexture{MaterialIndex(0), Texture{}}, // no picture behind the name
        SetTwoSided{MaterialIndex(3), true},
        GiveOwnMaterial{ObjectIndex(4)},
        AssignMaterial{ObjectIndex(4), MaterialIndex(0)},
        AssignMaterial{ObjectIndex(0), MaterialIndex(3)},
        SetDimmer{LuminaireIndex(1), 0.5},
        SetDimmer{LuminaireIndex(0), -0.5},
        SetDimmer{LuminaireIndex(0), infinite},
        SetPower{LuminaireIndex(0), PowerUnit::lumen, -1},
        SetPower{LuminaireIndex(0), PowerUnit::lumen, nan_value},
        SetEmissionSpectrum{LuminaireIndex(0), Blackbody{500}},
        SetEmissionSpectrum{LuminaireIndex(0), Rgb(1, -1, 1)},
        SetEmissionSpectrum{LuminaireIndex(0), SpectrumFile{"lamp.csv", "", flat_spectrum(-1)}},
        SetEmitSide{LuminaireIndex(1), EmitSide::both},
        SetCamera{camera_with([](Camera& c) { c.vertical_fov_degrees = 180; })},
        SetCamera{camera_with([](Camera& c) { c.position.x = nan_value; })},
        SetDisplay{display_with([](DisplaySettings& d) { d.max_display = 0; })},
        SetDisplay{display_with([](DisplaySettings& d) { d.curve = TransferCurve::gamma, d.gamma = glm::dvec3(0); })},
        SetDisplay{
            display_with([](DisplaySettings& d) { d.curve = TransferCurve::gamma, d.gamma = glm::dvec3(infinite); })},
        SetSolve{settings_with([](SolveSettings& s) { s.target_error = 0; })},
        SetSolve{settings_with([](SolveSettings& s) {
            s.wavelengths = {WavelengthRule::uniform, 0};
        })},
        SetSolve{settings_with([](SolveSettings& s) { s.element_size = -1; })},
        SetSolve{settings_with([](SolveSettings& s) { s.max_rays = 0; })},
    };
    for (std::size_t i = 0; i < std::size(refused); ++i) {
        const auto after = apply(refused[i], scene);
        ASSERT_FALSE(after.has_value()) << "edit " << i << ": " << describe(refused[i], scene);
        EXPECT_FALSE(after.error().empty()) << "edit " << i;
        EXPECT_THAT(after.error(), testing::Not(testing::HasSubstr("\n"))) << "edit " << i;
    }
}

// A fault that the scene had already is not the fault of an edit elsewhere.
TEST(ApplyEdit, IsNotRefusedForAnOlderFault) {
    Scene scene = small_scene();
    scene.materials[0].reflectance = 1.5;
    EXPECT_TRUE(apply(SetDimmer{LuminaireIndex(0), 0.5}, scene).has_value());
    EXPECT_FALSE(apply(SetDimmer{LuminaireIndex(0), -0.5}, scene).has_value());
}

TEST(GiveOwnMaterial, CopiesASharedMaterialOnly) {
    const Scene scene = small_scene();
    const Scene after = *apply(GiveOwnMaterial{ObjectIndex(1)}, scene);
    ASSERT_EQ(after.materials.size(), 4u);
    EXPECT_EQ(after.materials[3].name, "left wall");
    EXPECT_EQ(after.materials[3].reflectance, scene.materials[1].reflectance);
    EXPECT_EQ(after.objects[1].material, MaterialIndex(3));
    EXPECT_EQ(after.objects[2].material, MaterialIndex(1));
    EXPECT_EQ(*apply(GiveOwnMaterial{ObjectIndex(1)}, after), after) << "it has one of its own by now";
}

TEST(GiveOwnMaterial, FindsANameThatIsFree) {
    Scene scene = small_scene();
    scene.materials[2].name = "left wall";
    EXPECT_EQ(apply(GiveOwnMaterial{ObjectIndex(1)}, scene)->materials[3].name, "left wall 2");
}

TEST(SetTexture, BringsItsMeanAndPaintCoversIt) {
    const Scene scene = small_scene();
    const Scene hung = *apply(SetTexture{MaterialIndex(1), grey_texture(0.25f)}, scene);
    ASSERT_TRUE(hung.materials[1].texture.has_value());
    EXPECT_EQ(hung.materials[1].reflectance, Reflectance(Rgb(0.25)));
    const Scene painted = *apply(SetReflectance{MaterialIndex(1), 0.5}, hung);
    EXPECT_FALSE(painted.materials[1].texture.has_value());
    EXPECT_EQ(painted.materials[1].reflectance, Reflectance(0.5));
    const Scene bare = *apply(SetTexture{MaterialIndex(1), std::nullopt}, hung);
    EXPECT_FALSE(bare.materials[1].texture.has_value());
    EXPECT_EQ(bare.materials[1].reflectance, Reflectance(Rgb(0.25)));
}

// The mean is over the triangles that use the picture. One wall sees its black half only, the other its white half:
// with both the mean is 0.5, and each alone has its own.
TEST(SetTexture, MeanFollowsTheObjectsThatUseIt) {
    Scene scene = small_scene();
    Geometry geometry = *scene.geometry;
    for (std::size_t i = 3; i < 6; ++i)
        geometry.vertices[i].uv = {0.1f + 0.1f * static_cast<float>(i - 3), 0.5f + 0.1f * static_cast<float>(i % 2)};
    for (std::size_t i = 6; i < 9; ++i)
        geometry.vertices[i].uv = {0.6f + 0.1f * static_cast<float>(i - 6), 0.5f + 0.1f * static_cast<float>(i % 2)};
    scene.geometry = std::make_shared<const Geometry>(std::move(geometry));
    scene = *apply(SetTexture{MaterialIndex(1), half_texture()}, scene);
    EXPECT_NEAR(std::get<Rgb>(scene.materials[1].reflectance).g, 0.5, 0.02);
    scene = *apply(GiveOwnMaterial{ObjectIndex(1)}, scene);
    EXPECT_NEAR(std::get<Rgb>(scene.materials[1].reflectance).g, 1, 0.02);
    EXPECT_NEAR(std::get<Rgb>(scene.materials[3].reflectance).g, 0, 0.02);
    scene = *apply(AssignMaterial{ObjectIndex(1), MaterialIndex(1)}, scene);
    EXPECT_NEAR(std::get<Rgb>(scene.materials[1].reflectance).g, 0.5, 0.02);
}

TEST(DescribeEdit, IsWhatAPersonWouldSay) {
    const Scene scene = small_scene();
    EXPECT_EQ(describe(SetReflectance{MaterialIndex(1), 0.5}, scene), "Repaint red");
    EXPECT_EQ(describe(SetDimmer{LuminaireIndex(0), 0.5}, scene), "Dim lamp");
    EXPECT_EQ(describe(AssignMaterial{ObjectIndex(0), MaterialIndex(1)}, scene), "Paint floor as red");
    EXPECT_EQ(describe(GiveOwnMaterial{ObjectIndex(2)}, scene), "Give right wall its own material");
    EXPECT_EQ(describe(SetTwoSided{MaterialIndex(0), true}, scene), "Make white two-sided");
    EXPECT_EQ(describe(SetDimmer{LuminaireIndex(7), 0.5}, scene), "Dim number 7") << "never out of range";
}

TEST(SameTarget, HoldsForASliderAndForNothingElse) {
    EXPECT_TRUE(same_target(SetDimmer{LuminaireIndex(0), 0.1}, SetDimmer{LuminaireIndex(0), 0.9}));
    EXPECT_FALSE(same_target(SetDimmer{LuminaireIndex(0), 0.1}, SetDimmer{LuminaireIndex(1), 0.1}));
    EXPECT_TRUE(same_target(SetReflectance{MaterialIndex(0), 0.1}, SetReflectance{MaterialIndex(0), 0.2}));
    EXPECT_FALSE(same_target(SetReflectance{MaterialIndex(0), 0.1}, SetReflectance{MaterialIndex(1), 0.2}));
    EXPECT_FALSE(same_target(SetReflectance{MaterialIndex(0), 0.1}, SetReflectance{MaterialIndex(0), Rgb(0.2)}));
    EXPECT_FALSE(
        same_target(SetPower{LuminaireIndex(0), PowerUnit::watt, 1}, SetPower{LuminaireIndex(0), PowerUnit::lumen, 1}));
    EXPECT_TRUE(same_target(SetEmissionSpectrum{LuminaireIndex(0), Blackbody{2000}},
                            SetEmissionSpectrum{LuminaireIndex(0), Blackbody{2100}}));
    EXPECT_FALSE(same_target(SetEmissionSpectrum{LuminaireIndex(0), Blackbody{2000}},
                             SetEmissionSpectrum{LuminaireIndex(0), Flat{}}));
    EXPECT_FALSE(same_target(SetTwoSided{MaterialIndex(0), true}, SetTwoSided{MaterialIndex(0), false}));
    EXPECT_FALSE(same_target(SetDimmer{LuminaireIndex(0), 0.1}, SetReflectance{MaterialIndex(0), 0.1}));
}

} // namespace
} // namespace lueur
