// MAXDISPLAY by each of its rules.
#include "core/display/max_display.h"

#include <gtest/gtest.h>
#include <limits>

#include "core/display/display.h"

namespace lueur {
namespace {

// 10,000 lm on 50 m^2 that reflect a half: L_ref = 0.5 * 10000 / (pi 50) = 31.830989 cd m^-2. Equal energy of that
// luminance has R = 3.2409699 - 1.5373832 - 0.4986108 = 1.2049760 times as much in sRGB, the largest of the three
// (corrections 17: 1.205, 0.948, 0.909), so MAXDISPLAY = 2 * 1.2049760 * 31.830989 = 76.71116: the factor 2 once
// (corrections 18).
TEST(LectureMaxDisplay, IsTheLightingEngineersRule) {
    EXPECT_NEAR(lecture_max_display(10000, 50, 0.5, srgb), 76.71116, 1e-4);
    EXPECT_NEAR(lecture_max_display(20000, 50, 0.5, srgb), 2 * lecture_max_display(10000, 50, 0.5, srgb), 1e-9);
    EXPECT_NEAR(lecture_max_display(10000, 25, 0.25, srgb), lecture_max_display(10000, 50, 0.5, srgb), 1e-9);
}

TEST(LectureMaxDisplay, OnADisplayWithWhiteOfEqualEnergyIsTwiceTheLuminance) {
    RgbSpace space = rec2020;
    space.white = {1.0 / 3, 1.0 / 3};
    EXPECT_NEAR(lecture_max_display(10000, 50, 0.5, space), 2 * 31.830989, 1e-5);
}

TEST(LectureMaxDisplay, WithoutLampsFloorOrReflectanceThereIsNone) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {0.0, -1.0, nan, infinity}) {
        EXPECT_EQ(lecture_max_display(bad, 50, 0.5, srgb), 0) << bad;
        EXPECT_EQ(lecture_max_display(1000, bad, 0.5, srgb), 0) << bad;
        EXPECT_EQ(lecture_max_display(1000, 50, bad, srgb), 0) << bad;
    }
}

TEST(GeometricMean, IgnoresWhatIsNoLight) {
    EXPECT_NEAR(geometric_mean_luminance({1, 100, 0, -5, std::numeric_limits<float>::quiet_NaN()}), 10, 1e-9);
    EXPECT_EQ(geometric_mean_luminance({}), 0);
    EXPECT_EQ(geometric_mean_luminance({0, 0}), 0);
}

TEST(Resolved, EachRuleChoosesItsNumber) {
    const std::vector<float> luminances{1, 10, 100, 1000};
    DisplaySettings settings;
    settings.max_display = 42;
    settings.max_display_rule = MaxDisplayRule::by_hand;
    EXPECT_EQ(resolved(settings, luminances, 77).max_display, 42);
    settings.max_display_rule = MaxDisplayRule::lecture;
    EXPECT_EQ(resolved(settings, luminances, 77).max_display, 77);
    EXPECT_EQ(resolved(settings, luminances, 0).max_display, 42) << "nothing to go by";
    settings.max_display_rule = MaxDisplayRule::percentile;
    settings.percentile = 50;
    EXPECT_NEAR(resolved(settings, luminances, 77).max_display, 11, 1e-5);
    settings.percentile = 100;
    EXPECT_NEAR(resolved(settings, luminances, 77).max_display, 1100, 1e-3);
    EXPECT_NEAR(resolved(settings, luminances, 77).adaptation_luminance, 31.6228, 1e-4);
    EXPECT_EQ(resolved(settings, {0, 0}, 77).max_display, 42);
    settings.adaptation_automatic = false;
    settings.adaptation_luminance = 3;
    EXPECT_EQ(resolved(settings, luminances, 77).adaptation_luminance, 3);
}

TEST(Resolved, StaysWithinWhatIsAllowed) {
    DisplaySettings settings;
    for (const float extreme : {1e-38f, 3e38f})
        EXPECT_TRUE(check(resolved(settings, {extreme, extreme}, 0)).empty()) << extreme;
}

} // namespace
} // namespace lueur
