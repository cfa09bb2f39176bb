// The estimated error against the true one: the yardstick is traced paths, whose own variance is subtracted. All asset
// scenes and more budgets: tests/bench/error_calibration.cpp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/scene/scene_file.h"
#include "core/scene/solver_words.h"
#include "core/scene/spectral_content.h"
#include "core/solve/error_estimate.h"
#include "core/solve/wavelength_error.h"
#include "core/view/error_statistics.h"
#include "tests/support/error_truth.h"
#include "tests/support/scenes.h"
#include "tests/support/source_folder.h"

using namespace lueur;

namespace {

void expect_calibrated(const Solution& solution, const char* what) {
    const auto field = solution.field();
    ASSERT_EQ(field->error.size(), field->irradiance_xyz.size());
    const auto points = test::true_vertices(solution, false, 250, 1024, 21);
    const test::ErrorVerdict verdict = test::judge_vertices(solution, *field, points);
    printf("%s: true %.2f %%, estimated %.2f %%, %.1f %% inside\n", what, 100 * verdict.truth, 100 * verdict.estimate,
           100 * verdict.covered);
    EXPECT_GT(verdict.counted, 150) << what;
    EXPECT_TRUE(verdict.right()) << what << ": ratio " << verdict.ratio()
                                 << ", more than the paths' own noise explains";
    // 250 vertices: a share of 0.95 is known to 0.014.
    EXPECT_GT(verdict.covered, 0.95 - 2 * 0.014) << what;
}

Scene with_rays(Scene scene, int rays) {
    scene.solve.max_rays = rays;
    scene.solve.target_error = 0.001;
    return scene;
}

} // namespace

TEST(ErrorEstimate, IsRightOnTheCornellBox) {
    const auto loaded = load_scene(test::source_folder() / "assets/cornell.toml");
    ASSERT_TRUE(loaded) << loaded.error().front();
    for (const int rays : {64, 512})
        expect_calibrated(test::solved(with_rays(loaded->scene, rays)),
                          rays == 64 ? "Cornell box, 64 rays" : "Cornell box, 512 rays");
}

// What these solvers show is wrong by their form factors and by patches of one radiosity each, of which they say
// nothing: the probes alone tell.
TEST(ErrorEstimate, IsRightOfOtherSolvers) {
    Scene scene = test::small_room();
    scene.solve.target_error = 0.1;
    for (const SolverKind kind : {SolverKind::shooting, SolverKind::gauss_seidel, SolverKind::hierarchical}) {
        scene.solve.solver = kind;
        scene.solve.element_size = kind == SolverKind::gauss_seidel ? 0.8 : 0.6; // m; a matrix grows with its square
        expect_calibrated(test::solved(scene), to_string(kind).c_str());
    }
}

// A standard deviation of seven times the light says that nothing is known, not that the error is 700 %: of 1000
// vertices ten of those make 10 %.
TEST(ErrorEstimate, NothingKnownIsWhollyWrongAtMost) {
    std::vector<float> light(1000, 100), deviation(1000, 1), area(1000, 1);
    std::fill_n(deviation.begin(), 10, 700.0f);
    const std::vector<std::uint8_t> none(1000, 0);
    EXPECT_NEAR(relative_rms(light, deviation, {}, area, none), 0.1, 0.002);
    std::fill_n(deviation.begin(), 10, 1.0f);
    EXPECT_NEAR(relative_rms(light, deviation, {}, area, none), 0.01, 1e-5);
}

// What a chart calls the error of a field is what the field says of itself: one definition (relative_error.h).
TEST(ErrorEstimate, ChartsSpeakOfTheSameError) {
    const Solution solution = test::solved(with_rays(test::small_room(), 16));
    const auto field = solution.field();
    const test::ErrorVerdict verdict =
        test::judge_scene(solution, *field, test::true_surface_points(solution, 300, 1024, 23));
    std::vector<Irradiance> values, truth;
    for (const test::JudgedPoint& p : verdict.points) {
        values.emplace_back().illuminance_lx = p.value;
        truth.emplace_back().illuminance_lx = p.truth;
        truth.back().standard_error_percent = 100 * p.noise / p.truth;
    }
    const ErrorStatistics chart = error_statistics(values, truth);
    EXPECT_EQ(chart.counted, verdict.counted);
    EXPECT_NEAR(chart.rms_without_noise, std::max(chart.resolution, verdict.truth), 1e-6);
    EXPECT_GT(chart.rms_without_noise, 0.5 * field->scene_error);
    EXPECT_LT(chart.rms_without_noise, 2 * field->scene_error);
}

// The status, the warning and the field speak of one estimate, after an edit too.
TEST(ErrorEstimate, OneFigureIsTold) {
    Solution solution = test::solved(with_rays(test::small_room(), 64));
    const auto told = [&] { return fmt::format("estimated error {:.1f} %,", 100 * solution.field()->scene_error); };
    EXPECT_EQ(solution.status().estimated_error, solution.field()->scene_error);
    EXPECT_TRUE(solution.status().message.starts_with(told())) << solution.status().message;
    EXPECT_NE(solution.status().message.find("64 rays a receiver are the limit set"), std::string::npos);
    auto dimmed = std::make_shared<Scene>(*solution.scene());
    dimmed->luminaires[0].dimmer = 0.1;
    solution.update(dimmed, SolveFrom::sources);
    test::settle(solution);
    EXPECT_TRUE(solution.status().message.starts_with(told())) << solution.status().message;
    // With rays to spare it is not they that are lacking.
    auto coarse = std::make_shared<Scene>(*solution.scene());
    coarse->solve.target_error = 0.02;
    coarse->solve.max_rays = 4096;
    solution.update(coarse, SolveFrom::transport);
    test::settle(solution);
    if (solution.status().estimated_error > 1.1 * 0.02)
        EXPECT_TRUE(solution.status().message.ends_with("smaller elements would lower it"))
            << solution.status().message;
    else
        EXPECT_EQ(solution.status().message, "");
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

// Before the first reflection is solved a cupboard that is open by a slit lacks less light than the room does: the rays
// that told who is buried have seen how dark it is in there.
TEST(ErrorEstimate, LessIsMissingWhereItIsDark) {
    test::SceneBuilder b;
    const MaterialIndex white = b.material("white", 0.7), board = b.material("board", 0.4, true);
    b.lit_room("room", white, glm::vec3(0), glm::vec3(4, 2.5f, 4), 0.4f, 3000);
    b.room("cupboard", test::all(board), {0.3f, 0.3f, 0.3f}, {1.1f, 1.1f, 0.9f}, 5);
    b.polygon("door", board, {{0.3f, 0.3f, 0.9f}, {1.05f, 0.3f, 0.9f}, {1.05f, 1.1f, 0.9f}, {0.3f, 1.1f, 0.9f}});
    Scene scene = b.build();
    scene.solve.element_size = 0.3;
    Solution solution(std::make_shared<const Scene>(scene));
    while (solution.state().phase != SolvePhase::transport) solution.step(test::never);
    const Solution::State& s = solution.state();
    ASSERT_FALSE(s.solving);
    const auto field = solution.field();
    const PathLights lights = make_path_lights(s);
    double truth = 0, stated = 0, in_room = 0;
    int inside = 0;
    for (std::uint32_t v = 0; v < s.mesh.coarse_vertex_count; ++v) {
        const glm::vec3 p = s.mesh.vertices[v].position, n = s.mesh.vertices[v].normal;
        const glm::vec3 in = p + 0.1f * n;
        const bool within = in.x > 0.3f && in.x < 1 && in.y > 0.3f && in.y < 1.1f && in.z > 0.3f && in.z < 0.9f;
        if (!within) {
            in_room = std::max(in_room, double(field->error[v]));
            continue;
        }
        const PathEstimate e = trace_irradiance(s, lights, s.origins[v], n, 1024, v, test::never);
        const double off = double(field->irradiance_xyz[v].y) - e.illuminance;
        truth += off * off - e.standard_error * e.standard_error;
        stated += double(field->error[v]) * field->error[v];
        ++inside;
    }
    truth = std::sqrt(truth / inside), stated = std::sqrt(stated / inside);
    printf("%d vertices within: %.2f lx are missing, %.2f stated, in the room up to %.0f\n", inside, truth, stated,
           in_room);
    EXPECT_GT(inside, 20);
    EXPECT_GT(truth / stated, 0.5);
    EXPECT_LT(truth / stated, 2);
    EXPECT_LT(stated, 0.3 * in_room);
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
