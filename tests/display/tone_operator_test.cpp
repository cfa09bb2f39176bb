// Tone operators against figures worked out by hand from the published equations.
#include "core/display/tone_operator.h"

#include <cmath>
#include <gtest/gtest.h>

#include "core/display/display.h"

namespace lueur {
namespace {

constexpr double pi = 3.14159265358979323846;

DisplaySettings with(ToneOperator tone_operator, double max_display = 100) {
    DisplaySettings settings;
    settings.tone_operator = tone_operator;
    settings.max_display = max_display;
    settings.white_luminance = 100;
    return settings;
}

double shown(const DisplaySettings& settings, double luminance) {
    return shown_luminance(make_tone_curve(settings), luminance / settings.max_display);
}

// 100 cd m^-2 is pi/100 lamberts, log10 = -1.502850. alpha = 0.4 (-1.502850) + 2.92 = 2.318860;
// beta = -0.4 * 2.258558 + 2.584 * 1.502850 + 2.0208 = -0.903423 + 3.883365 + 2.0208 = 5.000741.
TEST(TumblinRushmeier, StevensParametersAreThePapers) {
    EXPECT_NEAR(tumblin_rushmeier_alpha(pi / 100), 2.318860, 1e-6);
    EXPECT_NEAR(tumblin_rushmeier_beta(pi / 100), 5.000741, 1e-6);
    EXPECT_NEAR(tumblin_rushmeier_alpha(1), 2.92, 1e-12);
    EXPECT_NEAR(tumblin_rushmeier_beta(1), 2.0208, 1e-12);
}

// A display of 100 cd m^-2 and contrast 35: L_da = 100 / sqrt(35) = 16.90309 cd m^-2 = 0.005310261 lamberts, log10 =
// -2.274884; alpha_d = 2.010046, beta_d = -2.070039 + 5.878300 + 2.0208 = 5.829061. For L = L_a = 100 cd m^-2:
// log10 L_d = (5.000741 - 5.829061) / 2.010046 + 2.318860 / 2.010046 * (-1.502850) = -0.412090 - 1.733746 = -2.145836
// -> 0.00714775 lamberts = 22.7520 cd m^-2; n = 0.227520 - 1/35 = 0.198949.
TEST(TumblinRushmeier, ShowsWhatTheEquationsSay) {
    DisplaySettings settings = with(ToneOperator::tumblin_rushmeier);
    settings.adaptation_luminance = 100;
    EXPECT_NEAR(shown(settings, 100), 0.198949, 1e-6);
    settings.adaptation_luminance = 1;
    settings.max_display = 7; // absolute: MAXDISPLAY plays no part
    const double dim = shown(settings, 1);
    settings.max_display = 7000;
    EXPECT_NEAR(shown(settings, 1), dim, 1e-12);
    // The brightness of both sides is the same: 10^beta_w L^alpha_w = 10^beta_d L_d^alpha_d.
    for (const double adaptation : {0.01, 1.0, 50.0, 3000.0})
        for (const double luminance : {1.0, 20.0, 900.0}) {
            settings.adaptation_luminance = adaptation;
            const double n = shown(settings, luminance);
            if (n == 0) continue; // below the black of the display
            const double of_display = (n + 1.0 / 35) * 100 * pi * 1e-4, of_world = luminance * pi * 1e-4;
            const double world = adaptation * pi * 1e-4, display = 100 / std::sqrt(35.0) * pi * 1e-4;
            const double brightness_w =
                tumblin_rushmeier_beta(world) + tumblin_rushmeier_alpha(world) * std::log10(of_world);
            const double brightness_d =
                tumblin_rushmeier_beta(display) + tumblin_rushmeier_alpha(display) * std::log10(of_display);
            EXPECT_NEAR(brightness_w, brightness_d, 1e-9) << adaptation << " " << luminance;
        }
}

// An eye adapted to the scene as to the display sees both alike: the display shows the luminance itself, less its
// black.
TEST(TumblinRushmeier, EqualAdaptationShowsTheLuminanceItself) {
    DisplaySettings settings = with(ToneOperator::tumblin_rushmeier);
    settings.adaptation_luminance = 100 / std::sqrt(35.0);
    for (const double luminance : {5.0, 20.0, 80.0, 150.0})
        EXPECT_NEAR(shown(settings, luminance), luminance / 100 - 1.0 / 35, 1e-12);
}

TEST(Filmic, IsHablesCurve) {
    // ((1 (0.15 + 0.05) + 0.004) / (1 (0.15 + 0.5) + 0.06)) - 0.02/0.3 = 0.204/0.71 - 0.066667
    EXPECT_NEAR(hable_curve(1), 0.204 / 0.71 - 0.02 / 0.3, 1e-15);
    EXPECT_NEAR(hable_curve(11.2),
                (11.2 * (0.15 * 11.2 + 0.05) + 0.004) / (11.2 * (0.15 * 11.2 + 0.5) + 0.06) - 0.02 / 0.3, 1e-14);
    EXPECT_EQ(hable_curve(0), 0);
}

TEST(Filmic, KeepsGreyAndReachesWhiteWhereItIsAskedTo) {
    for (const double white : {1.0, 2.0, 4.0, 20.0, 100.0}) {
        DisplaySettings settings = with(ToneOperator::filmic, 250);
        settings.filmic_white = white;
        EXPECT_NEAR(shown(settings, 0.18 * 250), 0.18, 1e-9) << white;
        EXPECT_NEAR(shown(settings, white * 250), 1, 1e-12);
        EXPECT_NEAR(shown(settings, 10 * white * 250), 1, 1e-12);
        if (white > 1) {
            EXPECT_LT(shown(settings, 250), 1);
        }
    }
}

TEST(ToneOperators, AreMonotoneAndFinite) {
    for (const ToneOperator tone_operator : all_tone_operators)
        for (const double max_display : {1e-30, 1.0, 100.0, 1e30}) {
            DisplaySettings settings = with(tone_operator, max_display);
            for (const double adaptation : {1e-3, 1.0, 1e6})
                for (const double extreme : {2.0, 1e6}) {
                    settings.adaptation_luminance = adaptation;
                    settings.display_contrast = extreme;
                    settings.filmic_white = extreme > 100 ? 100 : 1;
                    const ToneCurve curve = make_tone_curve(settings);
                    double before = -1e300;
                    for (int decade = -3000; decade <= 3000; ++decade) {
                        const double value = shown_luminance(curve, std::pow(10.0, decade / 100.0));
                        ASSERT_TRUE(std::isfinite(value)) << to_string(tone_operator) << decade;
                        ASSERT_GE(value, before * (1 - 1e-12)) << to_string(tone_operator) << decade;
                        before = value;
                    }
                    if (tone_operator != ToneOperator::linear)
                        for (const double none : {0.0, -1.0, -1e30, std::nan("")}) {
                            EXPECT_EQ(shown_luminance(curve, none), 0);
                        }
                    for (const Rgb& rgb : {Rgb(0), Rgb(1e36, -1e36, 3), Rgb(-1, -1, -1), Rgb(1e-40, 0, 0), Rgb(1e36)}) {
                        const Rgb result = toned(curve, rgb, {0.2126, 0.7152, 0.0722});
                        for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(result[c]));
                    }
                }
        }
}

TEST(ToneOperators, KeepTheChromaticity) {
    for (const ToneOperator tone_operator : all_tone_operators) {
        const ToneCurve curve = make_tone_curve(with(tone_operator));
        const Rgb rgb(0.7, 0.3, -0.02), result = toned(curve, rgb, {0.2126, 0.7152, 0.0722});
        EXPECT_NEAR(result.g / result.r, 0.3 / 0.7, 1e-12);
        EXPECT_NEAR(result.b / result.r, -0.02 / 0.7, 1e-12);
    }
}

} // namespace
} // namespace lueur
