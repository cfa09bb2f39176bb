// Direct light of many luminaires, and of one in several pieces.
#include <cmath>

#include <gtest/gtest.h>

#include "core/transport/direct_light.h"
#include "core/transport/many_lights.h"
#include "core/transport/sampling.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

// Facing down.
std::vector<glm::vec3> panel(glm::vec3 middle, float half) {
    return {middle + glm::vec3(-half, 0, -half), middle + glm::vec3(half, 0, -half), middle + glm::vec3(half, 0, half),
            middle + glm::vec3(-half, 0, half)};
}

} // namespace

// One luminaire of two panels. The rays to its rim all miss where one panel is hidden and the other, small as seen from
// here, is not among the probes: each piece needs its own.
TEST(ManyLights, AHiddenPieceDoesNotDarkenTheOther) {
    test::SceneBuilder b;
    const MaterialIndex grey = b.material("grey", 0.5);
    std::vector<ObjectIndex> panels;
    for (int k = 0; k < 6; ++k)
        panels.push_back(b.polygon("panel " + std::to_string(k), grey, panel({2.0f * float(k) - 5, 3, 0}, 0.4f)));
    // Hides all panels but the third from the origin.
    const MaterialIndex card = b.material("card", 0.5, true);
    b.polygon("left card", card, {{-10, 1, -2}, {-0.55f, 1, -2}, {-0.55f, 1, 2}, {-10, 1, 2}});
    b.polygon("right card", card, {{0, 1, -2}, {10, 1, -2}, {10, 1, 2}, {0, 1, 2}});
    b.light("window", panels, PowerUnit::lumen, 1000);
    const World world(make_mesh(b.build(), {1.0}));
    const std::vector<Emitter> emitters = make_emitters(b.build());
    ASSERT_EQ(emitters.size(), 1u);
    EXPECT_EQ(emitters[0].parts.size(), 6u);
    const glm::vec3 up(0, 1, 0);
    const double seen = direct_form_factor_sampled(world, emitters[0], glm::vec3(0), up, 20000, {0.3f, 0.6f});
    ASSERT_GT(seen, 1e-3);
    float factor = 0, deviation = 0;
    const std::vector<float> exitances = guessed_exitances(emitters);
    direct_form_factors(world, emitters, exitances, glm::vec3(0), up, 1, &factor, &deviation);
    EXPECT_NEAR(factor / seen, 1, 0.05);
    std::uint64_t rays = 0;
    EXPECT_NEAR(direct_form_factor(world, emitters[0], glm::vec3(0), up, VisibilityDetail::two_cuts, rays) / seen, 1,
                0.05);
}

TEST(ManyLights, ABallDoesNotHideItself) {
    test::SceneBuilder b;
    const MaterialIndex grey = b.material("grey", 0.5);
    for (int k = 0; k < 12; ++k) {
        const glm::vec3 low(1.5f * float(k % 4), 3, 1.5f * float(k / 4));
        const std::string name = "box " + std::to_string(k);
        b.light(name, {b.block(name, grey, low, low + 0.3f)}, PowerUnit::lumen, 100);
    }
    const World world(make_mesh(b.build(), {1.0}));
    const std::vector<Emitter> emitters = make_emitters(b.build());
    const std::vector<float> exitances = guessed_exitances(emitters);
    std::vector<float> factors(emitters.size()), deviations(emitters.size());
    const glm::vec3 here(2.4f, 0, 1.4f), up(0, 1, 0);
    direct_form_factors(world, emitters, exitances, here, up, 0.01f, factors.data(), deviations.data());
    for (std::size_t l = 0; l < emitters.size(); ++l)
        EXPECT_NEAR(factors[l] / direct_form_factor_sampled(world, emitters[l], here, up, 4096, {0.2f, 0.9f}), 1, 0.03);
}

// 200 lamps over a floor with columns: far fewer rays than six a lamp, the light right to 2 %, and within what is
// stated.
TEST(ManyLights, FewRaysForManyLampsAndTheErrorIsStated) {
    test::SceneBuilder b;
    const MaterialIndex grey = b.material("grey", 0.5);
    for (int k = 0; k < 200; ++k)
        b.light("lamp " + std::to_string(k),
                {b.polygon("lamp " + std::to_string(k), grey,
                           panel({2.0f * float(k % 20), 4, 2.0f * float(k / 20)}, 0.15f))},
                PowerUnit::lumen, 1000);
    for (int k = 0; k < 12; ++k) {
        const glm::vec3 low(7.0f * float(k % 6) + 1, 0, 8.0f * float(k / 6) + 3);
        b.block("column " + std::to_string(k), grey, low, low + glm::vec3(0.8f, 3.5f, 0.8f));
    }
    const World world(make_mesh(b.build(), {2.0}));
    const std::vector<Emitter> emitters = make_emitters(b.build());
    const std::vector<float> exitances = guessed_exitances(emitters);
    std::vector<float> factors(emitters.size()), deviations(emitters.size());
    const glm::vec3 up(0, 1, 0);
    std::uint64_t rays = 0;
    double square = 0, stated = 0;
    const int places = 60;
    for (std::uint32_t k = 0; k < places; ++k) {
        const glm::vec2 u = r2_point(k, {0.5f, 0.5f});
        const glm::vec3 here(38 * u.x, 1e-3f, 18 * u.y);
        rays += direct_form_factors(world, emitters, exitances, here, up, 1, factors.data(), deviations.data());
        double sum = 0, truth = 0, variance = 0;
        for (std::size_t l = 0; l < emitters.size(); ++l) {
            sum += double(factors[l]);
            variance += double(deviations[l]) * double(deviations[l]);
            truth += double(direct_form_factor_sampled(world, emitters[l], here, up, 128, {0.4f, 0.8f}));
        }
        if (truth == 0) continue; // in a column
        square += (sum / truth - 1) * (sum / truth - 1) / places;
        stated += variance / (truth * truth) / places;
    }
    printf("200 lamps: %.0f rays a place, %.2f %% RMS, stated %.2f %%\n", double(rays) / places,
           100 * std::sqrt(square), 100 * std::sqrt(stated));
    EXPECT_LT(std::sqrt(square), 0.02);
    EXPECT_LT(square, 4 * stated);
    EXPECT_LT(double(rays) / places, 600);
}

// Lamps that lie 3 cm deep in housings: at most places a strip at the rim of each is hidden, and all probes and corners
// there with it. Light at 100 places of the floor against many rays: 5.1 % less of it, where the probes
// told how much of a faint lamp is seen and the corners of cells how much of a brighter one.
TEST(ManyLights, HousingsHideNoMoreThanTheyDo) {
    constexpr float half = 0.27f, depth = 0.03f, height = 2.8f;
    test::SceneBuilder b;
    const MaterialIndex grey = b.material("grey", 0.5), steel = b.material("steel", 0.5, true);
    for (int k = 0; k < 12; ++k) {
        const glm::vec3 at(3.0f * float(k % 4) - 4.5f, height, 3.0f * float(k / 4) - 3);
        const std::string name = "lamp " + std::to_string(k);
        b.light(name, {b.polygon(name, grey, panel(at, half))}, PowerUnit::lumen, 1000);
        const std::vector<glm::vec3> corners = panel(at, half + 0.001f);
        for (std::size_t side = 0; side < 4; ++side) {
            const glm::vec3 p = corners[side], q = corners[(side + 1) % 4], down(0, -depth, 0);
            b.polygon(name + " rim " + std::to_string(side), steel, {p, q, q + down, p + down});
        }
    }
    const World world(make_mesh(b.build(), {1.0}));
    const std::vector<Emitter> emitters = make_emitters(b.build());
    const std::vector<float> exitances = guessed_exitances(emitters);
    std::vector<float> factors(emitters.size()), deviations(emitters.size());
    double kept = 0, seen = 0;
    for (std::uint32_t i = 0; i < 100; ++i) {
        const glm::vec2 place = 12.0f * random_offset(3, i) - 6.0f;
        const glm::vec3 origin(place.x, 0, 0.75f * place.y), up(0, 1, 0);
        direct_form_factors(world, emitters, exitances, origin, up, 1, factors.data(), deviations.data());
        for (std::size_t l = 0; l < emitters.size(); ++l) {
            kept += double(factors[l]);
            seen += double(direct_form_factor_sampled(world, emitters[l], origin, up, 400, random_offset(5, i)));
        }
    }
    EXPECT_NEAR(kept / seen, 1, 0.015);
}
