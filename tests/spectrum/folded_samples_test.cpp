// Reflectances at a few wavelengths with the light in the weights: what is exact, and what happens at the edges.
#include "core/spectrum/folded_samples.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "core/spectrum/subset_misfit.h"
#include "core/spectrum/wavelengths_plan.h"
#include "tests/spectrum/library_spectra.h"

namespace lueur {
namespace {

Wavelengths folded(int count, const SpectralContent& content) {
    return make_wavelengths({WavelengthRule::folded, count}, content);
}

TEST(FoldedSamples, WhiteAndWattsAreExactForEveryLightOfTheLibrary) {
    for (const NamedSpectrum& light : library_lights()) {
        const Wavelengths w = folded(6, {{light.spectrum}, library_paints("Cornell box")});
        const std::vector<double> channels = emission_channels(w, light.spectrum);
        const Xyz exact = xyz_from_spectrum(light.spectrum);
        EXPECT_LT(glm::distance(xyz_from_channels(w, channels), exact), 1e-6 * exact.y) << light.name;
        const double watts = integral(light.spectrum, 380, 780, Outside::zero);
        EXPECT_NEAR(watts_from_channels(w, channels), watts, 1e-6 * watts) << light.name;
    }
}

// All its power in one line 1 nm wide: hardly more than the paint's value there counts.
TEST(FoldedSamples, ALaserTakesTwoOrThreeSamples) {
    for (const double nm : {450.0, 532.0, 589.0, 633.0}) {
        const SpectralContent content{{laser(nm)}, colour_checker()};
        const WavelengthsPlan plan = plan_wavelengths({WavelengthRule::automatic, 0}, content, 0.5);
        EXPECT_LE(plan.wavelengths.size(), 3) << nm;
        const Differences three = true_differences(plan.wavelengths, content.lights[0], content.reflectances, 7);
        EXPECT_LT(three.worst, 0.5) << nm;
    }
}

TEST(FoldedSamples, ALineOnASampleIsExactWithOne) {
    const SpectralContent content{{{{549.99, 550, 550.01}, {0, 100, 0}}}, colour_checker()};
    const Wavelengths w = folded(1, content);
    EXPECT_EQ(w.nm, std::vector<double>{550});
    // Its colours, straight from the values at the line: the sums at 1 nm of the other tests would miss half of it.
    const Xyz white = xyz_from_spectrum(content.lights[0]);
    const std::vector<double> emission = emission_channels(w, content.lights[0]);
    for (const Spectrum& paint : content.reflectances) {
        const Xyz exact = white * value_at(paint, 550, Outside::constant);
        const std::vector<double> seen = times(emission, reflectance_channels(w, paint));
        EXPECT_LT(glm::distance(xyz_from_channels(w, std::span<const double>(seen)), exact), 1e-6 * white.y);
    }
}

TEST(FoldedSamples, EachLightHasChannelsOfItsOwn) {
    const SpectralContent content{{library_light("A"), library_light("FL11"), library_light("HP1")}, colour_checker()};
    const Wavelengths w = folded(10, content);
    ASSERT_EQ(w.size(), 30);
    ASSERT_EQ(w.samples, 10);
    for (std::size_t light = 0; light < 3; ++light) {
        const std::vector<double> channels = emission_channels(w, content.lights[light]);
        for (std::size_t k = 0; k < 30; ++k) {
            EXPECT_EQ(w.nm[k], w.nm[k % 10]);
            EXPECT_EQ(channels[k], k / 10 == light ? w.light_norm[light] : 0);
        }
        EXPECT_LT(true_differences(w, content.lights[light], content.reflectances).worst, 1) << light;
    }
    for (const double channel : emission_channels(w, library_light("D65")))
        EXPECT_EQ(channel, 0) << "none of the lights";
}

// Lights differ by their weights only: what is solved, unit emission on paints, is the same numbers.
TEST(FoldedSamples, AnotherLightOfTheSameFluxHasTheSameChannels) {
    const SpectralContent daylight{{library_light("D65")}, colour_checker()};
    const Wavelengths before = folded(10, daylight);
    SpectralContent sodium = daylight;
    sodium.lights = {library_light("HP1")};
    const WavelengthsPlan after = plan_wavelengths({WavelengthRule::folded, 10}, sodium, 10, &before);
    EXPECT_EQ(after.wavelengths.nm, before.nm) << after.reason;
    const auto lumen = [](const Wavelengths& w, const Spectrum& light) {
        std::vector<double> channels = emission_channels(w, light);
        const double y = xyz_from_channels(w, channels).y;
        for (double& channel : channels) channel /= y;
        return channels;
    };
    const auto a = lumen(before, daylight.lights[0]), b = lumen(after.wavelengths, sodium.lights[0]);
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-12);
    for (const Spectrum& paint : daylight.reflectances)
        EXPECT_EQ(reflectance_channels(before, paint), reflectance_channels(after.wavelengths, paint));
}

TEST(FoldedSamples, ASpectrumFromChannelsKeepsItsXyz) {
    for (const char* name : {"D65", "FL11", "LED-B3"}) {
        const SpectralContent content{{library_light(name)}, colour_checker()};
        const Wavelengths w = folded(12, content);
        const std::vector<double> emission = emission_channels(w, content.lights[0]);
        const Xyz white = xyz_from_channels(w, emission);
        // It ends at 380 and 780 nm; the tails beyond hold 3e-4 of D65's Z.
        EXPECT_LT(glm::distance(xyz_from_spectrum(spectrum_from_channels(w, emission)), white), 4e-4 * white.y) << name;
        // A paint is a polygon through its samples there, hence close and not exact.
        for (const Spectrum& paint : content.reflectances) {
            const std::vector<double> seen = times(emission, reflectance_channels(w, paint));
            const Xyz exact = xyz_from_channels(w, std::span<const double>(seen));
            const double off = delta_e_2000(lab_from_xyz(xyz_from_spectrum(spectrum_from_channels(w, seen)), white),
                                            lab_from_xyz(exact, white));
            EXPECT_LT(off, 3) << name;
        }
    }
}

TEST(FoldedSamples, ReflectancesThatTouchZeroAndOne) {
    const Spectrum black{{380, 780}, {0, 0}}, white{{380, 780}, {1, 1}}, step{{380, 559, 561, 780}, {0, 0, 1, 1}};
    const SpectralContent content{{library_light("D65")}, {black, white, step}};
    const WavelengthsPlan plan = plan_wavelengths({WavelengthRule::automatic, 0}, content, 0.5);
    EXPECT_LE(plan.prediction.worst, 0.5) << plan.reason;
    for (const Spectrum& paint : content.reflectances)
        for (const double channel : reflectance_channels(plan.wavelengths, paint)) {
            EXPECT_GE(channel, 0);
            EXPECT_LE(channel, 1);
        }
    EXPECT_LT(true_differences(plan.wavelengths, content.lights[0], content.reflectances).worst, 0.5);
    const std::vector<double> emission = emission_channels(plan.wavelengths, content.lights[0]);
    EXPECT_EQ(xyz_from_channels(plan.wavelengths, times(emission, reflectance_channels(plan.wavelengths, black))),
              Xyz(0));
}

void expect_finite(const Wavelengths& w) {
    for (std::size_t k = 0; k < w.nm.size(); ++k) {
        EXPECT_TRUE(std::isfinite(w.watt_weight[k]));
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(w.xyz_weight[k][c]));
    }
    for (const double norm : w.light_norm) EXPECT_GT(norm, 0);
}

TEST(FoldedSamples, WithoutALightThereIsEqualEnergy) {
    const SpectralContent dark{{}, colour_checker()};
    for (const WavelengthsSpec spec : {WavelengthsSpec{WavelengthRule::automatic, 0}, {WavelengthRule::folded, 8}}) {
        const WavelengthsPlan plan = plan_wavelengths(spec, dark, 0.5);
        ASSERT_GT(plan.wavelengths.size(), 0);
        expect_finite(plan.wavelengths);
        for (const double channel : emission_channels(plan.wavelengths, library_light("A"))) EXPECT_EQ(channel, 0);
    }
    const WavelengthsPlan nothing = plan_wavelengths({WavelengthRule::automatic, 0}, {}, 0.5);
    ASSERT_GT(nothing.wavelengths.size(), 0);
    expect_finite(nothing.wavelengths);
}

TEST(FoldedSamples, LightsThatNobodySees) {
    const Spectrum off{{380, 780}, {0, 0}}, ultraviolet{{300, 320, 340}, {0, 1, 0}}, infrared{{900, 950}, {1, 1}};
    for (const Spectrum& unseen : {off, ultraviolet, infrared}) {
        const SpectralContent alone{{unseen}, colour_checker()}, beside{{library_light("A"), unseen}, colour_checker()};
        for (const SpectralContent& content : {alone, beside}) {
            const WavelengthsPlan plan = plan_wavelengths({WavelengthRule::automatic, 0}, content, 0.5);
            ASSERT_GT(plan.wavelengths.size(), 0);
            expect_finite(plan.wavelengths);
            EXPECT_LE(plan.prediction.worst, 0.5);
            EXPECT_EQ(xyz_from_channels(plan.wavelengths, emission_channels(plan.wavelengths, unseen)), Xyz(0));
        }
    }
    // Deep violet is watts and hardly light: the watts are there.
    const Spectrum violet{{381, 383, 385}, {0, 1, 0}};
    const Wavelengths w = folded(4, {{violet}, colour_checker()});
    expect_finite(w);
    EXPECT_NEAR(watts_from_channels(w, emission_channels(w, violet)), 2, 1e-9);
}

TEST(FoldedSamples, TheScaleOfALightDoesNotMatter) {
    SpectralContent content{{library_light("FL2")}, colour_checker()};
    const Wavelengths w = folded(8, content);
    for (const double scale : {1e-30, 1e-6, 1e30}) {
        SpectralContent scaled_content = content;
        for (double& value : scaled_content.lights[0].value) value *= scale;
        const Wavelengths scaled = folded(8, scaled_content);
        EXPECT_EQ(scaled.nm, w.nm) << scale;
        for (std::size_t k = 0; k < w.nm.size(); ++k)
            EXPECT_LT(glm::distance(scaled.xyz_weight[k], w.xyz_weight[k]), 1e-6) << scale;
    }
}

// Against a plain solution of the same normal equations.
TEST(SubsetMisfit, IsTheLeastSquaresMisfit) {
    Eigen::MatrixXd a(6, 4);
    a << 1, .9, .7, .2, .3, .5, .8, .9, .4, .4, .5, .1, .2, .1, .1, .9, .6, .8, .5, .3, .7, .2, .3, .6;
    Eigen::VectorXd t(6);
    t << .8, .6, .35, .3, .55, .45;
    const SubsetMisfit misfit(a, t, 1, 0);
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(4);
    misfit.add_with_one_more({1}, 0, 3, sums);
    for (const int c : {0, 2, 3}) {
        // w on column c, 1 - w on column 1.
        const Eigen::VectorXd direction = a.col(c) - a.col(1), rest = t - a.col(1);
        const double w = direction.dot(rest) / direction.squaredNorm();
        EXPECT_NEAR(sums[c], (rest - w * direction).squaredNorm(), 1e-4 * t.squaredNorm());
    }
    EXPECT_TRUE(std::isinf(sums[1])) << "already there";
}

} // namespace
} // namespace lueur
