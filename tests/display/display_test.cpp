// From radiance to code values: curves, clip rules on hand-worked colours, MAXDISPLAY.
#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "core/display/display.h"

namespace lueur {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const double nan = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

DisplaySettings settings(ClipRule clip, TransferCurve curve = TransferCurve::gamma, double gamma = 1,
                         double max_display = 1) {
    DisplaySettings s;
    s.clip = clip;
    s.curve = curve;
    s.gamma = gamma;
    s.max_display = max_display;
    return s;
}

glm::dvec3 shown(const Rgb& rgb, const DisplaySettings& s) {
    return display_pixel(xyz_from_rgb(srgb) * rgb, s);
}

void expect_rgb(const glm::dvec3& got, const Rgb& wanted) {
    EXPECT_LT(glm::distance(got, wanted), 1e-12) << got.r << " " << got.g << " " << got.b;
}

constexpr ClipRule all_rules[] = {ClipRule::clamp, ClipRule::keep_chromaticity, ClipRule::desaturate,
                                  ClipRule::scale_all};

TEST(Display, GammaIsAppliedAfterTheScaling) {
    for (const double gamma : {0.5, 1.0, 2.2, 3.0}) {
        for (const double max_display : {0.5, 100.0, 3e4}) {
            const DisplaySettings s = settings(ClipRule::clamp, TransferCurve::gamma, gamma, max_display);
            for (const double share : {0.0, 0.001, 0.25, 0.8, 1.0}) {
                const double expected = std::pow(share, 1 / gamma);
                EXPECT_LT(glm::distance(shown(Rgb(share * max_display), s), glm::dvec3(expected)), 1e-12);
            }
        }
    }
}

TEST(Display, SrgbCurveIsTheStandards) {
    const DisplaySettings s = settings(ClipRule::clamp, TransferCurve::srgb, 2.2, 200);
    expect_rgb(shown(200.0 * Rgb(0.18, 0.001, 1), s), {0.46135612950044164, 0.01292, 1});
}

TEST(Display, IsMonotoneInLuminanceUnderEveryRuleAndCurve) {
    for (const ClipRule rule : all_rules) {
        for (const TransferCurve curve : {TransferCurve::gamma, TransferCurve::srgb}) {
            double before = -1;
            for (int i = 0; i <= 2000; ++i) {
                const double grey = shown(Rgb(i / 1000.0), settings(rule, curve, 2.2)).g;
                EXPECT_GE(grey, before - 1e-15) << to_string(rule);
                EXPECT_LE(grey, 1 + 1e-15);
                before = grey;
            }
        }
    }
}

TEST(Display, ColoursThatFitAreLeftAloneByEveryRule) {
    for (const ClipRule rule : all_rules) {
        expect_rgb(shown({0.3, 0.5, 0.7}, settings(rule)), {0.3, 0.5, 0.7});
        expect_rgb(shown({30, 50, 70}, settings(rule, TransferCurve::gamma, 1, 100)), {0.3, 0.5, 0.7});
        expect_rgb(shown({0, 0, 0}, settings(rule)), {0, 0, 0});
    }
}

TEST(Display, ClampCutsEachComponent) {
    expect_rgb(shown({2, 0.5, -0.25}, settings(ClipRule::clamp)), {1, 0.5, 0});
}

TEST(Display, KeepChromaticityScalesTheColour) {
    expect_rgb(shown({2, 0.5, 1}, settings(ClipRule::keep_chromaticity)), {1, 0.25, 0.5});
    expect_rgb(shown({2, 0.5, -0.25}, settings(ClipRule::keep_chromaticity)), {1, 0.25, 0});
    expect_rgb(shown({-1, -2, -3}, settings(ClipRule::keep_chromaticity)), {0, 0, 0});
}

TEST(Display, DesaturateKeepsLuminanceAndMixesWithGrey) {
    const glm::dvec3 luminance(0.21263900587151022, 0.715168678767756,
                               0.07219231536073371); // second row of the sRGB matrix
    // Red at 2: Y = 0.425278. Grey + t (colour - grey) reaches R = 1 at t = (1 - Y) / (2 - Y) = 0.364965; G = B = Y (1
    // - t) = 0.270066.
    const double y = 2 * luminance.r, t = (1 - y) / (2 - y);
    expect_rgb(shown({2, 0, 0}, settings(ClipRule::desaturate)), {1, y * (1 - t), y * (1 - t)});
    EXPECT_NEAR(y * (1 - t), 0.270066, 1e-6);
    // A negative component is lifted to 0 the same way.
    const Rgb outside(0.5, 0.5, -0.1);
    const double grey = glm::dot(luminance, outside), share = grey / (grey + 0.1);
    expect_rgb(shown(outside, settings(ClipRule::desaturate)),
               {grey + share * (0.5 - grey), grey + share * (0.5 - grey), 0});
    for (const Rgb& rgb : {Rgb(2, 0, 0), Rgb(0, 1.2, 0.3), Rgb(0.1, 0, 5), Rgb(1.5, -0.2, 0.4)})
        EXPECT_NEAR(glm::dot(luminance, shown(rgb, settings(ClipRule::desaturate))), glm::dot(luminance, rgb), 1e-12);
    expect_rgb(shown({0, 3, 0}, settings(ClipRule::desaturate)), {1, 1, 1}); // Y = 2.1: white is the most there is
    expect_rgb(shown({-1, 0, 0}, settings(ClipRule::desaturate)), {0, 0, 0});
}

TEST(Display, ScaleAllRaisesMaxDisplayToTheLargestComponent) {
    const auto xyz = [](const Rgb& rgb) { return glm::vec3(xyz_from_rgb(srgb) * rgb); };
    const RadianceImage image{3, 1, {xyz({400, 100, 0}), xyz({50, 50, 50}), xyz({0, 0, 240})}};
    EXPECT_NEAR(largest_component(image), 400, 1e-3);
    const DisplayImage pixels = display_image(image, settings(ClipRule::scale_all, TransferCurve::gamma, 1, 100));
    using Pixel = std::array<std::uint8_t, 3>;
    EXPECT_THAT(pixels.rgb,
                ElementsAre(Pixel{255, 64, 0}, Pixel{32, 32, 32}, Pixel{0, 0, 153})); // 255 * (1/4, 1/8, 3/5)
    // It is raised, never lowered.
    const DisplayImage dim = display_image(image, settings(ClipRule::scale_all, TransferCurve::gamma, 1, 2000));
    EXPECT_EQ(dim.rgb[0], (Pixel{51, 13, 0})); // 255 * (1/5, 1/20, 0)
}

TEST(Display, NotFiniteIsBlackAndNothingLeavesZeroToOne) {
    for (const ClipRule rule : all_rules) {
        for (const Xyz& bad :
             {Xyz(nan, 1, 1), Xyz(1, nan, 1), Xyz(1, 1, infinity), Xyz(-infinity, 0, 0), Xyz(1e308, 1e308, 1e308)}) {
            const glm::dvec3 pixel = display_pixel(bad, settings(rule));
            for (int c = 0; c < 3; ++c) EXPECT_TRUE(pixel[c] >= 0 && pixel[c] <= 1) << to_string(rule);
        }
        EXPECT_EQ(display_pixel(Xyz(nan, 1, 1), settings(rule)), glm::dvec3(0));
        EXPECT_EQ(display_pixel(Xyz(1, 1, infinity), settings(rule)), glm::dvec3(0));
        for (const Xyz& odd : {Xyz(-5, -5, -5), Xyz(0, 1, 0), Xyz(1, 0, 0), Xyz(0, 0, 7), Xyz(1e30, 1, 1)}) {
            for (const TransferCurve curve : {TransferCurve::gamma, TransferCurve::srgb}) {
                const glm::dvec3 pixel = display_pixel(odd, settings(rule, curve, 2.2));
                for (int c = 0; c < 3; ++c) EXPECT_TRUE(pixel[c] >= 0 && pixel[c] <= 1) << to_string(rule) << pixel[c];
            }
        }
    }
    const float not_a_number = std::numeric_limits<float>::quiet_NaN();
    const RadianceImage image{2, 1, {glm::vec3(not_a_number), glm::vec3(0.5f)}};
    EXPECT_GT(largest_component(image), 0);
    EXPECT_EQ(display_image(image, settings(ClipRule::scale_all)).rgb[0], (std::array<std::uint8_t, 3>{0, 0, 0}));
    EXPECT_EQ(largest_component(RadianceImage{}), 0);
}

TEST(Display, CheckNamesEachFault) {
    EXPECT_THAT(check(DisplaySettings{}), IsEmpty());
    for (const double bad : {0.0, -1.0, nan, infinity})
        EXPECT_THAT(check(settings(ClipRule::clamp, TransferCurve::srgb, 2.2, bad)),
                    ElementsAre(HasSubstr("MAXDISPLAY is ")))
            << bad;
    for (const double bad : {0.0, -2.2, 0.09, 10.1, nan, infinity})
        EXPECT_THAT(check(settings(ClipRule::clamp, TransferCurve::gamma, bad, 1)),
                    ElementsAre(HasSubstr("allowed: 0.1 to 10")))
            << bad;
    EXPECT_THAT(check(settings(ClipRule::clamp, TransferCurve::gamma, 0.1, 1e-6)), IsEmpty());
    EXPECT_EQ(check(settings(ClipRule::clamp, TransferCurve::gamma, 0, 0)).size(), 2u);
}

TEST(Display, NamesAreReadBack) {
    for (const ClipRule rule : all_rules) EXPECT_EQ(parse_clip_rule(to_string(rule)), rule);
    for (const TransferCurve curve : {TransferCurve::gamma, TransferCurve::srgb})
        EXPECT_EQ(parse_transfer_curve(to_string(curve)), curve);
    EXPECT_EQ(parse_clip_rule("Clamp"), std::nullopt);
    EXPECT_EQ(parse_transfer_curve(""), std::nullopt);
}

TEST(AutoMaxDisplay, ShowsTheShareUnclippedWithATenthOfHeadroom) {
    std::vector<float> luminances; // 100, 99, ..., 1
    for (int i = 100; i >= 1; --i) luminances.push_back(static_cast<float>(i));
    EXPECT_NEAR(auto_max_display(luminances), 1.1 * 98, 1e-6);
    EXPECT_NEAR(auto_max_display(luminances, 0.5), 1.1 * 50, 1e-6);
    EXPECT_NEAR(auto_max_display(luminances, 1), 1.1 * 100, 1e-6);
    EXPECT_NEAR(auto_max_display(luminances, 0), 1.1 * 1, 1e-6);
    // Zeros, negatives and what is not finite do not count.
    luminances.insert(luminances.end(), 1000, 0.0f);
    luminances.push_back(-5);
    luminances.push_back(std::numeric_limits<float>::quiet_NaN());
    luminances.push_back(std::numeric_limits<float>::infinity());
    EXPECT_NEAR(auto_max_display(luminances), 1.1 * 98, 1e-6);
}

TEST(AutoMaxDisplay, OfADarkSceneIsStillUsable) {
    DisplaySettings s;
    s.max_display = auto_max_display({});
    EXPECT_THAT(check(s), IsEmpty());
    s.max_display = auto_max_display({0, 0});
    EXPECT_THAT(check(s), IsEmpty());
}

} // namespace
} // namespace lueur
