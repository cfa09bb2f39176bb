#include "ui/navigation.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/view/picture.h"

namespace lueur {
namespace {

constexpr double aspect = 1.5;

// Where a point is in the picture, in shares of its height, x to the right, y down.
glm::dvec2 place_of(const Camera& camera, const glm::dvec3& point) {
    const auto clip = clip_from_world(camera, aspect, 0.01, 100) * glm::dvec4(point, 1);
    return {0.5 * aspect * clip.x / clip.w, -0.5 * clip.y / clip.w};
}

Camera some_camera(bool mirrored) {
    Camera camera;
    camera.position = {1, 2, 5};
    camera.target = {0.3, 1, -0.5};
    camera.mirrored = mirrored;
    return camera;
}

class BothHands : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Navigation, BothHands, testing::Bool(),
                         [](const auto& hand) { return hand.param ? "mirrored" : "plain"; });

TEST_P(BothHands, PanningKeepsTheTargetUnderTheHand) {
    const auto before = some_camera(GetParam());
    const glm::dvec2 hand(0.2, -0.1);
    const auto after = panned(before, hand);
    // The point that was the target has moved by as much as the hand.
    const auto moved = place_of(after, before.target) - place_of(before, before.target);
    EXPECT_NEAR(moved.x, hand.x, 1e-9);
    EXPECT_NEAR(moved.y, hand.y, 1e-9);
    EXPECT_NEAR(glm::length(after.target - after.position), glm::length(before.target - before.position), 1e-12);
}

TEST_P(BothHands, LookingAroundTurnsTheHeadWithTheHand) {
    const auto before = some_camera(GetParam());
    const auto after = looked_around(before, {0.05, 0.03});
    // The hand drags the view: looking further right moves what was ahead to the left, looking down moves it up.
    const auto moved = place_of(after, before.target);
    EXPECT_LT(moved.x, 0);
    EXPECT_LT(moved.y, 0);
    EXPECT_EQ(after.position, before.position);
}

TEST_P(BothHands, OrbitTurnsTheNearSideWithTheHand) {
    const auto before = some_camera(GetParam());
    const auto ahead = glm::normalize(before.target - before.position);
    const auto near_side = before.target - 0.5 * ahead;
    const auto after = orbited(before, {0.05, 0});
    EXPECT_GT(place_of(after, near_side).x, 0) << "a thing in front of the target follows a hand that goes right";
    const auto down = orbited(before, {0, 0.05});
    EXPECT_GT(place_of(down, near_side).y, 0);
    EXPECT_NEAR(glm::length(after.target - after.position), glm::length(before.target - before.position), 1e-9);
}

TEST_P(BothHands, FlyingRightMovesThingsLeft) {
    const auto before = some_camera(GetParam());
    EXPECT_LT(place_of(flown(before, {0.5, 0, 0}), before.target).x, 0);
    EXPECT_GT(place_of(flown(before, {0, 0.5, 0}), before.target).y, 0);
    const auto ahead = flown(before, {0, 0, 0.5});
    EXPECT_NEAR(glm::length(ahead.position - before.position), 0.5, 1e-12);
    EXPECT_NEAR(place_of(ahead, before.target).x, 0, 1e-9);
}

TEST_P(BothHands, FramedThingFillsThePictureAndFits) {
    const auto before = some_camera(GetParam());
    Bounds bounds;
    bounds.include({4, 0, 4});
    bounds.include({6, 3, 5});
    const auto after = framed(before, bounds, aspect);
    double furthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point(corner & 1 ? bounds.high.x : bounds.low.x, corner & 2 ? bounds.high.y : bounds.low.y,
                               corner & 4 ? bounds.high.z : bounds.low.z);
        const auto place = glm::abs(place_of(after, point));
        EXPECT_LE(place.x, 0.5 * aspect);
        EXPECT_LE(place.y, 0.5);
        furthest = std::max({furthest, place.y, place.x / aspect});
    }
    EXPECT_GT(furthest, 0.3);
}

TEST(Navigation, NoSeriesOfMovementsMakesACameraThatSeesNothing) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1.5, 1.5);
    for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, 1)}) {
        Camera camera;
        camera.up = up;
        camera.position = camera.target; // the worst start: no direction at all
        for (int i = 0; i < 2000; ++i) {
            switch (i % 5) {
            case 0:
                camera = orbited(camera, {any(random), any(random)});
                break;
            case 1:
                camera = panned(camera, {any(random), any(random)});
                break;
            case 2:
                camera = dollied(camera, 20 * any(random), 10);
                break;
            case 3:
                camera = looked_around(camera, {any(random), any(random)});
                break;
            case 4:
                camera = flown(camera, {any(random), any(random), any(random)});
                break;
            }
            // Far away it ends up by chance; back home, so that what is tested is directions and not the range of
            // doubles.
            if (glm::length(camera.position) > 1e6)
                camera = framed(camera, Bounds{{-1, -1, -1}, {1, 1, 1}, false}, aspect);
            const auto direction = camera.target - camera.position;
            ASSERT_TRUE(std::isfinite(direction.x + direction.y + direction.z)) << i;
            ASSERT_GT(glm::length(direction), 0) << i;
        }
    }
}

TEST(Navigation, DepthRangeHoldsAllInFront) {
    Bounds bounds;
    bounds.include({-2, 0, -3});
    bounds.include({2, 2.5, 3});
    for (const double z : {0.0, 2.0, 10.0, 1000.0}) {
        Camera camera;
        camera.position = {0, 1.2, z};
        camera.target = {0, 1.2, z - 1};
        const auto range = depth_range(camera, bounds);
        EXPECT_GT(range.near_plane, 0);
        EXPECT_GT(range.far_plane, z + 3);
        if (z > 4) {
            EXPECT_LT(range.near_plane, z - 3);
        }
    }
}

} // namespace
} // namespace lueur
