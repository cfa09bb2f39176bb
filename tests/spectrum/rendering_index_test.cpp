// Colour rendering indices against the printed ones of CIE's illuminants and an independent computation.
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "core/spectrum/observer.h"
#include "core/spectrum/rendering_index.h"
#include "tests/spectrum/illuminants.h"

namespace lueur {
namespace {

TEST(ColourRendering, OfPublishedIlluminantsIsThePrintedOne) {
    struct Row {
        const char* name;
        int general;
    };
    for (const auto& [name, general] : {
             // CIE 15:2018, summed at 5 nm there. FL5 and FL6 lie further from their reference than CIE 13.3 allows.
             Row{"FL1", 76},
             Row{"FL2", 64},
             Row{"FL3", 57},
             Row{"FL4", 51},
             Row{"FL5", 72},
             Row{"FL6", 59},
             Row{"FL7", 90},
             Row{"FL8", 95},
             Row{"FL9", 90},
             Row{"FL10", 81},
             Row{"FL11", 83},
             Row{"FL12", 83},
         }) {
        const auto rendering = colour_rendering(line_spectrum(name));
        ASSERT_TRUE(rendering) << name;
        EXPECT_EQ(std::lround(rendering->general), general) << name << " " << rendering->general;
        EXPECT_EQ(within_reference(*rendering), name != std::string("FL5") && name != std::string("FL6")) << name;
    }
}

TEST(ColourRendering, OfFL1HasEverySpecialIndex) {
    // Unit tests of colour-science/colour (BSD-3-Clause).
    constexpr double special[] = {69.196992839933557,  83.650754065677816, 92.136090764490675, 72.665649420972784,
                                  73.890734513517486,  79.619188860052745, 82.272569853644669, 53.390643618905109,
                                  -47.284477750225903, 61.568336431199967, 67.522241168172485, 74.890093866757994,
                                  72.771930354944615,  94.884867470552663};
    const auto rendering = colour_rendering(linear_spectrum("FL1"));
    ASSERT_TRUE(rendering);
    EXPECT_NEAR(rendering->general, 75.852827992149358, 0.05);
    for (std::size_t i = 0; i < std::size(special); ++i)
        EXPECT_NEAR(rendering->special[i], special[i], i == 8 ? 0.3 : 0.1) << i + 1;
    EXPECT_NEAR(colour_rendering(linear_spectrum("FL2"))->general, 64.233724121664778, 0.05);
    EXPECT_NEAR(colour_rendering(linear_spectrum("A"))->general, 99.996230290506887, 0.05);
}

TEST(ColourRendering, OfAReferenceIsAHundred) {
    for (const double kelvin : {1500.0, 2700.0, 3000.0, 4900.0}) {
        const auto rendering = colour_rendering(blackbody(kelvin));
        ASSERT_TRUE(rendering) << kelvin;
        EXPECT_NEAR(rendering->temperature.kelvin, kelvin, 1e-3 * kelvin);
        for (const double r : rendering->special) EXPECT_NEAR(r, 100, 0.05) << kelvin;
        EXPECT_TRUE(within_reference(*rendering));
    }
    for (const double kelvin : {5100.0, 6504.0, 9300.0, 15000.0}) {
        const auto rendering = colour_rendering(daylight(kelvin));
        ASSERT_TRUE(rendering) << kelvin;
        EXPECT_NEAR(rendering->general, 100, 0.2) << kelvin; // the daylight formula's own temperature is a little off
        EXPECT_TRUE(within_reference(*rendering));
    }
}

TEST(ColourRendering, DoesNotDependOnTheScaleOrOnWhatIsUnseen) {
    Spectrum lamp = linear_spectrum("LED-B3");
    const auto before = colour_rendering(lamp);
    for (double& power : lamp.value) power *= 1e-6;
    lamp.nm.push_back(900);
    lamp.value.push_back(0);
    lamp.nm.push_back(1100);
    lamp.value.push_back(1e3); // infrared
    const auto after = colour_rendering(lamp);
    ASSERT_TRUE(before && after);
    EXPECT_NEAR(after->general, before->general, 1e-2);
}

TEST(ColourRendering, OfLampsThatHideColours) {
    // A sodium lamp of one narrow line shows no colour but its own; its indices are far below 0, and it lies too far
    // from the planckian locus for them to say much, or to be had at all.
    const Spectrum sodium{{588.9, 589, 589.1}, {0, 1, 0}};
    const auto low_pressure = colour_rendering(sodium);
    ASSERT_TRUE(low_pressure);
    EXPECT_LT(low_pressure->general, 0);
    EXPECT_FALSE(within_reference(*low_pressure));
    EXPECT_FALSE(colour_rendering(Spectrum{{529.9, 530, 530.1}, {0, 1, 0}})) << "green: no temperature";
    EXPECT_FALSE(colour_rendering(Spectrum{})) << "no light";
    EXPECT_FALSE(colour_rendering(Spectrum{{400, 700}, {0, 0}})) << "no light";
    const auto high_pressure = colour_rendering(linear_spectrum("HP1"));
    ASSERT_TRUE(high_pressure);
    EXPECT_LT(high_pressure->special[8], -150) << "R9 of high-pressure sodium";
}

TEST(TestColours, AreThePublishedOnes) {
    // CIE 13.3-1995, table 1 and 2, a few entries.
    EXPECT_EQ(value_at(test_colour_sample(1), 560, Outside::constant), 0.272);
    EXPECT_EQ(value_at(test_colour_sample(9), 640, Outside::constant), 0.717);
    EXPECT_EQ(value_at(test_colour_sample(14), 780, Outside::constant), 0.399);
    EXPECT_EQ(value_at(test_colour_sample(12), 300, Outside::constant), 0.120);
    for (int i = 1; i <= test_colour_count; ++i) EXPECT_EQ(test_colour_sample(i).nm.size(), 81u);
}

} // namespace
} // namespace lueur
