// Reading the field at points: one on a surface always has a value.
#include <cmath>

#include <gtest/gtest.h>

#include "core/view/measure.h"
#include "tests/support/scenes.h"

using namespace lueur;

// In a gap narrower than how far from a point its surface is looked for, a ray from there begins inside the block
// above.
TEST(MeasureField, PointsInNarrowGapsHaveTheLightOfTheirOwnSurface) {
    test::SceneBuilder b;
    const auto white = b.material("white", 0.7), black = b.material("black", 0.0);
    b.lit_room("room", white, glm::vec3(0), glm::vec3(3), 0.5f, 1000);
    b.block("lid", black, {1, 0.003f, 1}, {2, 0.5f, 2});
    Scene scene = b.build();
    scene.solve.element_size = 0.4;
    const Solution solution = test::solved(scene);
    std::vector<MeasurePoint> points;
    for (const double x : {1.13, 1.37, 1.61, 1.87}) {
        points.push_back({{x, 0, 1.5}, {0, 1, 0}});       // under it
        points.push_back({{x, 0.003, 1.43}, {0, -1, 0}}); // its underside
        points.push_back({{x, 0.5, 1.43}, {0, 1, 0}});    // on it
    }
    const auto measured = measure_points(solution, points, {MeasureAt::field, 0, 1}, test::never);
    ASSERT_EQ(measured.size(), points.size());
    for (std::size_t i = 0; i < measured.size(); i += 3) {
        EXPECT_TRUE(std::isfinite(measured[i].illuminance_lx)) << i;
        EXPECT_TRUE(std::isfinite(measured[i + 1].illuminance_lx)) << i;
        EXPECT_LT(measured[i].illuminance_lx, 0.2 * measured[i + 2].illuminance_lx) << i;
        EXPECT_LT(measured[i + 1].illuminance_lx, 0.2 * measured[i + 2].illuminance_lx) << i;
    }
}
