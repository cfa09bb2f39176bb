// The visible share of a luminaire behind a straight edge is that of a clipped polygon: a closed form.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/transport/emitter_visibility.h"
#include "core/transport/planar_polygon.h"
#include "core/transport/polygon_form_factor.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

struct Penumbra {
    double error = 0, worst = 0, stated = 0, rays = 0; // RMS of the share's error, and what was said of it
    int places = 0;
};

// A square lamp of 1 m, turned about its axis, 2 m above the floor; a screen half way up covers x < 0.
Penumbra walk(VisibilityDetail detail, double turn) {
    std::vector<glm::vec3> corners;
    std::vector<glm::dvec3> exact_corners;
    for (int k = 0; k < 4; ++k) { // counter-clockwise seen from below
        const double angle = turn + k * M_PI / 2;
        exact_corners.push_back({std::sqrt(0.5) * std::cos(angle), 2, std::sqrt(0.5) * std::sin(angle)});
        corners.emplace_back(exact_corners.back());
    }
    test::SceneBuilder b;
    const ObjectIndex lamp = b.polygon("lamp", b.material("grey", 0.5), corners);
    b.polygon("screen", b.material("card", 0.5, true), {{-4, 1, -4}, {0, 1, -4}, {0, 1, 4}, {-4, 1, 4}});
    b.light("lamp", {lamp}, PowerUnit::lumen, 100);
    const Scene scene = b.build();
    const World world(make_mesh(scene, {2}));
    const Emitter emitter = make_emitters(scene)[0];
    const PlanarPolygon whole = make_planar_polygon(exact_corners).value();
    Penumbra penumbra;
    std::uint64_t rays = 0;
    for (double x = -0.695; x < 0.7; x += 0.01)
        for (const double z : {0.0, 0.7}) {
            const glm::dvec3 p(x, 0, z), up(0, 1, 0);
            // Seen is what lies beyond the plane through p and the screen's edge.
            const glm::dvec3 across = glm::normalize(glm::dvec3(1, x, 0));
            const PlanarPolygon seen = clipped(whole, across, glm::dot(across, p), 1e-9);
            const double share = seen.corners.empty() ? 0
                                                      : polygon_form_factor(p, up, seen.corners) /
                                                            polygon_form_factor(p, up, whole.corners);
            const VisibleShare found = visible_share(world, emitter, glm::vec3(p), glm::vec3(up), detail, rays);
            penumbra.error += (found.share - share) * (found.share - share);
            penumbra.worst = std::max(penumbra.worst, std::abs(found.share - share));
            penumbra.stated += found.deviation * found.deviation;
            ++penumbra.places;
        }
    penumbra.error = std::sqrt(penumbra.error / penumbra.places);
    penumbra.stated = std::sqrt(penumbra.stated / penumbra.places);
    penumbra.rays = double(rays) / penumbra.places;
    return penumbra;
}

} // namespace

TEST(Penumbra, EachCutTellsTheShareBetterAndSaysHowWell) {
    for (const double turn : {0.0, 0.4, 1.1}) {
        double before = 1;
        for (const auto& [detail, most] : {std::pair{VisibilityDetail::whole_cells, 0.06},
                                           {VisibilityDetail::one_cut, 0.03},
                                           {VisibilityDetail::two_cuts, 0.015}}) {
            const Penumbra p = walk(detail, turn);
            printf("turned %.1f, %d cuts: error %.4f RMS, %.4f at worst, said %.4f, %.0f rays\n", turn,
                   static_cast<int>(detail), p.error, p.worst, p.stated, p.rays);
            EXPECT_LT(p.error, most / 2);
            EXPECT_LT(p.worst, 2 * most);
            EXPECT_LT(p.error, 0.8 * before);
            EXPECT_GT(p.stated / p.error, 0.5);
            EXPECT_LT(p.stated / p.error, 2);
            EXPECT_LT(p.rays, 120);
            before = p.error;
        }
    }
}

// A spot's lens 75 mm up in a square housing, seen from the floor ever more from the side: what is seen is the lens
// clipped by the mouth, at last a sliver along its far corner. None is missed, and the shares are right.
TEST(Penumbra, SeesTheLastSliverOfALampInAHousing) {
    constexpr float half = 0.041f, mouth = 2, top = 2.075f; // m
    const std::array<glm::vec2, 4> square{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
    test::SceneBuilder b;
    const MaterialIndex metal = b.material("metal", 0.03, true);
    std::vector<glm::vec3> lens, rim;
    for (const glm::vec2 c : square) lens.emplace_back(c.x, top, c.y), rim.emplace_back(c.x, mouth, c.y);
    const ObjectIndex lamp = b.polygon("lens", b.material("lens", 0.5), lens);
    for (std::size_t k = 0; k < 4; ++k)
        b.polygon("housing", metal, {rim[k], rim[(k + 1) % 4], lens[(k + 1) % 4], lens[k]});
    b.light("lens", {lamp}, PowerUnit::lumen, 2000);
    const Scene scene = b.build();
    const World world(make_mesh(scene, {2}));
    const Emitter emitter = make_emitters(scene)[0];
    const PlanarPolygon whole = make_planar_polygon({lens.begin(), lens.end()}).value();
    int slivers = 0, missed = 0, places = 0;
    double square_error = 0;
    std::uint64_t rays = 0;
    for (double x = 0.3; x < 2.2; x += 0.01)
        for (const double z : {0.0, 0.37, 0.9}) {
            const glm::dvec3 p(x, 0, z), up(0, 1, 0), middle(0, mouth, 0);
            PlanarPolygon seen = whole;
            for (std::size_t k = 0; k < 4 && !seen.corners.empty(); ++k) {
                glm::dvec3 across =
                    glm::normalize(glm::cross(glm::dvec3(rim[k]) - p, glm::dvec3(rim[(k + 1) % 4]) - p));
                if (glm::dot(across, middle - p) < 0) across = -across;
                seen = clipped(seen, across, glm::dot(across, p), 1e-9);
            }
            const double all = polygon_form_factor(p, up, whole.corners),
                         share = seen.corners.empty() ? 0 : polygon_form_factor(p, up, seen.corners) / all;
            const double found = double(direct_form_factor(world, emitter, glm::vec3(p), glm::vec3(up),
                                                           VisibilityDetail::two_cuts, rays)) /
                                 all;
            slivers += share > 0.02 && share < 0.1;
            missed += share > 0.02 && found == 0;
            square_error += (found - share) * (found - share);
            ++places;
        }
    printf("%d slivers, %d missed, error of the share %.4f RMS\n", slivers, missed, std::sqrt(square_error / places));
    EXPECT_GT(slivers, 30);
    EXPECT_EQ(missed, 0);
    EXPECT_LT(std::sqrt(square_error / places), 0.012);
}
