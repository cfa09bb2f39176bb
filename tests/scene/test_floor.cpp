// What the lighting engineers' rule is given, on rooms whose floor is known.
#include "core/scene/floor.h"
#include "scene_fixture.h"

namespace lueur {
namespace {

class Floor : public SceneTest {
protected:
    FloorFacts facts_of(const std::string& text) const {
        write("s.toml", text);
        return floor_facts(load("s.toml").scene);
    }
};

TEST_F(Floor, OfASquareUnderALamp) {
    const FloorFacts facts = facts_of(small_scene);
    EXPECT_NEAR(facts.luminous_flux, 3000, 1e-6);
    EXPECT_NEAR(facts.floor_area, 1, 1e-6);
    EXPECT_NEAR(facts.mean_reflectance, 0.5, 1e-6);
}

// A carpet that lies on it counts, a table and what hangs upside down do not; lamps have no part in the mean
// reflectance.
TEST_F(Floor, IsAtTheBottom) {
    const FloorFacts facts = facts_of(small_scene + R"(
[[polygon]]
name = "carpet"
material = "dark"
vertices = [[2, 0.02, 0], [2, 0.02, 1], [4, 0.02, 1], [4, 0.02, 0]]
[[polygon]]
name = "table"
material = "dark"
vertices = [[2, 0.7, 0], [2, 0.7, 1], [3, 0.7, 1], [3, 0.7, 0]]
[[polygon]]
name = "ceiling"
material = "grey"
vertices = [[0, 2.5, 0], [4, 2.5, 0], [4, 2.5, 1], [0, 2.5, 1]]
[[material]]
name = "dark"
reflectance = 0.1
)");
    EXPECT_NEAR(facts.floor_area, 3, 1e-5);
    EXPECT_NEAR(facts.mean_reflectance, (1 * 0.5 + 3 * 0.1 + 4 * 0.5) / 8, 1e-5);
}

TEST_F(Floor, WithoutOneIsThePlanOfTheScene) {
    std::string wall = small_scene;
    const std::string floor = "vertices = [[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]]";
    wall.replace(wall.find(floor), floor.size(), "vertices = [[0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1]]");
    EXPECT_NEAR(facts_of(wall).floor_area, 2, 1e-5) << "2 m by 1 m: the lamp's outline";
}

TEST_F(Floor, DimmersCount) {
    const FloorFacts facts = facts_of(small_scene + "dimmer = 0.25\n");
    EXPECT_NEAR(facts.luminous_flux, 750, 1e-6);
}

TEST(FloorFacts, OfNothingAreNothing) {
    const FloorFacts facts = floor_facts(Scene{});
    EXPECT_EQ(facts.luminous_flux, 0);
    EXPECT_EQ(facts.floor_area, 0);
    EXPECT_EQ(facts.mean_reflectance, 0);
}

} // namespace
} // namespace lueur
