// Sums of what each luminaire does alone: the same light as a solve of all together.
#include <algorithm>

#include <gtest/gtest.h>

#include "core/solve/light_bases.h"
#include "core/solve/solution_state.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

void prepare(Solution& solution) {
    while (solution.prepare_edits(test::never)) {
    }
}

} // namespace

TEST(LightBases, DimmersAndSpectraNeedNoSweep) {
    Scene scene = test::small_room();
    scene.solve.wavelengths = {WavelengthRule::uniform, 31}; // of their own, another spectrum may ask for others
    Solution solution = test::solved(scene);
    prepare(solution);
    EXPECT_EQ(solution.state().light_bases.count(), 2u);
    const std::uint64_t rays = solution.status().rays;
    const auto expect_as_fresh = [&](const char* what, bool without_sweep) {
        EXPECT_TRUE(solution.status().settled) << what;
        EXPECT_EQ(solution.status().sweeps == 0, without_sweep) << what;
        EXPECT_EQ(solution.status().rays, rays) << what;
        EXPECT_LT(test::field_difference(*solution.field(), *test::solved(scene).field()), 1e-3) << what;
    };
    scene.luminaires[0].dimmer = 0.2;
    scene.luminaires[1].spectrum = Blackbody{4000};
    test::edit(solution, scene, SolveFrom::sources);
    expect_as_fresh("one dimmed, one recoloured", true);
    scene.luminaires[0].dimmer = 0, scene.luminaires[1].dimmer = 1e-4;
    test::edit(solution, scene, SolveFrom::sources);
    expect_as_fresh("next to nothing is left", true);
    scene.luminaires[0].dimmer = 1;
    test::edit(solution, scene, SolveFrom::sources);
    expect_as_fresh("on again", true);
    // Paints make them anew.
    scene.materials[0].reflectance = 0.5;
    test::edit(solution, scene, SolveFrom::reflectance);
    EXPECT_EQ(solution.state().light_bases.count(), 0u);
    expect_as_fresh("painted", false);
    prepare(solution);
    scene.luminaires[1].dimmer = 2;
    test::edit(solution, scene, SolveFrom::sources);
    expect_as_fresh("dimmed after painting", true);
}

// While there is a basis of one luminaire only, its edits start from the solution that settled; the other's sweep.
TEST(LightBases, OneOfManyIsEnoughForItsOwnEdits) {
    Scene scene = test::small_room();
    scene.solve.wavelengths = {WavelengthRule::uniform, 31}; // channels that both light
    Solution solution = test::solved(scene);
    scene.luminaires[1].dimmer = 0.9;
    test::edit(solution, scene, SolveFrom::sources); // from now on it comes first
    while (solution.state().light_bases.count() == 0) ASSERT_TRUE(solution.prepare_edits(test::never));
    scene.luminaires[1].dimmer = 0.3;
    test::edit(solution, scene, SolveFrom::sources);
    EXPECT_EQ(solution.status().sweeps, 0u);
    EXPECT_LT(test::field_difference(*solution.field(), *test::solved(scene).field()), 1e-3);
    scene.luminaires[0].dimmer = 0.4;
    test::edit(solution, scene, SolveFrom::sources);
    EXPECT_GT(solution.status().sweeps, 0u);
    EXPECT_LT(test::field_difference(*solution.field(), *test::solved(scene).field()), 1e-3);
}

TEST(LightBases, KeepWithinTheirMemoryAndTheLatestEditFirst) {
    const LightBasesRoom room{100, 8, 5, 3 * 8 * sizeof(float) * 100 * 2};
    const auto basis = [](float value) {
        LightSolution b{ChannelField(100, 8), ChannelField(101, 8), ChannelField(100, 8)};
        std::fill(b.gathered.values.begin(), b.gathered.values.end(), value);
        return b;
    };
    LightBases bases;
    bases.keep_for(room, {{0.5}});
    bases.want(3), bases.want(1), bases.want(3);
    EXPECT_EQ(bases.next(), 3u);
    bases.add(3, basis(1));
    EXPECT_EQ(bases.next(), 1u);
    bases.add(1, basis(10));
    EXPECT_FALSE(bases.next()) << "two are all that fit";
    EXPECT_LE(bases.bytes(), room.most_bytes + 2 * 8 * sizeof(float)); // but for the rows of the outside

    const std::vector<double> dark(8, 0), one(8, 1), two(8, 2);
    EXPECT_FALSE(bases.sum({one, one, one, one, one})) << "of three nothing is known";
    const auto sum = bases.sum({dark, two, dark, one, dark});
    ASSERT_TRUE(sum);
    EXPECT_EQ(sum->gathered[7][3], 21);
    bases.set_reference({one, one, one, one, one}, basis(100));
    const auto from_reference = bases.sum({one, two, one, dark, one});
    ASSERT_TRUE(from_reference);
    EXPECT_EQ(from_reference->gathered[7][3], 100 + 10 - 1);
    EXPECT_FALSE(bases.sum({two, two, one, dark, one}));

    bases.keep_for(room, {{0.6}}); // another paint
    EXPECT_EQ(bases.count(), 0u);
    EXPECT_FALSE(bases.sum({dark, two, dark, one, dark}));
    bases.give_up(1);
    EXPECT_EQ(bases.next(), 3u);
}

// A slider that is dragged: what has changed is added to the latest sum, and no rounding is left of what was bright.
TEST(LightBases, DraggingASliderEndsWhereItsPlaceLeads) {
    constexpr std::size_t luminaires = 6;
    const auto filled_with = [](float value) {
        LightSolution b{ChannelField(100, 8), ChannelField(101, 8), ChannelField(100, 8)};
        std::ranges::fill(b.gathered.values, value);
        std::ranges::fill(b.arriving.values, 2 * value);
        return b;
    };
    LightBases dragged, fresh;
    for (LightBases* bases : {&dragged, &fresh}) {
        bases->keep_for({100, 8, luminaires}, {{0.5}});
        for (std::size_t l = 0; l < luminaires; ++l) bases->add(l, filled_with(0.1f * float(l + 1)));
    }
    Exitances exitance(luminaires, std::vector<double>(8, 1));
    ASSERT_TRUE(dragged.sum(exitance));
    for (int step = 0; step < 300; ++step) { // one after the other down to nothing, and on again but the last ones
        const std::size_t l = std::size_t(step / 50);
        const double place = 1 - step % 50 / 49.0;
        std::ranges::fill(exitance[l], step % 50 == 49 && l < 4 ? 1e-6 : 1e4 * place);
        const auto sum = dragged.sum(exitance);
        ASSERT_TRUE(sum);
        if (step % 7 != 0 && step != 299) continue;
        LightBases other = fresh;
        const auto expected = other.sum(exitance);
        ASSERT_NEAR(sum->gathered[99][7] / expected->gathered[99][7], 1, 1e-4) << step;
        ASSERT_NEAR(sum->arriving[99][7] / expected->arriving[99][7], 1, 1e-4) << step;
    }
    EXPECT_GT(dragged.sum(exitance)->gathered[0][0], 0);
    EXPECT_LT(dragged.sum(exitance)->gathered[0][0], 1e-5);
}
