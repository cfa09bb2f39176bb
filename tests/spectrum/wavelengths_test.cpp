// Channels against integrals at 1 nm: flat light, narrow lines, measured paint, RGB colours.
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/spectrum/colour.h"
#include "core/spectrum/observer.h"
#include "core/spectrum/rgb_spectrum.h"
#include "tests/spectrum/cornell_paints.h"
#include "tests/spectrum/library_spectra.h"

namespace lueur {
namespace {

using ::testing::HasSubstr;

Wavelengths uniform(int count) {
    return make_wavelengths({WavelengthRule::uniform, count});
}
Wavelengths rgb() {
    return make_wavelengths({WavelengthRule::rgb, 3});
}

// Km * sum of light * paint * observer, each 0.1 nm by the trapezoidal rule: nothing of the code under test but the
// tables.
Xyz xyz_by_sampling(const Spectrum& light, const Spectrum& paint) {
    Xyz sum(0);
    for (int i = 3600; i <= 8300; ++i) {
        const double nm = i / 10.0;
        const double weight = i == 3600 || i == 8300 ? 0.05 : 0.1;
        sum += weight * value_at(light, nm, Outside::zero) * value_at(paint, nm, Outside::constant) * observer_xyz(nm);
    }
    return luminous_efficacy_km * sum;
}

std::vector<double> product(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> c(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) c[i] = a[i] * b[i];
    return c;
}

TEST(Wavelengths, AreParsedAndNamed) {
    EXPECT_EQ(parse_wavelengths("rgb"), (WavelengthsSpec{WavelengthRule::rgb, 3}));
    EXPECT_EQ(parse_wavelengths("auto"), (WavelengthsSpec{WavelengthRule::automatic, 0}));
    EXPECT_EQ(parse_wavelengths("uniform:31"), (WavelengthsSpec{WavelengthRule::uniform, 31}));
    EXPECT_EQ(parse_wavelengths("meyer:6"), (WavelengthsSpec{WavelengthRule::meyer, 6}));
    EXPECT_EQ(parse_wavelengths("gauss:10"), (WavelengthsSpec{WavelengthRule::gauss, 10}));
    EXPECT_EQ(parse_wavelengths("folded:8"), (WavelengthsSpec{WavelengthRule::folded, 8}));
    EXPECT_EQ(parse_wavelengths("8"), (WavelengthsSpec{WavelengthRule::folded, 8}));
    for (const char* text : {"rgb", "auto", "uniform:4", "uniform:31", "uniform:81", "meyer:4", "meyer:6", "meyer:10",
                             "gauss:3", "gauss:20", "folded:1", "folded:32"})
        EXPECT_EQ(to_string(parse_wavelengths(text).value()), text);
    for (const char* text : {"",           "RGB",         "Auto",
                             "auto:3",     "rgb:3",       "uniform",
                             "uniform:",   "uniform:3",   "uniform:82",
                             "uniform:-5", "uniform:8.5", "uniform:8 ",
                             "uniform: 8", "meyer:5",     "meyer:3",
                             "gauss:2",    "gauss:21",    "folded:0",
                             "folded:33",  "0",           "33",
                             "-8",         "8.5",         "+8",
                             ":8",         "eight",       "uniform:99999999999999999999"}) {
        const auto parsed = parse_wavelengths(text);
        ASSERT_FALSE(parsed) << text;
        EXPECT_THAT(parsed.error(), HasSubstr("allowed: auto, rgb, uniform:N with N from 4 to 81, meyer:4, meyer:6, "
                                              "meyer:10, gauss:N with N from 3 to 20, folded:N"))
            << text;
        EXPECT_THAT(parsed.error(), HasSubstr(text));
    }
}

TEST(Wavelengths, UniformSpans400To700AndAbove31TheWholeRange) {
    const Wavelengths w = uniform(31);
    ASSERT_EQ(w.size(), 31);
    for (int k = 0; k < 31; ++k) EXPECT_NEAR(w.nm[static_cast<std::size_t>(k)], 400 + 10 * k, 1e-12);
    EXPECT_EQ(uniform(4).nm, (std::vector<double>{400, 500, 600, 700}));
    const Wavelengths truth = uniform(81);
    ASSERT_EQ(truth.size(), 81);
    for (int k = 0; k < 81; ++k) EXPECT_NEAR(truth.nm[static_cast<std::size_t>(k)], 380 + 5 * k, 1e-12);
}

TEST(Wavelengths, FlatLightHasTheXyzOfThe1NmIntegral) {
    const Xyz exact = xyz_from_spectrum(Spectrum{{360, 830}, {1, 1}});
    for (int count = 4; count <= 31; ++count) {
        const Wavelengths w = uniform(count);
        const std::vector<double> channels = emission_channels(w, Spectrum{{300, 900}, {1, 1}});
        for (const double channel : channels) EXPECT_NEAR(channel, 1, 1e-12);
        EXPECT_LT(glm::distance(xyz_from_channels(w, channels), exact), 1e-6) << count;
        const std::vector<float> single(channels.begin(), channels.end());
        EXPECT_LT(glm::distance(xyz_from_channels(w, single), exact), 1e-1) << "float channels";
        EXPECT_NEAR(watts_from_channels(w, channels), 400, 1e-9) << "1 W/nm over 380..780 nm";
    }
}

TEST(Wavelengths, ANarrowLineKeepsItsPowerWhereverItFalls) {
    const double wide = 0.02;
    for (int count : {4, 10, 31}) {
        const Wavelengths w = uniform(count);
        for (const double nm : {385.0, 399.0, 404.66, 435.83, 500.0, 546.07, 577.9, 655.0, 699.5, 763.5}) {
            const Spectrum line{{nm - wide / 2, nm, nm + wide / 2}, {0, 2 / wide, 0}}; // 1 W
            const std::vector<double> channels = emission_channels(w, line);
            EXPECT_NEAR(watts_from_channels(w, channels), 1, 1e-9) << nm << " in " << count;
            for (const double channel : channels) EXPECT_GE(channel, 0);
        }
    }
    // All of a line that falls on a channel's wavelength is in that channel, but for its own width.
    const Spectrum on_channel{{549.99, 550, 550.01}, {0, 100, 0}};
    const std::vector<double> channels = emission_channels(uniform(31), on_channel);
    EXPECT_NEAR(channels[15] * 10, 1, 1e-3);
}

TEST(Wavelengths, ALightIsTheMeanUnderItsHatAndAPaintIsReadAtItsMiddle) {
    // The ramp nm/1000: its mean under a symmetric hat is the ramp at the peak; the end hats are whole from 380 and to
    // 780 nm: (20 * 0.390 + 5 * 0.40333) / 25, likewise above.
    const Spectrum ramp{{300, 900}, {0.3, 0.9}};
    const std::vector<double> light = emission_channels(uniform(31), ramp),
                              paint = reflectance_channels(uniform(31), ramp);
    for (std::size_t k = 0; k < 31; ++k) EXPECT_NEAR(paint[k], (400 + 10.0 * static_cast<double>(k)) / 1000, 1e-12);
    for (std::size_t k = 1; k < 30; ++k) EXPECT_NEAR(light[k], paint[k], 1e-12);
    EXPECT_NEAR(light.front(), (20 * 0.390 + 5 * (0.400 + 0.010 / 3)) / 25, 1e-12);
    EXPECT_NEAR(light.back(), (80 * 0.740 + 5 * (0.700 - 0.010 / 3)) / 85, 1e-12);
}

// The observer under each hat is weighted with the content's light: white is then exact for it, whatever its lines.
TEST(Wavelengths, TheContentsOwnLightHasItsXyz) {
    for (const char* name : {"A", "D65", "FL2", "FL11", "LED-RGB1", "HP1"})
        for (const int count : {10, 31, 81}) {
            const SpectralContent content{{library_light(name)}, {}};
            const Wavelengths w = make_wavelengths({WavelengthRule::uniform, count}, content);
            const Xyz exact = xyz_from_spectrum(content.lights[0]);
            const Xyz seen = xyz_from_channels(w, emission_channels(w, content.lights[0]));
            EXPECT_LT(glm::distance(seen, exact), 1e-6 * exact.y) << name << ' ' << count;
        }
}

TEST(Wavelengths, OutsideItsGridAPaintGoesOnAndALampEnds) {
    const Spectrum narrow{{500, 600}, {0.5, 0.5}};
    const Wavelengths w = uniform(31);
    for (const double channel : reflectance_channels(w, narrow)) EXPECT_NEAR(channel, 0.5, 1e-12);
    const std::vector<double> lamp = emission_channels(w, narrow);
    EXPECT_EQ(lamp.front(), 0);
    EXPECT_NEAR(lamp[15], 0.5, 1e-12);
    EXPECT_NEAR(lamp[10], 0.25, 1e-12) << "half of the hat at 500 nm";
    EXPECT_NEAR(watts_from_channels(w, lamp), 50, 1e-9);
}

TEST(Wavelengths, ThirtyOneChannelsOfPaintUnderALampAreNearThe1NmIntegral) {
    // The paint is read each 10 nm and no finer. Of its own luminance that costs the measured white paint at most
    // 0.3 %, and the red one, dark with a steep edge at 600 nm, 2 %.
    for (const double kelvin : {2856.0, 5000.0}) {
        const Spectrum lamp = blackbody(kelvin);
        const Wavelengths w = make_wavelengths({WavelengthRule::uniform, 31}, {{lamp}, {}});
        const std::vector<double> light = emission_channels(w, lamp);
        const auto error = [&](const Spectrum& paint) {
            const Xyz exact = xyz_by_sampling(lamp, paint);
            return glm::distance(xyz_from_channels(w, product(light, reflectance_channels(w, paint))), exact) / exact.y;
        };
        EXPECT_LT(error(cornell_paint(cornell_white)), 3e-3) << kelvin;
        EXPECT_LT(error(cornell_paint(cornell_red)), 2e-2) << kelvin;
    }
}

TEST(Wavelengths, TheCornellLampsChannelsHaveItsXyz) {
    const Spectrum lamp{{400, 500, 600, 700}, {0, 8, 15.6, 18.4}}; // Cornell box data, relative
    const Xyz exact = xyz_from_spectrum(lamp);
    EXPECT_LT(glm::distance(xyz_by_sampling(lamp, Spectrum{{360, 830}, {1, 1}}), exact), 1e-3 * exact.y);
    const Wavelengths w = uniform(31);
    EXPECT_LT(glm::distance(xyz_from_channels(w, emission_channels(w, lamp)), exact), 5e-3 * exact.y);
}

TEST(RgbWavelengths, WhiteIsOneWattAnd18246LumenAtTheWhitePoint) {
    const Wavelengths w = rgb();
    ASSERT_EQ(w.size(), 3);
    const std::vector<double> white = emission_channels(w, Rgb(1));
    EXPECT_EQ(white, (std::vector<double>{1, 1, 1}));
    const Xyz xyz = xyz_from_channels(w, white);
    EXPECT_NEAR(xyz.y, 683 * 106.857 / 400, 1e-3);
    EXPECT_NEAR(chromaticity(xyz).x, 0.3127, 1e-12);
    EXPECT_NEAR(chromaticity(xyz).y, 0.3290, 1e-12);
    EXPECT_NEAR(watts_from_channels(w, white), 1, 1e-12);
}

TEST(RgbWavelengths, TakeRgbAsItIs) {
    EXPECT_EQ(reflectance_channels(rgb(), Rgb(0.1, 0.2, 0.3)), (std::vector<double>{0.1, 0.2, 0.3}));
    EXPECT_EQ(emission_channels(rgb(), Rgb(17, 12, 4)), (std::vector<double>{17, 12, 4}));
}

TEST(RgbWavelengths, ALampKeepsItsXyz) {
    const Wavelengths w = rgb();
    for (const Spectrum& lamp : {blackbody(2856), illuminant_d65(), Spectrum{{588, 589, 590}, {0, 1, 0}}}) {
        const Xyz exact = xyz_from_spectrum(lamp);
        EXPECT_LT(glm::distance(xyz_from_channels(w, emission_channels(w, lamp)), exact), 1e-9 * exact.y);
    }
    EXPECT_LT(emission_channels(w, Spectrum{{588, 589, 590}, {0, 1, 0}})[2], 0) << "sodium light is outside sRGB";
}

TEST(RgbWavelengths, AFlatPaintIsGreyAndASaturatedOneStaysWithinZeroAndOne) {
    const Wavelengths w = rgb();
    for (const double channel : reflectance_channels(w, Spectrum{{400, 700}, {0.37, 0.37}}))
        EXPECT_NEAR(channel, 0.37, 1e-12);
    // f = 1 from 600 nm only: rbar is negative below, so the unclamped mean of R is above 1 and that of G below 0.
    const Spectrum step{{599, 600, 830}, {0, 1, 1}};
    for (const double channel : reflectance_channels(w, step)) {
        EXPECT_GE(channel, 0);
        EXPECT_LE(channel, 1);
    }
    const std::vector<double> red = reflectance_channels(w, cornell_paint(cornell_red));
    EXPECT_GT(red[0], 4 * red[1]);
}

TEST(UniformWavelengths, RgbLightHasItsLuminanceAndColour) {
    const Wavelengths w = uniform(31);
    const Xyz white = xyz_from_channels(w, emission_channels(w, Rgb(1)));
    EXPECT_NEAR(white.y, 683 * 106.857 / 400, 1e-3) << "exact in the channels' own quadrature";
    EXPECT_NEAR(chromaticity(white).x, 0.3127, 5e-4);
    EXPECT_NEAR(chromaticity(white).y, 0.3290, 5e-4);
    EXPECT_NEAR(xyz_from_channels(uniform(8), emission_channels(uniform(8), Rgb(2.5))).y, 2.5 * 683 * 106.857 / 400,
                1e-2);
    EXPECT_EQ(emission_channels(w, Rgb(0)), std::vector<double>(31, 0.0));
    // A warm lamp of any scale: the same XYZ as the rgb rule gives, within 1 % of its largest component.
    for (const Rgb colour : {Rgb(17, 12, 4), Rgb(0.017, 0.012, 0.004), Rgb(1, 0, 0), Rgb(0, 0, 3000)}) {
        const Xyz uniform_xyz = xyz_from_channels(w, emission_channels(w, colour));
        const Xyz rgb_xyz = xyz_from_channels(rgb(), emission_channels(rgb(), colour));
        EXPECT_LT(glm::distance(uniform_xyz, rgb_xyz), 1e-2 * std::max({rgb_xyz.x, rgb_xyz.y, rgb_xyz.z})) << colour.r;
    }
}

TEST(UniformWavelengths, RgbPaintStaysWithinZeroAndOne) {
    for (const Rgb colour :
         {Rgb(0), Rgb(1), Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1), Rgb(1, 1, 0), Rgb(0.2, 0.7, 0.1)}) {
        for (const double channel : reflectance_channels(uniform(31), colour)) {
            EXPECT_GE(channel, 0);
            EXPECT_LE(channel, 1);
        }
    }
    for (const double channel : reflectance_channels(uniform(31), Rgb(0.25))) EXPECT_NEAR(channel, 0.25, 1e-12);
}

} // namespace
} // namespace lueur
