// The solvers of the full matrix at work in a solution: same light as other solvers, edits without rays, refusals.
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/scene_file.h"
#include "core/solve/solution_state.h"
#include "tests/support/scenes.h"
#include "tests/support/source_folder.h"

using namespace lueur;

namespace {

constexpr SolverKind matrix_solvers[] = {SolverKind::jacobi, SolverKind::gauss_seidel, SolverKind::overshooting};

// Few patches: what is tested is the solver, not the light of a room.
Scene coarse_room(SolverKind solver) {
    Scene scene = test::small_room();
    scene.solve.solver = solver;
    scene.solve.element_size = 1;
    scene.solve.form_factors = FormFactorMethod::hemisphere;
    scene.solve.form_factor_samples = 32;
    return scene;
}

} // namespace

// B = E / (1 - rho) on every wall: rows of rays of a closed room sum to 1.
TEST(MatrixSolution, FurnaceByEverySolver) {
    for (const SolverKind solver : matrix_solvers)
        for (const double rho : {0.5, 0.9}) {
            Scene scene = test::furnace(rho);
            scene.solve.solver = solver;
            scene.solve.element_size = 0.5;
            scene.solve.target_error = 0.005;
            scene.solve.form_factors = FormFactorMethod::hemisphere;
            const Solution solution = test::solved(scene);
            ASSERT_TRUE(solution.status().settled) << solution.status().message;
            const Wavelengths& w = *solution.state().wavelengths;
            const std::vector<double> one(static_cast<std::size_t>(w.size()),
                                          solution.state().luminaire_exitance[0][0]);
            const double expected = xyz_from_channels(w, one).y / (1 - rho);
            for (const auto& irradiance : solution.field()->irradiance_xyz)
                EXPECT_NEAR(irradiance.y / expected, 1, 0.005) << rho;
            EXPECT_EQ(solution.status().matrix_bytes, matrix_bytes(solution.state().mesh.coarse_element_count));
        }
}

TEST(MatrixSolution, AllGiveTheSameRadiositiesOnTheSameFormFactors) {
    Solution solution(std::make_shared<const Scene>(coarse_room(SolverKind::jacobi)));
    test::settle(solution);
    ASSERT_TRUE(solution.status().settled) << solution.status().message;
    const std::uint64_t cost = solution.status().form_factor_cost;
    Scene scene = *solution.scene();
    scene.solve.target_error = 1e-7; // of which flux unshot may take a part
    std::vector<double> first;
    double most = 0;
    for (const SolverKind solver : matrix_solvers) {
        scene.solve.solver = solver;
        solution.update(std::make_shared<const Scene>(scene), SolveFrom::reflectance);
        test::settle(solution);
        ASSERT_TRUE(solution.status().settled) << solution.status().message;
        EXPECT_EQ(solution.status().form_factor_cost, cost) << "the matrix is kept from solver to solver";
        const PatchField& h = solution.state().patch_solve.system.irradiance();
        if (first.empty()) {
            first = h.values;
            for (const double value : first) most = std::max(most, value);
            continue;
        }
        ASSERT_EQ(first.size(), h.values.size());
        for (std::size_t k = 0; k < first.size(); ++k) ASSERT_NEAR(h.values[k], first[k], 1e-6 * most);
    }
}

TEST(MatrixSolution, ShowsTheLightThatGatheringShows) {
    Scene scene = test::small_room();
    scene.solve.solver = SolverKind::gauss_seidel;
    scene.solve.form_factors = FormFactorMethod::hemisphere;
    scene.solve.element_size = 0.7;
    const Solution matrix = test::solved(scene);
    ASSERT_TRUE(matrix.status().settled) << matrix.status().message;
    scene.solve.solver = SolverKind::gathering;
    const Solution gathering = test::solved(scene);
    // Mean over area of what arrives on the coarse mesh.
    const auto mean = [](const Solution& solution) {
        const auto field = solution.field();
        const Mesh& mesh = *solution.mesh();
        double sum = 0, area = 0;
        for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e)
            for (int k = 0; k < 3; ++k) {
                sum += mesh.coarse_area[e] * field->irradiance_xyz[mesh.nodes[e].vertices[k]].y;
                area += mesh.coarse_area[e];
            }
        return sum / area;
    };
    EXPECT_NEAR(mean(matrix) / mean(gathering), 1, 0.05);
}

TEST(MatrixSolution, RandomEditsSettleWhereAFreshSolveDoesAndTraceNoRay) {
    std::mt19937 random(17);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    const auto pick = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    const std::atomic<bool> never{false};
    for (const SolverKind solver : matrix_solvers) {
        Scene scene = coarse_room(solver);
        scene.solve.target_error = 0.001;
        Solution edited(std::make_shared<const Scene>(scene));
        for (int edit = 0; edit < 15; ++edit) {
            SolveFrom from = SolveFrom::reflectance;
            switch (pick(3)) {
            case 0:
                scene.materials[pick(scene.materials.size())].reflectance = uniform(0, 0.95);
                break;
            case 1:
                scene.luminaires[pick(2)].dimmer = uniform(0, 1.5), from = SolveFrom::sources;
                break;
            default:
                scene.luminaires[pick(2)].spectrum = Blackbody{uniform(1800, 9000)}, from = SolveFrom::sources;
                break;
            }
            edited.update(std::make_shared<const Scene>(scene), from);
            for (std::size_t steps = pick(6); steps > 0 && edited.step(never); --steps) {
            }
        }
        test::settle(edited);
        const Solution fresh = test::solved(scene);
        ASSERT_TRUE(edited.status().settled) << edited.status().message;
        EXPECT_EQ(edited.status().form_factor_cost, fresh.status().form_factor_cost);
        EXPECT_LT(test::field_difference(*edited.field(), *fresh.field()), 1e-3) << to_string(edited.status().stage);
    }
}

TEST(MatrixSolution, OtherFormFactorsAreMadeAnewOnTheSameMesh) {
    Scene scene = coarse_room(SolverKind::jacobi);
    Solution solution(std::make_shared<const Scene>(scene));
    test::settle(solution);
    const auto mesh = solution.mesh();
    scene.solve.form_factor_samples = 8;
    solution.update(std::make_shared<const Scene>(scene), SolveFrom::transport);
    test::settle(solution);
    EXPECT_EQ(solution.mesh(), mesh);
    const Solution fresh = test::solved(scene);
    EXPECT_LT(test::field_difference(*solution.field(), *fresh.field()), 1e-9);
}

TEST(MatrixSolution, MemoryOverTheLimitIsRefusedInALine) {
    Scene scene = test::small_room();
    scene.solve.solver = SolverKind::jacobi;
    scene.solve.element_size = 0.08;
    scene.solve.matrix_memory = 1;
    const Solution solution = test::solved(scene);
    EXPECT_EQ(solution.status().stage, SolveStage::failed);
    EXPECT_THAT(solution.status().message, testing::HasSubstr("1 MiB are allowed"));
    EXPECT_GT(solution.status().matrix_bytes, 1u << 20);
}

TEST(MatrixSolution, LargerPatchesWhereElementsTakeTooMuch) {
    Scene scene = test::small_room();
    scene.solve.solver = SolverKind::gauss_seidel;
    scene.solve.form_factors = FormFactorMethod::hemisphere;
    scene.solve.element_size = 0.3;
    scene.solve.matrix_memory = 2;
    const Solution solution = test::solved(scene);
    ASSERT_TRUE(solution.status().settled) << solution.status().message;
    EXPECT_GT(matrix_bytes(solution.state().mesh.coarse_element_count), 2u << 20);
    EXPECT_EQ(solution.status().matrix_patches, solution.state().mesh.patches.size());
    for (const auto& irradiance : solution.field()->irradiance_xyz) ASSERT_TRUE(std::isfinite(irradiance.y));
}

TEST(MatrixSolution, ReflectancesTooCloseToOne) {
    for (const SolverKind solver : matrix_solvers) {
        Scene scene = test::furnace(1);
        scene.solve.solver = solver;
        scene.solve.element_size = 0.8;
        scene.solve.form_factors = FormFactorMethod::hemisphere;
        Solution solution(std::make_shared<const Scene>(scene));
        test::settle(solution);
        EXPECT_EQ(solution.status().stage, SolveStage::failed);
        EXPECT_THAT(solution.status().message, testing::StartsWith("no finite solution"));
        EXPECT_EQ(solution.status().sweeps + solution.status().shots, 0u) << "said before the first sweep";
        // Nor does it end for good: a darker paint is solved, without a ray.
        const std::uint64_t cost = solution.status().form_factor_cost;
        for (auto& material : scene.materials) material.reflectance = 0.5;
        solution.update(std::make_shared<const Scene>(scene), SolveFrom::reflectance);
        test::settle(solution);
        EXPECT_TRUE(solution.status().settled) << solution.status().message;
        EXPECT_EQ(solution.status().form_factor_cost, cost);
    }
    Scene scene = test::furnace(1 - 1e-6);
    scene.solve.solver = SolverKind::jacobi;
    scene.solve.element_size = 0.8;
    scene.solve.form_factors = FormFactorMethod::hemisphere;
    const Solution solution = test::solved(scene);
    EXPECT_EQ(solution.status().stage, SolveStage::failed);
    EXPECT_THAT(solution.status().message, testing::HasSubstr("a reflectance is too close to 1"));
    EXPECT_LT(solution.status().sweeps, 100u) << "foreseen, not tried";
}

// Feda & Purgathofer 1992: fewer shots when a patch shoots also what ambient light has yet to bring it.
TEST(MatrixSolution, OvershootingOnTheCornellBox) {
    auto loaded = load_scene(test::source_folder() / "assets/cornell.toml",
                             {.spectrum_library = test::source_folder() / "assets/spectra"});
    ASSERT_TRUE(loaded.has_value());
    Scene scene = loaded->scene;
    scene.solve.solver = SolverKind::jacobi;
    scene.solve.element_size = 0.15;
    scene.solve.form_factors = FormFactorMethod::hemisphere;
    scene.solve.form_factor_samples = 24;
    Solution solution(std::make_shared<const Scene>(scene));
    test::settle(solution);
    ASSERT_TRUE(solution.status().settled) << solution.status().message;
    FormFactorMatrix matrix = solution.state().patch_solve.matrix;
    const Solution::State& s = solution.state();
    PatchField rho(matrix.n, 1), exitance(matrix.n, 1);
    for (std::uint32_t e = 0; e < s.mesh.coarse_element_count; ++e) {
        rho[e][0] = s.material_rho[s.material_of(s.mesh.coarse_surface[e])][1];
        exitance[e][0] = s.luminaire_of(s.mesh.coarse_surface[e], false) ? 1 : 0;
    }
    transpose(matrix);
    int shots[2] = {};
    for (const bool over : {false, true}) {
        MatrixSystem system(matrix, 1, {1.0f});
        system.set_sources(rho, exitance);
        while (system.unshot_share() > 1e-3 && shots[over] < 1000000) {
            ASSERT_TRUE(system.shoot(over));
            ++shots[over];
        }
        EXPECT_FALSE(system.overshooting_given_up());
        EXPECT_LE(system.unshot_share(), 1e-3);
    }
    printf("Cornell box, %u patches, to 0.1 %% unshot: shooting %d shots, overshooting %d\n", matrix.n, shots[0],
           shots[1]);
    EXPECT_LT(shots[1], shots[0]);
}

TEST(MatrixSolution, TransposedAndBack) {
    for (const std::uint32_t n : {1u, 7u, 32u, 75u}) {
        FormFactorMatrix matrix = *make_form_factor_matrix(std::vector<float>(n, 1.0f), 1 << 20);
        for (std::uint32_t k = 0; k < n * n; ++k) matrix.values[k] = static_cast<float>(k);
        const std::vector<float> before = matrix.values;
        transpose(matrix);
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = 0; j < n; ++j) ASSERT_EQ(matrix.at(i, j), before[i * n + j]);
        transpose(matrix);
        EXPECT_EQ(matrix.values, before);
    }
}
