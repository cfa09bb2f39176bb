// The pictures on the way: none of them is darker than the light that was there before by more than what is being found
// out.
#include <gtest/gtest.h>

#include "core/solve/solution_state.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

double mean_illuminance(const Field& field) {
    double sum = 0;
    for (const glm::vec3& h : field.irradiance_xyz) sum += h.y / double(field.irradiance_xyz.size());
    return sum;
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
