// From radiance to code values: curves, clip rules on hand-worked colours, MAXDISPLAY.
#include <algorithm>
#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "core/display/display.h"
#include "core/display/display_words.h"

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
    s.gamma = glm::dvec3(gamma);
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
    EXPECT_NEAR(largest_component(image, settings(ClipRule::scale_all, TransferCurve::gamma, 1, 100)), 4, 1e-5);
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
    EXPECT_GT(largest_component(image, settings(ClipRule::scale_all)), 0);
    EXPECT_EQ(display_image(image, settings(ClipRule::scale_all)).rgb[0], (std::array<std::uint8_t, 3>{0, 0, 0}));
    EXPECT_EQ(largest_component(RadianceImage{}, settings(ClipRule::scale_all)), 0);
}

// Linear sRGB red in Display P3: P3's matrix times the XYZ of red is (0.822462, 0.033194, 0.017083), the figures of the
// CSS Color 4 specification's conversion.
TEST(Display, ShowsColoursInThePrimariesOfTheDisplay) {
    DisplaySettings s = settings(ClipRule::clamp);
    s.primaries = display_p3;
    const glm::dvec3 red = shown({1, 0, 0}, s);
    EXPECT_NEAR(red.r, 0.822462, 2e-5);
    EXPECT_NEAR(red.g, 0.033194, 2e-5);
    EXPECT_NEAR(red.b, 0.017083, 2e-5);
    // The white of any display is its (1, 1, 1), at MAXDISPLAY.
    for (const auto& preset : rgb_spaces) {
        s.primaries = preset.space;
        s.max_display = 250;
        expect_rgb(display_pixel(xyz_from_chromaticity(preset.space.white, 250), s), Rgb(1));
        expect_rgb(display_pixel(xyz_from_chromaticity(preset.space.white, 50), s), Rgb(0.2));
    }
    // The luminance of the display's white is no part of the linear operator.
    s.white_luminance = 500;
    expect_rgb(display_pixel(xyz_from_chromaticity(rgb_spaces.back().space.white, 50), s), Rgb(0.2));
}

TEST(Display, GammaIsOfEachChannel) {
    DisplaySettings s = settings(ClipRule::clamp);
    s.gamma = {1, 2, 4};
    expect_rgb(shown({0.25, 0.25, 0.0625}, s), {0.25, 0.5, 0.5});
}

// The four rules on colours no sRGB display can show: a spectral green, blue-green and violet have negative components.
TEST(Display, SaturatedColoursOutsideOfTheGamut) {
    const glm::dvec3 weights(0.21263900587151022, 0.715168678767756, 0.07219231536073371);
    for (const Xyz& light : {Xyz(0.0633, 0.7100, 0.0782), Xyz(0.0049, 0.3230, 0.2720), Xyz(0.3483, 0.0230, 1.7471),
                             Xyz(0.8544, 0.3810, 0.0002)}) { // 520, 500, 440 and 620 nm
        const Rgb linear = rgb_from_xyz(srgb) * light;
        ASSERT_LT(std::min({linear.r, linear.g, linear.b}), 0);
        for (const double exposure : {0.05, 0.3, 1.0, 20.0}) {
            const Rgb in = exposure * linear;
            const double luminance = glm::dot(weights, in);
            const Rgb cut = shown(in, settings(ClipRule::clamp));
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(cut[c], std::clamp(in[c], 0.0, 1.0), 1e-9);
            const Rgb kept = shown(in, settings(ClipRule::keep_chromaticity)), positive = glm::max(in, 0.0);
            const double ratio = std::max({kept.r, kept.g, kept.b}) / std::max({positive.r, positive.g, positive.b});
            EXPECT_LT(glm::distance(kept, ratio * positive), 1e-9) << "the chromaticity of what can be sent";
            EXPECT_LE(ratio, 1 + 1e-12);
            const Rgb grey = shown(in, settings(ClipRule::desaturate));
            EXPECT_NEAR(glm::dot(weights, grey), std::min(luminance, 1.0), 1e-9) << "the luminance stays";
            if (luminance < 1) { // and the hue: on the line from grey to the colour
                const Rgb from = in - Rgb(luminance), to = grey - Rgb(luminance);
                EXPECT_LT(glm::length(glm::cross(from, to)), 1e-9 * (1 + glm::length(from)));
                EXPECT_GE(glm::dot(from, to), 0);
            }
        }
    }
}

TEST(Display, EndsOfTheAllowedRangesWork) {
    for (const double max_display : {1e-30, 1e30})
        for (const ToneOperator tone_operator : all_tone_operators)
            for (const ClipRule rule : all_rules)
                for (const double gamma : {0.1, 10.0}) {
                    DisplaySettings s = settings(rule, TransferCurve::gamma, gamma, max_display);
                    s.tone_operator = tone_operator;
                    ASSERT_THAT(check(s), IsEmpty());
                    for (const Rgb& rgb : {Rgb(0), Rgb(1e-30), Rgb(1), Rgb(1e30), Rgb(3e38), Rgb(1, -0.5, 0.1),
                                           Rgb(-1e30, 1e30, 0), Rgb(1e-45, 0, 0)}) {
                        const glm::dvec3 pixel = shown(rgb, s);
                        for (int c = 0; c < 3; ++c)
                            EXPECT_TRUE(pixel[c] >= 0 && pixel[c] <= 1)
                                << to_string(tone_operator) << to_string(rule) << max_display << pixel[c];
                    }
                }
    // All is white beside a MAXDISPLAY of 1e-30, all black beside one of 1e30.
    expect_rgb(shown(Rgb(1e-6), settings(ClipRule::clamp, TransferCurve::srgb, 2.2, 1e-30)), Rgb(1));
    EXPECT_LT(shown(Rgb(1e6), settings(ClipRule::clamp, TransferCurve::srgb, 2.2, 1e30)).g, 1e-12);
}

// `check` refuses these; whoever asks all the same gets a picture without NaN.
TEST(Display, RefusedGammasStayFiniteToo) {
    for (const double gamma : {1e-30, 1e30})
        for (const double light : {0.0, 1e-9, 0.5, 1.0}) {
            const double pixel = shown(Rgb(light), settings(ClipRule::clamp, TransferCurve::gamma, gamma)).g;
            EXPECT_TRUE(pixel >= 0 && pixel <= 1) << gamma << " " << light;
        }
}

TEST(Display, SixteenBitsAreTheSamePicture) {
    RadianceImage image{64, 1, {}};
    for (int i = 0; i < 64; ++i) image.xyz.push_back(glm::vec3(xyz_from_rgb(srgb) * Rgb(i / 60.0, i / 80.0, 0.3)));
    const DisplaySettings s = settings(ClipRule::desaturate, TransferCurve::srgb);
    const DisplayImage eight = display_image(image, s);
    const DeepDisplayImage sixteen = deep_display_image(image, s);
    for (std::size_t i = 0; i < 64; ++i)
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sixteen.rgb[i][c] / 257.0, eight.rgb[i][c], 0.501);
}

TEST(Marks, CountAndStripeWhatIsWrong) {
    const auto xyz = [](const Rgb& rgb) { return glm::vec3(xyz_from_rgb(srgb) * rgb); };
    RadianceImage image{16, 16, std::vector<glm::vec3>(256, xyz(Rgb(0.5)))};
    for (std::size_t i = 0; i < 64; ++i) image.xyz[i] = xyz({1.5, 0.5, 0.5});      // the upper quarter: clipped
    for (std::size_t i = 192; i < 256; ++i) image.xyz[i] = xyz({0.5, -0.2, 0.5});  // the lower one: out of gamut
    for (std::size_t i = 64; i < 80; ++i) image.xyz[i] = glm::vec3(std::nanf("")); // black, and no fault
    DisplaySettings s = settings(ClipRule::clamp);
    EXPECT_EQ(display_shares(image, s), (DisplayShares{0.25, 0.25}));
    const DisplayImage plain = display_image(image, s);
    s.mark_clipped = true;
    const DisplayImage clipped_marked = display_image(image, s);
    s.mark_out_of_gamut = true;
    const DisplayImage both = display_image(image, s);
    std::size_t upper = 0, lower = 0, elsewhere = 0;
    for (std::size_t i = 0; i < 256; ++i) {
        (i < 64 ? upper : i < 192 ? elsewhere : lower) += both.rgb[i] != plain.rgb[i];
        if (i >= 64) {
            EXPECT_EQ(clipped_marked.rgb[i], plain.rgb[i]);
        }
    }
    EXPECT_EQ(upper, 32u) << "half of them, in stripes";
    EXPECT_EQ(lower, 32u);
    EXPECT_EQ(elsewhere, 0u);
    // Scaled as a whole nothing is clipped.
    s.clip = ClipRule::scale_all;
    EXPECT_EQ(display_shares(image, s).clipped, 0);
    EXPECT_EQ(display_shares(RadianceImage{}, s), DisplayShares{});
    // More primaries: what was outside may be inside.
    s.primaries = rec2020;
    EXPECT_LE(display_shares(image, s).out_of_gamut, 0.25);
}

TEST(DisplayWords, AreReadBackWithoutLoss) {
    DisplaySettings s;
    s.max_display_rule = MaxDisplayRule::lecture;
    s.max_display = 1.0 / 3;
    s.percentile = 95.5;
    s.max_display_locked = false;
    s.tone_operator = ToneOperator::tumblin_rushmeier;
    s.adaptation_automatic = false;
    s.adaptation_luminance = 0.1 + 0.2;
    s.display_contrast = 50;
    s.filmic_white = 7;
    s.clip = ClipRule::desaturate;
    s.curve = TransferCurve::gamma;
    s.gamma = {1.8, 2.2, 2.4};
    s.primaries = {{0.61, 0.35}, {0.29, 0.59}, {0.15, 0.063}, {0.28, 0.29}};
    s.white_luminance = 230;
    s.mark_clipped = s.mark_out_of_gamut = true;
    s.luminance_scale = {false, 0.5, 50, false, false, {}};
    s.illuminance_scale = {false, 10, 3000, true, true, {100, 300, 0.1}};
    ASSERT_THAT(check(s), IsEmpty());
    DisplaySettings back;
    EXPECT_EQ(read_display_words(back, words_from_display(s)), std::nullopt);
    EXPECT_EQ(back, s);
    for (const auto& [key, bad] : {std::pair("gamma", "2.2 1"), std::pair("clip", "hard"), std::pair("locked", "maybe"),
                                   std::pair("max_display", "1e"), std::pair("primaries", "0.1 0.2")}) {
        const auto fault = read_display_words(back, {{key, bad}});
        ASSERT_TRUE(fault) << key;
        EXPECT_THAT(*fault, HasSubstr(key));
    }
    EXPECT_EQ(back, s) << "what cannot be read changes nothing";
}

TEST(Display, CheckNamesEachFault) {
    EXPECT_THAT(check(DisplaySettings{}), IsEmpty());
    for (const double bad : {0.0, -1.0, nan, infinity, 9e-31, 1.1e30})
        EXPECT_THAT(check(settings(ClipRule::clamp, TransferCurve::srgb, 2.2, bad)),
                    ElementsAre(HasSubstr("MAXDISPLAY is ")))
            << bad;
    for (const double bad : {0.0, -2.2, 0.09, 10.1, nan, infinity, 1e-30, 1e30})
        EXPECT_THAT(check(settings(ClipRule::clamp, TransferCurve::gamma, bad, 1)),
                    ElementsAre(HasSubstr("allowed: 0.1..10")))
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
