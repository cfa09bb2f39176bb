// Scales, legends and contours.
#include "core/display/false_colour.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "core/display/display.h"
#include "core/display/legend.h"

namespace lueur {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

FalseColourSettings scale(double low, double high, bool logarithmic = true) {
    FalseColourSettings settings;
    settings.automatic = false;
    settings.low = low;
    settings.high = high;
    settings.logarithmic = logarithmic;
    return settings;
}

TEST(FalseColour, PlacesValuesOnItsScale) {
    EXPECT_NEAR(place_on_scale(scale(10, 1000), 100), 0.5, 1e-12);
    EXPECT_NEAR(place_on_scale(scale(10, 1000, false), 505), 0.5, 1e-12);
    for (const bool logarithmic : {true, false}) {
        EXPECT_EQ(place_on_scale(scale(10, 1000, logarithmic), 1e9), 1);
        for (const double low : {0.0, -5.0, 1e-30, std::nan("")})
            EXPECT_EQ(place_on_scale(scale(10, 1000, logarithmic), low), 0) << low;
    }
}

TEST(FalseColour, GoesFromDarkVioletToYellowAndGetsLighter) {
    EXPECT_LT(false_colour(0).g, 0.02f);
    EXPECT_GT(false_colour(1).r, 0.9f);
    double before = -1;
    for (int i = 0; i <= 100; ++i) {
        const glm::vec3 c = false_colour(i / 100.0);
        const double luma = glm::dot(glm::dvec3(c), glm::dvec3(0.2126, 0.7152, 0.0722));
        EXPECT_GT(luma, before) << i;
        before = luma;
    }
    EXPECT_EQ(false_colour(std::nan("")), false_colour(0));
    EXPECT_EQ(false_colour(7), false_colour(1));
}

TEST(FalseColour, LegendHasRoundNumbers) {
    EXPECT_THAT(scale_ticks(scale(10, 1000)), ElementsAre(10, 20, 50, 100, 200, 500, 1000));
    EXPECT_THAT(scale_ticks(scale(0.01, 1000)), ElementsAre(0.01, 0.1, 1, 10, 100, 1000));
    EXPECT_THAT(scale_ticks(scale(0, 100, false)), IsEmpty()) << "0 is no end of a scale";
    EXPECT_THAT(scale_ticks(scale(1, 500, false)), ElementsAre(50, 100, 150, 200, 250, 300, 350, 400, 450, 500));
    EXPECT_THAT(scale_ticks(scale(300, 400)).size(), ::testing::AllOf(::testing::Ge(3u), ::testing::Le(11u)))
        << "less than a decade has ticks too";
    for (const bool logarithmic : {true, false})
        for (const auto& [low, high] : {std::pair(1e-6, 1e12), std::pair(1.0, 1.5), std::pair(7.0, 9000.0)}) {
            const auto ticks = scale_ticks(scale(low, high, logarithmic));
            EXPECT_GE(ticks.size(), 2u) << low << " " << high;
            EXPECT_LE(ticks.size(), 11u) << low << " " << high;
            for (const double tick : ticks) EXPECT_TRUE(tick >= low * 0.999 && tick <= high * 1.001) << tick;
        }
}

TEST(FalseColour, RangeOfItsOwnIsRoundAndAroundTheValues) {
    FalseColourSettings settings;
    std::vector<float> values;
    for (int i = 0; i <= 1000; ++i) values.push_back(12.0f + 0.7f * static_cast<float>(i)); // 12..712
    settings = fitted(settings, values);
    EXPECT_EQ(settings.low, 20);
    EXPECT_EQ(settings.high, 1000);
    // Weights count: nearly all of the area is at 12..20.
    std::vector<float> weights(values.size(), 1e-6f);
    for (std::size_t i = 0; i < 10; ++i) weights[i] = 1;
    EXPECT_EQ(fitted(settings, values, weights).high, 20);
    EXPECT_EQ(fitted(settings, values, weights).low, 10);
    values.assign(1000, 0.0f);
    values.push_back(-4);
    values.push_back(std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(fitted(settings, values), settings) << "nothing to go by";
    for (const float extreme : {1e-30f, 3e38f}) {
        const auto odd = fitted(settings, std::vector<float>(3, extreme));
        DisplaySettings display;
        display.illuminance_scale = odd;
        EXPECT_TRUE(check(display).empty()) << extreme << " " << odd.low << " " << odd.high;
    }
    EXPECT_EQ(fitted(scale(3, 7), std::vector<float>{100, 200}), scale(3, 7)) << "by hand";
}

// A quantity that rises by 2 a pixel crosses 100 at x = 50: a line of its width there and nowhere else.
TEST(Isolines, RunWhereTheLevelIs) {
    RadianceImage image{101, 3, {}};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 101; ++x) image.xyz.push_back(glm::vec3(0, 2.0f * static_cast<float>(x) + 0.01f, 0));
    FalseColourSettings settings = scale(1, 200, false);
    settings.isolines = false;
    const auto plain = false_colour_image(image, settings);
    settings.isolines = true;
    settings.levels = {100};
    const auto lined = false_colour_image(image, settings);
    for (std::size_t x = 0; x < 101; ++x) {
        if (x == 50) {
            EXPECT_NE(lined.rgb[101 + x], plain.rgb[101 + x]);
        } else if (x < 49 || x > 51) {
            EXPECT_EQ(lined.rgb[101 + x], plain.rgb[101 + x]) << x;
        }
    }
}

TEST(Isolines, EdgesOfObjectsAreNone) {
    RadianceImage image{40, 1, {}}; // two even surfaces side by side, 50 and 500
    for (int x = 0; x < 40; ++x) image.xyz.push_back(glm::vec3(0, x < 20 ? 50.0f : 500.0f, 0));
    FalseColourSettings settings = scale(10, 1000);
    settings.levels = {100, 200};
    auto plain = settings;
    plain.isolines = false;
    EXPECT_EQ(false_colour_image(image, settings).rgb, false_colour_image(image, plain).rgb);
}

TEST(Legend, IsInTheCornerAndShowsTheWholeScale) {
    DisplayImage image{640, 480, std::vector<std::array<std::uint8_t, 3>>(640 * 480, {9, 9, 9})};
    const DisplayImage before = image;
    draw_legend(image, scale(10, 1000), "lx");
    std::size_t changed = 0;
    bool low = false, high = false, white = false;
    const auto code = [](double t) {
        const glm::vec3 c = glm::round(255.0f * false_colour(t));
        return std::array{static_cast<std::uint8_t>(c.r), static_cast<std::uint8_t>(c.g),
                          static_cast<std::uint8_t>(c.b)};
    };
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        if (image.rgb[i] == before.rgb[i]) continue;
        ++changed;
        EXPECT_TRUE(i / 640 > 400 && i % 640 < 320) << "the lower left corner";
        low = low || image.rgb[i] == code(2.5 / 260);
        high = high || image.rgb[i] == code(257.5 / 260);
        white = white || image.rgb[i] == std::array<std::uint8_t, 3>{229, 229, 229};
    }
    EXPECT_GT(changed, 5000u);
    EXPECT_TRUE(low);
    EXPECT_TRUE(high);
    EXPECT_TRUE(white);
    DisplayImage small{239, 480, std::vector<std::array<std::uint8_t, 3>>(239 * 480, {9, 9, 9})};
    const auto small_before = small.rgb;
    draw_legend(small, scale(10, 1000), "lx");
    EXPECT_EQ(small.rgb, small_before);
}

TEST(FalseColourImage, TakesBlackAndWhatIsNotFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const RadianceImage image{4, 1, {glm::vec3(0), glm::vec3(nan), glm::vec3(infinity), glm::vec3(-1)}};
    const auto shown = false_colour_image(image, scale(10, 1000));
    for (const auto& pixel : shown.rgb) EXPECT_EQ(pixel, shown.rgb[0]);
    EXPECT_EQ(deep_false_colour_image(image, scale(10, 1000)).rgb.size(), 4u);
}

} // namespace
} // namespace lueur
