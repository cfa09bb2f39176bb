// The estimated error against the true one: the yardstick is traced paths, whose own variance is subtracted. All asset
// scenes and more budgets: tests/bench/error_calibration.cpp.
#include <gtest/gtest.h>

#include "core/scene/scene_file.h"
#include "core/scene/spectral_content.h"
#include "core/solve/wavelength_error.h"
#include "tests/support/error_truth.h"
#include "tests/support/scenes.h"
#include "tests/support/source_folder.h"

using namespace lueur;

namespace {

void expect_calibrated(const Solution& solution, const char* what) {
    const auto field = solution.field();
    ASSERT_EQ(field->error.size(), field->irradiance_xyz.size());
    const auto points = test::true_vertices(solution, false, 250, 2048, 21);
    const test::ErrorVerdict verdict = test::judge_vertices(solution, *field, points);
    printf("%s: true %.2f %%, estimated %.2f %%, %.1f %% inside\n", what, 100 * verdict.truth, 100 * verdict.estimate,
           100 * verdict.covered);
    EXPECT_GT(verdict.counted, 150) << what;
    EXPECT_GT(verdict.ratio(), 0.5) << what;
    EXPECT_LT(verdict.ratio(), 2) << what;
    // 250 vertices: a share of 0.95 is known to 0.014.
    EXPECT_GT(verdict.covered, 0.95 - 2 * 0.014) << what;
}

Scene with_rays(Scene scene, int rays) {
    scene.solve.max_rays = rays;
    scene.solve.target_error = 0.001;
    return scene;
}

} // namespace

// Not held here, since it does not hold: at 64 rays 90 % lie inside (a vertex at a block's foot reads the same dark
// floor as the probes that judge it), and shooting says less than half of its error (its form factors' own error is not
// in it).
TEST(ErrorEstimate, IsRightOnTheCornellBox) {
    const auto loaded = load_scene(test::source_folder() / "assets/cornell.toml");
    ASSERT_TRUE(loaded) << loaded.error().front();
    expect_calibrated(test::solved(with_rays(loaded->scene, 512)), "Cornell box, 512 rays");
}

TEST(ErrorEstimate, IsRightInARoom) {
    for (const int rays : {64, 512}) {
        const Solution solution = test::solved(with_rays(test::small_room(), rays));
        expect_calibrated(solution, rays == 64 ? "room, 64 rays" : "room, 512 rays");
    }
}

// Stopped before there is any indirect light, the estimate says about how much is missing.
TEST(ErrorEstimate, SaysWhatIsMissingBeforeTheFirstBounce) {
    Solution solution(std::make_shared<const Scene>(test::small_room()));
    while (!solution.world() || solution.state().phase == SolvePhase::sketch ||
           solution.state().phase == SolvePhase::light)
        solution.step(test::never);
    ASSERT_FALSE(solution.state().solving);
    const auto field = solution.field();
    const test::ErrorVerdict verdict =
        test::judge_vertices(solution, *field, test::true_vertices(solution, true, 150, 1024, 22));
    EXPECT_GT(verdict.truth, 0.2);
    EXPECT_GT(verdict.ratio(), 0.5);
    EXPECT_LT(verdict.ratio(), 2);
}

// Four samples after Meyer under a fluorescent lamp: the light itself is wrong by several per cent, and it is said.
TEST(ErrorEstimate, CountsTheWavelengths) {
    Scene scene = test::small_room();
    const SpectralContent content = spectral_content(scene);
    const WavelengthError fine = wavelength_error(make_wavelengths({WavelengthRule::uniform, 81}, content), content),
                          folded = wavelength_error(make_wavelengths({WavelengthRule::folded, 8}, content), content),
                          coarse = wavelength_error(make_wavelengths({WavelengthRule::meyer, 4}, content), content);
    EXPECT_LT(fine.direct, 1e-3);
    EXPECT_LT(fine.reflected, 1e-3);
    EXPECT_LT(folded.direct, 1e-6); // the lamps' luminances are in the weights
    EXPECT_LT(folded.reflected, 0.01);
    EXPECT_GT(coarse.direct + coarse.reflected, 4 * (folded.direct + folded.reflected));
}

// Nothing to be wrong about: every vertex of a furnace is exact, and the estimate is small.
TEST(ErrorEstimate, IsSmallInAFurnace) {
    const Solution solution = test::solved(test::furnace(0.5));
    EXPECT_LT(solution.field()->scene_error, 0.02);
    EXPECT_EQ(solution.status().estimated_error, solution.field()->scene_error);
}

TEST(ErrorEstimate, NoLightHasNoError) {
    test::SceneBuilder b;
    b.room("room", test::all(b.material("white", 0.8)), glm::vec3(0), glm::vec3(1));
    const Solution solution = test::solved(b.build());
    for (const float e : solution.field()->error) EXPECT_EQ(e, 0);
    EXPECT_EQ(solution.field()->scene_error, 0);
}
