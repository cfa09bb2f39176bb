// What a solve is said to take, against what it takes.
#include <gtest/gtest.h>

#include "core/scene/scene_file.h"
#include "core/solve/memory_plan.h"
#include "core/solve/solution_state.h"
#include "tests/support/hall.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

using namespace lueur;

namespace {

void expect_near(std::uint64_t planned, std::size_t made, const char* what) {
    EXPECT_GT(double(planned), 0.7 * double(made)) << what;
    EXPECT_LT(double(planned), 1.3 * double(made)) << what;
}

} // namespace

TEST(MemoryPlan, OfASmallHallIsWhatItTakes) {
    const test::TemporaryFolder folder;
    test::write_hall(folder.path(), "hall", {.triangles = 7000, .luminaires_along = 4, .luminaires_across = 3});
    auto loaded = load_scene(folder.path() / "hall.toml", {});
    ASSERT_TRUE(loaded) << loaded.error().front();
    Scene& scene = loaded->scene;
    scene.solve.max_rays = 64;
    scene.solve.element_size = 1.5;
    Solution solution(std::make_shared<const Scene>(scene));
    while (solution.step(test::never)) { // until all is taken
        const Solution::State& now = solution.state();
        if (now.fully_refined() && now.phase == SolvePhase::solve && now.passes.size() >= 2) break;
    }
    const Solution::State& s = solution.state();
    const MemoryPlan plan = plan_memory(scene, s.channels());
    expect_near(plan.vertices, s.mesh.vertices.size(), "vertices");
    expect_near(plan.elements, s.mesh.elements.size(), "elements");
    expect_near(plan.samples, s.mesh.coarse_vertex_count, "places that light is computed at");
    expect_near(plan.direct, s.direct->bytes(), "shares of the luminaires");
    std::size_t ends = 0;
    for (const GatherPass& pass : s.passes) // and where they met the mesh, as long as it grew
        ends += 4 * (pass.ends.size() + pass.fine_ends.size()) + sizeof(RayHit) * pass.ends.size();
    expect_near(plan.rows, ends, "ends of rays");
    EXPECT_GT(plan.mesh, 100 * plan.vertices);
    EXPECT_GT(plan.peak(), plan.mesh + plan.direct + plan.rows);
}

// Nothing of it is made: a scene of any size is planned from its triangles and its area.
TEST(MemoryPlan, GrowsWithTheMesh) {
    std::uint64_t before = 0;
    for (const double size : {0.5, 0.1, 0.02}) {
        Scene scene = test::small_room();
        scene.solve.element_size = size;
        const MemoryPlan plan = plan_memory(scene, 8), more = plan_memory(scene, 31);
        EXPECT_GT(plan.peak(), before);
        EXPECT_GT(plan.elements, 5 / (size * size)); // some 90 m^2
        EXPECT_GT(more.fields, 2 * plan.fields);
        before = plan.peak();
    }
}
