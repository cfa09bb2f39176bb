// Temperatures of white light: the planckian and daylight loci and the published illuminants.
#include <cmath>
#include <gtest/gtest.h>

#include "core/spectrum/colour_temperature.h"
#include "core/spectrum/observer.h"
#include "tests/spectrum/illuminants.h"

namespace lueur {
namespace {

TEST(ColourTemperature, OfABlackBodyIsItsOwn) {
    for (const double kelvin : {1000.5, 1500.0, 2000.0, 2856.0, 4000.0, 6504.0, 10000.0, 15000.0, 24990.0}) {
        const auto found = colour_temperature(planckian_xyz(kelvin));
        ASSERT_TRUE(found) << kelvin;
        EXPECT_NEAR(found->kelvin, kelvin, 1e-6 * kelvin);
        EXPECT_NEAR(found->duv, 0, 1e-8);
    }
}

// Steps away from the locus along its normal: the temperature stays, Duv is the step, its sign the side.
TEST(ColourTemperature, AndDuvOfAPointBesideTheLocus) {
    for (const double kelvin : {1500.0, 2700.0, 4000.0, 6500.0, 12000.0, 20000.0}) {
        const Uv1960 here = uv1960_from_xyz(planckian_xyz(kelvin));
        const Uv1960 hotter = uv1960_from_xyz(planckian_xyz(kelvin * 1.0001)),
                     colder = uv1960_from_xyz(planckian_xyz(kelvin * 0.9999));
        const double du = colder.u - hotter.u, dv = colder.v - hotter.v, length = std::hypot(du, dv);
        for (const double duv : {-0.02, -0.0054, -1e-4, 1e-4, 0.0054, 0.02}) {
            const Uv1960 beside{here.u - duv * dv / length, here.v + duv * du / length}; // positive: to higher v
            const auto found = colour_temperature(xyz_from_chromaticity(chromaticity_from_uv(beside), 70));
            ASSERT_TRUE(found) << kelvin << " " << duv;
            EXPECT_NEAR(found->kelvin, kelvin, 2e-6 * kelvin) << duv;
            EXPECT_NEAR(found->duv, duv, 1e-8);
        }
    }
}

TEST(ColourTemperature, OfPublishedIlluminantsIsThePrintedOne) {
    // CIE 15:2018, kelvin with c2 = 1.4388e-2 m K, as printed there: to 1 K for A, HP and LED, to 10 K for FL (of which
    // FL2 and FL7 are 5.5 and 5.2 K from the print, the others within its half digit), nominal for D.
    constexpr double kelvin_of_then = 1.4388e7 / second_radiation_constant;
    struct Row {
        const char* name;
        double kelvin, most;
    };
    for (const auto& [name, kelvin, most] : {
             Row{"A", 2856, 0.5},        Row{"D50", 5003, 2},      Row{"D55", 5503, 2},      Row{"D65", 6504, 2},
             Row{"D75", 7504, 2},        Row{"FL1", 6430, 5},      Row{"FL2", 4230, 6},      Row{"FL3", 3450, 5},
             Row{"FL4", 2940, 5},        Row{"FL5", 6350, 5},      Row{"FL6", 4150, 5},      Row{"FL7", 6500, 6},
             Row{"FL8", 5000, 5},        Row{"FL9", 4150, 5},      Row{"FL10", 5000, 5},     Row{"FL11", 4000, 5},
             Row{"FL12", 3000, 5},       Row{"HP1", 1959, 0.5},    Row{"HP2", 2506, 0.5},    Row{"HP3", 3144, 0.5},
             Row{"HP4", 4002, 0.5},      Row{"HP5", 4039, 0.5},    Row{"LED-B1", 2733, 0.5}, Row{"LED-B2", 2998, 0.5},
             Row{"LED-B3", 4103, 0.5},   Row{"LED-B4", 5109, 0.5}, Row{"LED-B5", 6598, 0.5}, Row{"LED-BH1", 2851, 0.5},
             Row{"LED-RGB1", 2840, 0.5}, Row{"LED-V1", 2724, 0.5}, Row{"LED-V2", 4070, 0.5},
         }) {
        const auto found = colour_temperature(xyz_from_spectrum(line_spectrum(name)));
        ASSERT_TRUE(found) << name;
        EXPECT_NEAR(found->kelvin * kelvin_of_then, kelvin, most) << name;
    }
}

TEST(ColourTemperature, IsNotGivenWhereItHasNoMeaning) {
    EXPECT_FALSE(colour_temperature(Xyz(0)));
    EXPECT_FALSE(colour_temperature(Xyz(NAN)));
    EXPECT_FALSE(colour_temperature(planckian_xyz(990)));
    EXPECT_FALSE(colour_temperature(planckian_xyz(25100)));
    EXPECT_FALSE(colour_temperature(observer_xyz(530))) << "a green line";
    EXPECT_FALSE(colour_temperature(observer_xyz(450))) << "a blue line";
    EXPECT_FALSE(colour_temperature(Xyz(-1, -1, -1)));
    const Uv1960 here = uv1960_from_xyz(planckian_xyz(5000));
    EXPECT_TRUE(colour_temperature(xyz_from_chromaticity(chromaticity_from_uv(Uv1960{here.u, here.v + 0.04}), 1)));
    EXPECT_FALSE(colour_temperature(xyz_from_chromaticity(chromaticity_from_uv(Uv1960{here.u, here.v + 0.07}), 1)));
}

TEST(Daylight, OfTheNamedTemperaturesIsThePublishedIlluminant) {
    // The tables are rounded, and D55 to D75 are made from S0, S1, S2 of 10 nm steps: equal to a few units of the last
    // digit. Nominal temperatures times 1.4388 / 1.4380 (CIE 15:2018).
    for (const auto& [name, nominal] : {std::pair{"D50", 5000.0}, {"D55", 5500.0}, {"D65", 6500.0}, {"D75", 7500.0}}) {
        const Spectrum published = linear_spectrum(name);
        const Spectrum made = daylight(nominal * 1.4388 / 1.4380);
        for (int i = 0; i < 81; ++i)
            EXPECT_NEAR(value_at(made, 380 + 5 * i, Outside::zero), published.value[static_cast<std::size_t>(i)], 0.06)
                << name << " " << i;
        EXPECT_EQ(value_at(made, 560, Outside::zero), 100);
        EXPECT_EQ(made.nm.front(), 300);
        EXPECT_EQ(made.nm.back(), 830);
    }
}

TEST(Daylight, LiesOnItsLocusAndIsHeldToItsRange) {
    for (const double kelvin : {4000.0, 5000.0, 6504.0, 7000.0, 10000.0, 25000.0}) {
        const Chromaticity wanted = daylight_chromaticity(kelvin);
        const Chromaticity made = chromaticity(xyz_from_spectrum(daylight(kelvin)));
        EXPECT_NEAR(made.x, wanted.x, 2e-4) << kelvin; // M1 and M2 have three decimals
        EXPECT_NEAR(made.y, wanted.y, 2e-4) << kelvin;
        for (const double power : daylight(kelvin).value) EXPECT_GE(power, 0);
    }
    EXPECT_NEAR(daylight_chromaticity(7000).x, daylight_chromaticity(7000.001).x, 1e-5) << "the two halves join";
    EXPECT_EQ(daylight(100), daylight(4000));
    EXPECT_EQ(daylight(1e9), daylight(25000));
}

} // namespace
} // namespace lueur
