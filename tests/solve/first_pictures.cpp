// The pictures on the way: none of them is darker than the light that was there before by more than what is being found
// out.
#include <gtest/gtest.h>

#include "core/solve/solution_state.h"
#include "tests/support/error_truth.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

double mean_illuminance(const Field& field) {
    double sum = 0;
    for (const glm::vec3& h : field.irradiance_xyz) sum += h.y / double(field.irradiance_xyz.size());
    return sum;
}

// Of what arrives at receivers, the share by which it is not W U.
double wrong_share(const Solution::State& s) {
    const GatherSystem& system = s.system;
    ChannelField gathered(system.count(), s.channels());
    apply_rows(s.passes, RayEnds::coarse, system.radiosity(), gathered, test::never);
    double difference = 0, sum = 0;
    for (std::uint32_t i = 0; i < system.count(); ++i) {
        for (int c = 0; c < s.channels(); ++c) {
            difference += std::abs(double(gathered[i][c]) - system.gathered()[i][c]);
            sum += std::abs(gathered[i][c]);
        }
    }
    return sum > 0 ? difference / sum : 0;
}

} // namespace

// A finer mesh has more receivers: they start from what is known, not from black.
TEST(FirstPictures, DoNotGoDarkWhereTheMeshIsRefined) {
    Scene scene = test::small_room();
    for (Material& m : scene.materials) m.reflectance = 0.8; // most of the light is indirect
    Solution solution(std::make_shared<const Scene>(scene));
    double before = 0;
    std::uint32_t receivers = 0;
    int refinements = 0;
    while (solution.step(test::never)) {
        if (solution.state().phase != SolvePhase::solve && solution.state().phase != SolvePhase::transport) continue;
        if (solution.state().system.count() == 0) continue;
        const double now = mean_illuminance(*solution.field());
        const std::uint32_t count = solution.state().system.count();
        if (receivers > 0 && count > receivers) {
            ++refinements;
            EXPECT_GT(now, 0.95 * before);
        }
        receivers = count;
        before = now;
    }
    EXPECT_GT(refinements, 0);
}

// An edit in the middle, whatever is going on then: what is shown from there is light of the rays there are, and never
// less than nothing.
TEST(FirstPictures, AreTrueAfterAnEditAtAnyMoment) {
    Scene scene = test::small_room();
    scene.solve.element_size = 1.2;
    int pictures = 0, between_passes = 0;
    const auto is_between_passes = [](const Solution::State& s) {
        return s.phase == SolvePhase::transport && !s.passes.empty() && !s.pass_open;
    };
    for (int moment = -3; moment < 400; moment += 5) { // steps; first the moment between two passes, whenever that is
        Solution solution(std::make_shared<const Scene>(scene));
        const Solution::State& s = solution.state();
        bool there = true;
        for (int k = 0; (moment < 0 ? !is_between_passes(s) : k <= moment) && there; ++k)
            there = solution.step(test::never);
        if (!there) break;
        if (s.passes.empty()) continue; // nothing that could be wrong
        between_passes += is_between_passes(s);
        Scene edited = scene;
        edited.materials[0].reflectance = 0.1;
        edited.luminaires[0].dimmer = 0.02;
        solution.update(std::make_shared<const Scene>(edited), SolveFrom::sources);
        for (int k = 0; k < 8 && solution.step(test::never); ++k) {
            if (solution.state().phase != SolvePhase::solve || solution.state().system.count() == 0) continue;
            ASSERT_LT(wrong_share(solution.state()), 1e-5) << "moment " << moment << ", step " << k;
            const auto field = solution.field();
            for (const glm::vec3& h : field->irradiance_xyz) ASSERT_GE(h.y, 0);
            ++pictures;
        }
    }
    EXPECT_GT(pictures, 30);
    EXPECT_GT(between_passes, 0);
}

// The mesh is made on a thread of its own. Another geometry does not wait for it, and nothing of it is left in what
// follows.
TEST(FirstPictures, AnEditWhileTheMeshIsMadeStartsAfresh) {
    Scene fine = test::small_room(), coarse = fine;
    fine.solve.element_size = 0.05;
    coarse.solve.element_size = 2;
    coarse.solve.max_rays = 64;
    coarse.solve.target_error = 0.1;
    Solution edited(std::make_shared<const Scene>(fine)), fresh(std::make_shared<const Scene>(coarse));
    edited.step(test::never);
    edited.update(std::make_shared<const Scene>(fine), SolveFrom::mesh);
    edited.step(test::never);
    edited.update(std::make_shared<const Scene>(coarse), SolveFrom::mesh);
    EXPECT_EQ(edited.mesh(), nullptr);
    for (Solution* solution : {&edited, &fresh})
        while (solution->step(test::never)) {
        }
    ASSERT_TRUE(edited.status().settled);
    EXPECT_EQ(edited.field()->irradiance_xyz, fresh.field()->irradiance_xyz);
    EXPECT_EQ(edited.status().rays, fresh.status().rays);
}

// Where direct light takes long, of 40 lamps, indirect light is solved for a guess of it first. An edit and another
// solver come in between, and what is found then is the same light.
TEST(FirstPictures, ComeBeforeTheDirectLightOfManyLamps) {
    test::SceneBuilder b;
    const MaterialIndex grey = b.material("grey", 0.5);
    b.room("room", {grey, grey, grey, grey, grey, grey}, glm::vec3(0), {4, 3, 4});
    for (int k = 0; k < 40; ++k) {
        const glm::vec3 at(0.5f * float(k % 8) + 0.25f, 2.9f, 0.75f * float(k / 8) + 0.4f);
        const std::string name = "lamp " + std::to_string(k);
        b.light(name, {b.polygon(name, grey, {at, at + glm::vec3(0.1f, 0, 0), at + glm::vec3(0.1f, 0, 0.1f)})},
                PowerUnit::lumen, 100);
    }
    Scene scene = b.build();
    scene.solve.element_size = 0.16;
    const auto is_early = [](const Solution::State& s) { return s.phase == SolvePhase::light && !s.passes.empty(); };
    const auto is_lit = [](const Solution::State& s) { return s.phase == SolvePhase::refine; };
    const auto step_until = [](Solution& solution, const auto& there) {
        while (!there(solution.state()) && solution.step(test::never)) {
        }
        ASSERT_TRUE(there(solution.state()));
    };
    Solution fresh(std::make_shared<const Scene>(scene));
    step_until(fresh, is_early);
    const double early = mean_illuminance(*fresh.field());
    EXPECT_FALSE(fresh.state().direct->is_lit());
    const auto guessed = fresh.field();
    const test::ErrorVerdict verdict =
        test::judge_vertices(fresh, *guessed, test::true_vertices(fresh, true, 100, 256, 24));
    EXPECT_GT(verdict.covered, 0.95 - 2 * 0.022); // as 100 vertices know it
    EXPECT_GT(guessed->scene_error, 0.5 * verdict.truth);
    EXPECT_LT(guessed->scene_error, 0.5) << "a guess that indirect light is solved for is not wholly unknown";
    step_until(fresh, is_lit);
    const double lit = mean_illuminance(*fresh.field());
    EXPECT_NEAR(early / lit, 1, 0.03);

    Scene other = scene;
    other.luminaires[7].dimmer = 0;
    other.materials[0].reflectance = 0.3;
    Solution edited(std::make_shared<const Scene>(other));
    step_until(edited, is_early);
    edited.update(std::make_shared<const Scene>(scene), SolveFrom::reflectance);
    EXPECT_EQ(edited.state().phase, SolvePhase::transport) << "on the rays that are there";
    EXPECT_GT(mean_illuminance(*edited.field()), 0.5 * lit) << "the picture that is there stays";
    step_until(edited, is_early);
    other = scene;
    other.solve.solver = SolverKind::shooting;
    edited.update(std::make_shared<const Scene>(other), SolveFrom::black);
    EXPECT_EQ(edited.state().phase, SolvePhase::light) << "shooting needs the direct light";
    edited.update(std::make_shared<const Scene>(scene), SolveFrom::black);
    step_until(edited, is_lit);
    EXPECT_NEAR(mean_illuminance(*edited.field()) / lit, 1, 2e-3);
}
