// CIELAB, CIELUV and the uniform chromaticity scales against published and independently computed values.
#include <gtest/gtest.h>

#include "core/spectrum/chromatic_adaptation.h"
#include "core/spectrum/cielab.h"
#include "core/spectrum/cieluv.h"

namespace lueur {
namespace {

struct Case {
    Xyz xyz, white;
    Lab lab;
    Luv luv;
};

// The first five from the unit tests of colour-science/colour (BSD-3-Clause), eight digits; the others computed from
// CIE's definition with its linear branch.
const Xyz d65 = xyz_from_chromaticity({0.3127, 0.3290}, 1), a = xyz_from_chromaticity({0.44757, 0.40745}, 1),
          d50 = xyz_from_chromaticity({0.3457, 0.3585}, 1), d65_printed(0.95047, 1.0, 1.08883);
const Case cases[] = {
    {{0.20654008, 0.12197225, 0.05136952},
     d65,
     {41.52787529, 52.63858304, 26.92317922},
     {41.52787529, 96.83626054, 17.75210149}},
    {{0.1422201, 0.23042768, 0.10495772},
     d65,
     {55.11636304, -41.08791787, 30.91825778},
     {55.11636304, -37.59308176, 44.13768458}},
    {{0.0781878, 0.06157201, 0.28099326},
     d65,
     {29.8056552, 20.01830466, -48.34913874},
     {29.8056552, -10.96316802, -65.0675186}},
    {{0.20654008, 0.12197225, 0.05136952},
     a,
     {41.52787529, 38.48089305, -5.73295122},
     {41.52787529, 65.4518094, -12.46626977}},
    {{0.20654008, 0.12197225, 0.05136952},
     d50,
     {41.52787529, 51.19354174, 19.91843098},
     {41.52787529, 90.70925962, 7.08455273}},
    {{0.005, 0.005, 0.005},
     d65_printed,
     {4.516481481481481, 1.0144769020706685, 0.6352897146478298},
     {4.516481481481482, 0.7448779197892723, 0.31399843296316277}},
    {{0.0089, 0.0089, 0.0097},
     d65_printed,
     {8.03927273748743, 1.769483963219215, -0.013415580986037012},
     {8.03927273748743, 1.0179693037590007, -0.13386853464057896}},
    {{0.001, 0.002, 0.003},
     d65_printed,
     {1.8065925925925939, -3.690623138104379, -1.1762335786187073},
     {1.8065925925925927, -2.2978371361778582, -0.4306409776919258}},
    {d65_printed, d65_printed, {100, 0, 0}, {100, 0, 0}},
    {{0, 0, 0}, d65_printed, {0, 0, 0}, {0, 0, 0}},
};

TEST(Cielab, HasThePublishedValuesAndComesBack) {
    for (const Case& c : cases) {
        const Lab lab = lab_from_xyz(c.xyz, c.white);
        EXPECT_NEAR(lab.L, c.lab.L, 6e-9);
        EXPECT_NEAR(lab.a, c.lab.a, 6e-9);
        EXPECT_NEAR(lab.b, c.lab.b, 6e-9);
        EXPECT_NEAR(glm::distance(xyz_from_lab(lab, c.white), c.xyz), 0, 1e-15);
        EXPECT_EQ(lab_from_xyz(c.xyz * 250.0, c.white * 250.0).L, lab.L) << "only the ratio to white counts";
    }
}

TEST(Cieluv, HasThePublishedValuesAndComesBack) {
    for (const Case& c : cases) {
        const Luv luv = luv_from_xyz(c.xyz, c.white);
        EXPECT_NEAR(luv.L, c.luv.L, 6e-9);
        EXPECT_NEAR(luv.u, c.luv.u, 6e-9);
        EXPECT_NEAR(luv.v, c.luv.v, 6e-9);
        EXPECT_NEAR(glm::distance(xyz_from_luv(luv, c.white), c.xyz), 0, 1e-14);
    }
}

TEST(Lightness, FollowsCieAndNotTheSlide) {
    // Corrections 13 and 14: 166 sqrt(1) - 16 would be 150; exponent 0.33 is 0.43 off at 0.05; the two branches join.
    EXPECT_EQ(lightness(1), 100);
    EXPECT_NEAR(lightness(0.2), 51.837211526538496, 1e-12);
    EXPECT_EQ(lightness(0), 0);
    constexpr double join = 216.0 / 24389.0;
    EXPECT_NEAR(lightness(join), 8, 1e-13);
    EXPECT_NEAR(lightness(join * (1 + 1e-12)), lightness(join), 1e-10);
    for (const double y : {0.0, 1e-4, join, 0.01, 0.18, 0.5, 1.0, 3.0})
        EXPECT_NEAR(relative_luminance(lightness(y)), y, 1e-15);
}

TEST(Uv, IsThatOfTheWhitesAndComesBack) {
    const Uv1976 uv = uv1976_from_chromaticity({0.3127, 0.3290}); // u' = 4x / (-2x + 12y + 3), v' = 9y / (the same)
    EXPECT_NEAR(uv.u, 4 * 0.3127 / (-2 * 0.3127 + 12 * 0.3290 + 3), 1e-15);
    EXPECT_NEAR(uv.v, 9 * 0.3290 / (-2 * 0.3127 + 12 * 0.3290 + 3), 1e-15);
    const Uv1960 old = uv1960_from_chromaticity({1.0 / 3, 1.0 / 3}); // equal energy
    EXPECT_NEAR(old.u, 4.0 / 19, 1e-15);
    EXPECT_NEAR(old.v, 6.0 / 19, 1e-15);
    for (const Chromaticity& xy : {Chromaticity{0.3127, 0.3290}, {0.64, 0.33}, {0.15, 0.06}, {0.1, 0.8}}) {
        const Chromaticity back = chromaticity_from_uv(uv1976_from_chromaticity(xy));
        const Chromaticity back_1960 = chromaticity_from_uv(uv1960_from_chromaticity(xy));
        EXPECT_NEAR(back.x, xy.x, 1e-15);
        EXPECT_NEAR(back.y, xy.y, 1e-15);
        EXPECT_NEAR(back_1960.x, xy.x, 1e-15);
        EXPECT_NEAR(back_1960.y, xy.y, 1e-15);
    }
    EXPECT_EQ(uv1976_from_xyz(Xyz(0)), Uv1976{});
}

TEST(Bradford, FromD65ToD50IsThePublishedMatrix) {
    // ICC.1:2010 and B. Lindbloom print the matrix from D65 (0.95047, 1, 1.08883) to D50 (0.96422, 1, 0.82521).
    const Xyz from(0.95047, 1, 1.08883), to(0.96422, 1, 0.82521);
    const glm::dmat3 adapt = bradford_adaptation(from, to);
    const double printed[3][3] = {
        {1.0478112, 0.0228866, -0.0501270}, {0.0295424, 0.9904844, -0.0170491}, {-0.0092345, 0.0150436, 0.7521316}};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            EXPECT_NEAR(adapt[column][row], printed[row][column], 6e-8) << row << column;
    EXPECT_NEAR(glm::distance(adapt * from, to), 0, 1e-15);
    const Xyz colour(0.2, 0.3, 0.1);
    EXPECT_NEAR(glm::distance(bradford_adaptation(to, from) * (adapt * colour), colour), 0, 1e-15);
}

} // namespace
} // namespace lueur
