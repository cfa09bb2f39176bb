// What must hold for any scene: residuals fall, energy is kept, edits end where a fresh solve ends.
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/solve/solution_state.h"
#include "tests/support/scenes.h"

using namespace lueur;

TEST(Gathering, ResidualNeverGrows) {
    const Solution solution = test::solved(test::small_room());
    const Solution::State& s = solution.state();
    ChannelField rho(s.receivers.count(), 31), direct(s.receivers.count(), 31);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    for (std::uint32_t i = 0; i < rho.count; ++i)
        for (int c = 0; c < 31; ++c)
            rho[i][c] = 0.99f * unit(random), direct[i][c] = unit(random) < 0.01f ? 100.0f : 0.0f;
    const std::vector<float> area(rho.count, 1.0f);
    GatherSystem system(rho.count, 31, area);
    system.set_sources(rho, direct);
    double before = system.relative_residual();
    EXPECT_NEAR(before, 1, 1e-6);
    for (int sweep = 0; sweep < 25 && before > 1e-5; ++sweep) {
        while (!system.sweep(s.passes, test::never)) {
        }
        EXPECT_LE(system.relative_residual(), before * (1 + 1e-5));
        before = system.relative_residual();
    }
    EXPECT_LT(before, 1e-4);
    // The residual it says is the residual there is: B - rho W B = b.
    ChannelField wb(rho.count, 31);
    ASSERT_TRUE(apply_rows(s.passes, RayEnds::coarse, system.radiosity(), wb, test::never));
    double square = 0, norm = 0;
    for (std::uint32_t i = 0; i < rho.count; ++i)
        for (int c = 0; c < 31; ++c) {
            const double b = double(rho[i][c]) * direct[i][c];
            const double r = b - system.radiosity()[i][c] + double(rho[i][c]) * wb[i][c];
            square += area[i] * r * r, norm += area[i] * b * b;
        }
    EXPECT_LT(std::sqrt(square / norm), 2e-4);
}

TEST(Gathering, DimmingTheOnlyLampNeedsNoSweep) {
    Scene scene = test::furnace(0.7);
    Solution solution = test::solved(scene);
    const double before = solution.field()->irradiance_xyz[0].y;
    scene.luminaires[0].dimmer = 0.25;
    solution.update(std::make_shared<const Scene>(scene), SolveFrom::sources);
    test::settle(solution);
    EXPECT_EQ(solution.status().sweeps, 0u);
    EXPECT_NEAR(solution.field()->irradiance_xyz[0].y / before, 0.25, 1e-4);
}

TEST(Gathering, CancelledStepsLeaveAValidState) {
    const Scene scene = test::small_room();
    Solution cut(std::make_shared<const Scene>(scene));
    const std::atomic<bool> never{false}, always{true};
    int steps = 0;
    while (true) {
        if (steps++ % 3 == 0)
            cut.step(always);
        else if (!cut.step(test::never))
            break;
        ASSERT_LT(steps, 100000);
    }
    const Solution whole = test::solved(scene);
    ASSERT_EQ(cut.mesh()->vertices.size(), whole.mesh()->vertices.size());
    EXPECT_LT(test::field_difference(*cut.field(), *whole.field()), 1e-3);
}

// The heart of the editor: any sequence of edits, also in the middle of a solve, settles where a fresh solve of the
// same scene settles.
TEST(Gathering, RandomEditsSettleWhereAFreshSolveDoes) {
    std::mt19937 random(42);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    const auto pick = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    Scene scene = test::small_room();
    scene.solve.target_error = 0.04;
    Solution edited(std::make_shared<const Scene>(scene));
    for (int round = 0; round < 6; ++round) {
        for (int edit = 0; edit < 5; ++edit) {
            SolveFrom from = SolveFrom::reflectance;
            switch (pick(5)) {
            case 0:
                scene.materials[pick(scene.materials.size())].reflectance = uniform(0, 0.95);
                break;
            case 1:
                scene.materials[pick(scene.materials.size())].reflectance =
                    Rgb(uniform(0, 1), uniform(0, 1), uniform(0, 1));
                break;
            case 2:
                scene.luminaires[pick(2)].dimmer = uniform(0, 1.5), from = SolveFrom::sources;
                break;
            case 3:
                scene.luminaires[pick(2)].spectrum = Blackbody{uniform(1800, 9000)}, from = SolveFrom::sources;
                break;
            default:
                scene.solve.wavelengths =
                    pick(2) ? WavelengthsSpec{WavelengthRule::uniform, 31} : WavelengthsSpec{WavelengthRule::rgb, 3};
                break;
            }
            edited.update(std::make_shared<const Scene>(scene), from);
            for (std::size_t steps = pick(12); steps > 0 && edited.step(test::never); --steps) {
            }
            for (std::size_t steps = pick(40); steps > 0 && edited.prepare_edits(test::never); --steps) {
            }
        }
        if (round % 4 != 3) continue;
        test::settle(edited);
        const Solution fresh = test::solved(scene);
        ASSERT_TRUE(edited.status().settled) << edited.status().message;
        ASSERT_EQ(edited.mesh()->vertices.size(), fresh.mesh()->vertices.size());
        EXPECT_EQ(edited.status().rays_per_receiver, fresh.status().rays_per_receiver);
        EXPECT_LT(test::field_difference(*edited.field(), *fresh.field()), 1e-3) << "round " << round;
    }
}

// Flux balance of the whole: what luminaires emit is what surfaces absorb and what leaves the scene (nothing, in a
// closed room).
TEST(Gathering, EnergyIsKeptInAClosedRoom) {
    Scene scene = test::small_room();
    scene.solve.target_error = 0.01;
    const Solution solution = test::solved(scene);
    const Solution::State& s = solution.state();
    const std::vector<float> areas = vertex_areas(*solution.mesh());
    const auto field = solution.field();
    const std::size_t vertices = areas.size();
    double absorbed = 0; // sum A (H - B_reflected), luminous
    for (std::size_t v = 0; v < vertices; ++v)
        if (!s.direct->buried()[v] && !(v < s.buried.size() && s.buried[v]))
            absorbed += areas[v] * (field->irradiance_xyz[v].y - M_PI * field->reflected_xyz[v].y);
    EXPECT_NEAR(absorbed / solution.status().emitted_lumens, 1,
                0.03); // lamp backs and elements under the block: a few per cent
}

TEST(Shooting, UnshotFluxFallsWithEveryShot) {
    Scene scene = test::small_room();
    scene.solve.solver = SolverKind::shooting;
    for (Material& m : scene.materials) m.reflectance = 0.9;
    Solution solution(std::make_shared<const Scene>(scene));
    const std::atomic<bool> always{false};
    double before = 1.0 + 1e-12;
    std::uint32_t shots = 0;
    for (int step = 0; step < 3000 && shots < 400; ++step) {
        if (!solution.step(always)) break;
        if (solution.status().shots == shots) continue;
        EXPECT_LT(solution.status().unshot_share, before);
        before = solution.status().unshot_share;
        shots = solution.status().shots;
    }
    EXPECT_GE(shots, 100u);
    EXPECT_LT(before, 0.9);
}

TEST(Shooting, FurnaceAndGatheringAgree) {
    Scene scene = test::furnace(0.5);
    scene.solve.solver = SolverKind::shooting;
    scene.solve.element_size = 0.5;
    const Solution furnace = test::solved(scene);
    const Wavelengths& w = *furnace.state().wavelengths;
    const std::vector<double> flat(w.size(), 1.0);
    const double scale = watts_from_channels(w, flat) / xyz_from_channels(w, std::span<const double>(flat)).y;
    const auto furnace_field = furnace.field();
    for (const glm::vec3& h : furnace_field->irradiance_xyz) ASSERT_NEAR(h.y * scale, 2, 0.03);

    Scene room = test::small_room();
    room.solve.element_size = 0.3, room.solve.target_error = 0.03;
    const Solution gathered = test::solved(room);
    room.solve.solver = SolverKind::shooting;
    const Solution shot = test::solved(room);
    ASSERT_TRUE(shot.status().settled);
    EXPECT_GT(shot.status().shots, 100u);
    ASSERT_EQ(shot.mesh()->vertices.size(), gathered.mesh()->vertices.size());
    EXPECT_LT(test::field_difference(*shot.field(), *gathered.field()), 0.04);
}

TEST(Shooting, LuminairesShootFirstAndTheAmbientTermFillsIn) {
    Scene scene = test::small_room();
    scene.solve.solver = SolverKind::shooting;
    scene.solve.element_size = 0.5;
    Solution solution(std::make_shared<const Scene>(scene));
    while (solution.status().shots < 1) ASSERT_TRUE(solution.step(test::never));
    EXPECT_EQ(solution.status().shooting_patch, no_index); // a luminaire, not a patch
    // Places no lamp reaches are not black: the ambient term stands for the unshot flux.
    const std::vector<float> ambient = solution.state().ambient();
    ASSERT_EQ(ambient.size(), static_cast<std::size_t>(solution.state().channels()));
    EXPECT_GT(ambient[0], 0);
    const auto field = solution.field();
    for (const glm::vec3& h : field->irradiance_xyz) EXPECT_GT(h.y, 0);
    test::settle(solution);
    EXPECT_LT(solution.state().ambient()[0], 0.05 * ambient[0]); // and goes away with it
}

TEST(Solution, TheSameSeedGivesTheSameBits) {
    const Solution a = test::solved(test::small_room()), b = test::solved(test::small_room());
    EXPECT_EQ(a.field()->irradiance_xyz, b.field()->irradiance_xyz);
}
