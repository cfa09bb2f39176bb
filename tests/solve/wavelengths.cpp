// Solutions in different wavelengths: they agree, and edits of spectra cost what the design says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/scene_file.h"
#include "core/scene/spectral_content.h"
#include "core/solve/solution_state.h"
#include "core/spectrum/colour_difference.h"
#include "core/spectrum/observer.h"
#include "core/spectrum/wavelengths_plan.h"
#include "tests/support/scenes.h"
#include "tests/support/source_folder.h"

using namespace lueur;

namespace {

constexpr WavelengthsSpec automatic{WavelengthRule::automatic, 0}, eighty_one{WavelengthRule::uniform, 81};

Scene cornell_box() {
    auto loaded = load_scene(test::source_folder() / "assets/cornell.toml");
    EXPECT_TRUE(loaded);
    Scene scene = loaded->scene;
    scene.solve.target_error = 0.05;
    scene.solve.element_size = 0.15; // wavelengths are asked about, not shadows
    return scene;
}

// Of what is seen of every vertex, white being a perfect reflector where it is brightest: products of reflectances are
// then in about the measure in which they are predicted.
std::vector<double> colour_differences(const Field& a, const Field& b, const Xyz& lamp) {
    double brightest = 0;
    for (const glm::vec3& xyz : b.irradiance_xyz) brightest = std::max<double>(brightest, xyz.y / M_PI);
    const Xyz white = lamp * (brightest / lamp.y);
    std::vector<double> differences;
    for (std::size_t v = 0; v < b.reflected_xyz.size(); ++v)
        differences.push_back(
            delta_e_2000(lab_from_xyz(Xyz(a.reflected_xyz[v]), white), lab_from_xyz(Xyz(b.reflected_xyz[v]), white)));
    return differences;
}

} // namespace

// The same rays, so that only the wavelengths differ. What is predicted of products of up to three paints holds for the
// light of all bounces.
TEST(SolutionWavelengths, AutoAgreesWith81WithinItsPrediction) {
    Scene scene = cornell_box();
    scene.solve.wavelengths = automatic;
    Solution solution = test::solved(scene);
    EXPECT_LE(solution.state().wavelengths->size(), 8);
    const double predicted = solution.status().predicted_colour_error;
    EXPECT_GT(predicted, 0);
    EXPECT_LE(predicted, 0.5);
    EXPECT_THAT(solution.status().wavelengths, testing::HasSubstr("predicted dE2000"));
    const auto in_auto = solution.field();
    const std::uint64_t rays = solution.status().rays;
    scene.solve.wavelengths = eighty_one;
    test::edit(solution, scene, SolveFrom::reflectance);
    EXPECT_EQ(solution.status().rays, rays);
    EXPECT_EQ(solution.state().wavelengths->size(), 81);
    const auto lamp = xyz_from_spectrum(spectrum_of(scene.luminaires[0]));
    const auto differences = colour_differences(*in_auto, *solution.field(), lamp);
    double mean = 0, worst = 0;
    for (const double difference : differences) {
        mean += difference / static_cast<double>(differences.size());
        worst = std::max(worst, difference);
    }
    EXPECT_GT(worst, 0);
    EXPECT_LE(worst, predicted + 0.1); // 81 channels are off by that themselves
    EXPECT_LT(mean, 0.3);
}

TEST(SolutionWavelengths, AnotherLampSpectrumTracesNoRayAndNeedsNoSweep) {
    Scene scene = cornell_box();
    scene.solve.wavelengths = {WavelengthRule::folded, 8};
    scene.solve.colour_error = 3; // roomy: the prediction holds for each of these lamps
    Solution solution = test::solved(scene);
    const std::uint64_t rays = solution.status().rays;
    const auto before = solution.field();
    const auto nm = solution.state().wavelengths->nm;
    for (const EmissionSpectrum& spectrum :
         {EmissionSpectrum(Blackbody{2700}), EmissionSpectrum(Flat{}), EmissionSpectrum(Blackbody{6500})}) {
        scene.luminaires[0].spectrum = spectrum;
        test::edit(solution, scene, SolveFrom::sources);
        ASSERT_TRUE(solution.status().settled);
        EXPECT_EQ(solution.status().rays, rays);
        EXPECT_EQ(solution.state().wavelengths->nm, nm) << solution.status().wavelengths;
        EXPECT_EQ(solution.status().sweeps, 0u) << "only the weights to XYZ have changed";
        // And it is what a solve from nothing finds.
        EXPECT_LT(test::field_difference(*solution.field(), *test::solved(scene).field()), 0.02);
    }
    EXPECT_GT(test::field_difference(*solution.field(), *before), 0.02) << "the light has changed";
}

TEST(SolutionWavelengths, PaintsAndDimmersKeepTheWavelengths) {
    Scene scene = cornell_box();
    scene.solve.wavelengths = automatic;
    Solution solution = test::solved(scene);
    const std::uint64_t rays = solution.status().rays;
    const auto wavelengths = solution.state().wavelengths;
    scene.luminaires[0].dimmer = 0.3;
    test::edit(solution, scene, SolveFrom::sources);
    EXPECT_EQ(solution.state().wavelengths, wavelengths) << "the very same: nothing is planned";
    scene.materials[0].reflectance = 0.6; // grey says nothing about wavelengths
    test::edit(solution, scene, SolveFrom::reflectance);
    EXPECT_EQ(solution.state().wavelengths->nm, wavelengths->nm);
    EXPECT_EQ(solution.status().rays, rays);
    // A filter that is nothing like the paints there were breaks the target: planned anew, and still without a ray.
    scene.materials[1].reflectance =
        SpectrumFile{"filter.csv", "", {{380, 569, 571, 579, 581, 780}, {0, 0, 0.9, 0.9, 0, 0}}};
    test::edit(solution, scene, SolveFrom::reflectance);
    EXPECT_NE(solution.state().wavelengths->nm, wavelengths->nm);
    EXPECT_LE(solution.status().predicted_colour_error, 0.5);
    EXPECT_EQ(solution.status().rays, rays);
}

// Where two lamps differ each has its own channels: an edit of one needs sweeps, and no ray.
TEST(SolutionWavelengths, TwoDifferentLampsEachHaveChannels) {
    Scene scene = test::small_room();
    scene.solve.wavelengths = automatic;
    Solution solution = test::solved(scene);
    const Wavelengths& w = *solution.state().wavelengths;
    ASSERT_EQ(w.lights.size(), 2u);
    EXPECT_EQ(w.size(), 2 * w.samples);
    const std::uint64_t rays = solution.status().rays;
    scene.solve.wavelengths = eighty_one;
    const auto in_auto = solution.field();
    test::edit(solution, scene, SolveFrom::reflectance);
    EXPECT_EQ(solution.status().rays, rays);
    EXPECT_LT(test::field_difference(*in_auto, *solution.field()), 5e-3);
}

// A line between the lecture's four wavelengths is lost, and the user is told; folded samples see it.
TEST(SolutionWavelengths, ALineThatIsNotSeenIsSaid) {
    Scene scene = cornell_box();
    scene.luminaires[0].spectrum = SpectrumFile{"line.csv", "", {{588.5, 589, 589.5}, {0, 1, 0}}};
    scene.solve.wavelengths = {WavelengthRule::meyer, 4};
    Solution solution = test::solved(scene);
    EXPECT_THAT(solution.status().message, testing::HasSubstr("nothing at the wavelengths of meyer:4"));
    EXPECT_EQ(solution.status().emitted_lumens, 0);
    scene.solve.wavelengths = automatic;
    test::edit(solution, scene, SolveFrom::reflectance);
    EXPECT_THAT(solution.status().message, testing::Not(testing::HasSubstr("nothing at the wavelengths")));
    EXPECT_NEAR(solution.status().emitted_lumens, 300, 1e-3);
}
