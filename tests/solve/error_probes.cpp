// What tells how wrong a solution is must not be wrong itself.
#include <cmath>

#include <gtest/gtest.h>

#include "core/scene/solver_words.h"
#include "core/solve/solution_state.h"
#include "core/transport/direct_light.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

// A window 2 m wide, 50 mm behind slats that leave slits of 10 mm: a slat sees a little of the window, near and large.
Scene room_with_a_blind() {
    test::SceneBuilder b;
    const MaterialIndex white = b.material("white", 0.7), slat = b.material("slat", 0.7, true);
    b.room("room", test::all(white), glm::vec3(0), glm::vec3(4, 2.5f, 4));
    const ObjectIndex window =
        b.polygon("window", white, {{1, 0.8f, 0.01f}, {3, 0.8f, 0.01f}, {3, 2, 0.01f}, {1, 2, 0.01f}});
    for (int k = 0; k < 10; ++k) {
        const float y = 0.8f + 0.12f * float(k);
        b.polygon("slat", slat, {{1, y, 0.06f}, {3, y, 0.06f}, {3, y + 0.11f, 0.07f}, {1, y + 0.11f, 0.07f}});
    }
    b.light("window", {window}, PowerUnit::lumen, 10000);
    Scene scene = b.build();
    scene.solve.max_rays = 64;
    scene.solve.element_size = 2;
    return scene;
}

} // namespace

// Shadow rays to all of the window miss what a slat sees of it; rays of both kinds together do not.
TEST(ErrorProbes, SeeASliverOfANearLuminaire) {
    const Solution solution = test::solved(room_with_a_blind());
    const Solution::State& s = solution.state();
    const ErrorProbes& probes = s.probes;
    ASSERT_TRUE(probes.complete());
    const Emitter& window = s.direct->emitters()[0];
    double found = 0, truth = 0, square = 0, area = 0, before_slats = 0;
    for (std::size_t i = 0; i < probes.points.size(); ++i) {
        const ErrorProbes::Point& p = probes.points[i];
        double direct = 0;
        for (int set = 0; set < ErrorProbes::sets; ++set)
            direct += double(probes.direct[i * ErrorProbes::sets + static_cast<std::size_t>(set)]) / ErrorProbes::sets;
        const double exact = direct_form_factor_sampled(*s.world, window, p.origin, p.normal, 1024, {0.3f, 0.6f});
        found += double(p.area) * direct, truth += double(p.area) * exact;
        square += double(p.area) * (direct - exact) * (direct - exact), area += double(p.area);
        before_slats += p.normal.z < -0.9f && exact > 0.3;
    }
    EXPECT_GT(before_slats, 10) << "the backs of the slats are looked at";
    EXPECT_NEAR(found / truth, 1, 0.02);
    EXPECT_LT(std::sqrt(square / area), 0.1 * truth / area);
}

// Gathering asks its probes last: a solver that takes over from it before asks for itself, and knows as much of its own
// error as if it had been there from the beginning.
TEST(ErrorProbes, AreAskedByASolverThatTakesOver) {
    Scene scene = test::small_room();
    scene.solve.element_size = 0.8;
    scene.solve.target_error = 0.05;
    for (const SolverKind kind : {SolverKind::shooting, SolverKind::hierarchical}) {
        scene.solve.solver = SolverKind::gathering;
        Solution solution(std::make_shared<const Scene>(scene));
        while (!(solution.state().fully_refined() && solution.state().passes.size() > 0) &&
               solution.step(test::never)) {
        }
        ASSERT_FALSE(solution.state().probes.complete()) << "the middle is over";
        Scene other = scene;
        other.solve.solver = kind;
        solution.update(std::make_shared<const Scene>(other), SolveFrom::sources);
        while (solution.step(test::never)) {
        }
        ASSERT_TRUE(solution.status().settled) << solution.status().message;
        EXPECT_TRUE(solution.state().probes.complete());
        Solution fresh(std::make_shared<const Scene>(other));
        while (fresh.step(test::never)) {
        }
        EXPECT_NEAR(solution.status().estimated_error / fresh.status().estimated_error, 1, 0.1) << to_string(kind);
    }
}
