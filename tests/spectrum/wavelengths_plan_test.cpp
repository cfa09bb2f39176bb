// How many wavelengths are enough: what is predicted against what is true.
#include "core/spectrum/wavelengths_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/spectrum/rendering_index.h"
#include "tests/spectrum/library_spectra.h"

namespace lueur {
namespace {

constexpr WavelengthsSpec automatic{WavelengthRule::automatic, 0};
constexpr double target = 0.5;
constexpr std::size_t every_seventh = 7; // of the 2,600 products of three patches

TEST(WavelengthsPlan, EightyOneChannelsAreTheTruth) {
    for (const char* name : {"A", "D65", "FL2", "FL11", "LED-B1", "LED-B3", "LED-RGB1", "HP1"}) {
        const SpectralContent content{{library_light(name)}, colour_checker()};
        const Wavelengths truth = make_wavelengths({WavelengthRule::uniform, 81}, content);
        EXPECT_LT(true_differences(truth, content.lights[0], content.reflectances).worst, 0.05) << name;
        const Differences three = true_differences(truth, content.lights[0], content.reflectances, every_seventh);
        EXPECT_LT(three.mean, 0.02) << name;
        EXPECT_LT(three.worst, 0.2) << name;
    }
}

TEST(WavelengthsPlan, AutoMeetsItsTargetAfterThreeBounces) {
    for (const char* name : {"A", "D65", "FL2", "FL11", "LED-B1", "LED-B3", "LED-RGB1", "HP1"}) {
        const SpectralContent content{{library_light(name)}, colour_checker()};
        const WavelengthsPlan plan = plan_wavelengths(automatic, content, target);
        EXPECT_TRUE(plan.wavelengths.folded()) << name;
        EXPECT_LE(plan.prediction.worst, target) << name;
        const Differences one = true_differences(plan.wavelengths, content.lights[0], content.reflectances),
                          three = true_differences(plan.wavelengths, content.lights[0], content.reflectances,
                                                   every_seventh);
        EXPECT_LT(three.mean, 0.2) << name;
        EXPECT_LT(three.worst, target + 0.05) << name;
        EXPECT_LT(one.worst, target + 0.05) << name;
    }
    for (const char* smooth : {"A", "C", "D50", "D55", "D65", "D75", "E"})
        EXPECT_LE(plan_wavelengths(automatic, {{library_light(smooth)}, colour_checker()}, target).wavelengths.size(),
                  12)
            << smooth;
}

// Lights of the library on every patch, and on the products of three that are hardest and every so many others.
TEST(WavelengthsPlan, ThePredictionIsTrueForLightsAndPatchesOfTheLibrary) {
    constexpr std::size_t every_so_many = 53;
    std::size_t number = 0;
    for (const NamedSpectrum& light : library_lights()) {
        if (number++ % 3 != 1) continue; // for speed: it holds for all of them
        const SpectralContent content{{light.spectrum}, colour_checker()};
        const WavelengthsPlan plan = plan_wavelengths(automatic, content, target);
        EXPECT_LE(plan.prediction.worst, target) << light.name << ": " << plan.reason;
        const Differences one = true_differences(plan.wavelengths, light.spectrum, content.reflectances);
        Differences three = true_differences(plan.wavelengths, light.spectrum, content.reflectances, every_so_many);
        EXPECT_NEAR(three.mean, plan.prediction.mean, 0.05) << light.name;
        const LightOnPaints lit(plan.wavelengths, light.spectrum);
        for (const Spectrum& reflectance : content.reflectances) {
            const LightOnPaints::Paint paint = lit.paint(reflectance);
            three.add(lit.difference({&paint, &paint, &paint}));
        }
        // The prediction integrates between whole nanometres, the test sums at them.
        EXPECT_LT(std::max(one.worst, three.worst), plan.prediction.worst + 0.05) << light.name;
    }
}

// For rules that are far off, too, the prediction is the truth: that is what `lueur plan` says of them.
TEST(WavelengthsPlan, ThePredictionIsTrueForEveryRule) {
    const std::vector<Spectrum> cornell = library_paints("Cornell box");
    for (const char* text : {"meyer:4", "gauss:10", "uniform:10", "uniform:31", "folded:4", "rgb"})
        for (const char* name : {"D65", "FL11", "LED-B3"}) {
            const SpectralContent content{{library_light(name)}, cornell};
            const Wavelengths w = make_wavelengths(parse_wavelengths(text).value(), content);
            const ColourPrediction predicted = predict_difference(w, content);
            const LightOnPaints lit(w, content.lights[0]);
            std::vector<LightOnPaints::Paint> paint; // and a mixture of them
            for (const Spectrum& reflectance : with_interreflection(cornell)) paint.push_back(lit.paint(reflectance));
            Differences differences;
            differences.add(lit.difference({}));
            for (std::size_t a = 0; a < paint.size(); ++a) {
                differences.add(lit.difference({&paint[a]}));
                for (std::size_t b = a; b < paint.size(); ++b) {
                    differences.add(lit.difference({&paint[a], &paint[b]}));
                    for (std::size_t c = b; c < paint.size(); ++c)
                        differences.add(lit.difference({&paint[a], &paint[b], &paint[c]}));
                }
            }
            EXPECT_NEAR(differences.worst, predicted.worst, 0.02 + 1e-3 * predicted.worst) << text << ' ' << name;
            EXPECT_NEAR(differences.mean, predicted.mean, 0.02 + 1e-3 * predicted.mean) << text << ' ' << name;
        }
}

// A paint that the fit has not seen: planned on every other patch, looked at on the rest and on the test colours of CIE
// 13.3 (saturated ones among them), up to three bounces. Measured over all lights of the library: 0.24 on average, 0.42
// for the worst light, 3.1 for the worst product, where the paints that were seen have 0.5 at worst: then the editor
// plans anew (EditsKeepTheWavelengthsWhileThePredictionHolds).
TEST(WavelengthsPlan, ReflectancesThatTheFitHasNotSeen) {
    std::vector<Spectrum> seen, unseen, test_colours;
    const std::vector<Spectrum> all = colour_checker();
    for (std::size_t i = 0; i < all.size(); ++i) (i % 2 == 0 ? seen : unseen).push_back(all[i]);
    for (int number = 1; number <= test_colour_count; ++number) test_colours.push_back(test_colour_sample(number));
    Differences means;
    double worst = 0;
    std::size_t number = 0;
    for (const NamedSpectrum& light : library_lights()) {
        if (number++ % 3 != 0) continue; // for speed: the bounds were measured on all of them
        const WavelengthsPlan plan = plan_wavelengths(automatic, {{light.spectrum}, seen}, target);
        for (const auto& paints : {unseen, test_colours}) {
            const ColourPrediction truth = predict_difference(plan.wavelengths, {{light.spectrum}, paints});
            means.add(truth.mean);
            worst = std::max(worst, truth.worst);
        }
    }
    RecordProperty("mean", std::to_string(means.mean));
    RecordProperty("worst_mean", std::to_string(means.worst));
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LT(means.mean, 0.3);
    EXPECT_LT(means.worst, 0.5);
    EXPECT_LT(worst, 3.2);
}

TEST(WavelengthsPlan, MoreSamplesForASmallerTarget) {
    const SpectralContent content{{library_light("D65")}, library_paints("Cornell box")};
    int before = 0;
    for (const double wanted : {10.0, 2.0, 0.5, 0.1}) {
        const WavelengthsPlan plan = plan_wavelengths(automatic, content, wanted);
        EXPECT_GT(plan.wavelengths.size(), before) << wanted;
        EXPECT_LE(plan.prediction.worst, wanted);
        EXPECT_THAT(plan.reason, testing::HasSubstr("predicted dE2000"));
        before = plan.wavelengths.size();
    }
}

TEST(WavelengthsPlan, EditsKeepTheWavelengthsWhileThePredictionHolds) {
    SpectralContent content{{library_light("LED-B3")}, colour_checker()};
    const WavelengthsPlan first = plan_wavelengths(automatic, content, target);
    // A paint less, and the lamp dimmed by its spectrum's scale: kept as they are.
    content.reflectances.pop_back();
    const WavelengthsPlan second = plan_wavelengths(automatic, content, target, &first.wavelengths);
    EXPECT_EQ(second.wavelengths.nm, first.wavelengths.nm);
    EXPECT_THAT(second.reason, testing::HasSubstr("kept"));
    // A lamp for which they still are good enough: kept, with weights of its own.
    for (const char* name : {"LED-B2", "LED-B4", "A", "FL11", "HP1"}) {
        const Spectrum lamp = library_light(name);
        content.lights = {lamp};
        const WavelengthsPlan third = plan_wavelengths(automatic, content, target, &first.wavelengths);
        EXPECT_LE(third.prediction.worst, target) << name;
        const bool kept = third.wavelengths.nm == first.wavelengths.nm;
        EXPECT_EQ(kept, third.reason.ends_with("kept")) << name;
        const Xyz exact = xyz_from_spectrum(lamp);
        EXPECT_LT(
            glm::distance(xyz_from_channels(third.wavelengths, emission_channels(third.wavelengths, lamp)), exact),
            1e-6 * exact.y);
    }
    // A paint that breaks the target: planned anew.
    const Spectrum filter{{380, 569, 571, 579, 581, 780}, {0, 0, 1, 1, 0, 0}};
    content.lights = {library_light("LED-B3")};
    content.reflectances.push_back(filter);
    const WavelengthsPlan fourth = plan_wavelengths(automatic, content, target, &first.wavelengths);
    EXPECT_NE(fourth.wavelengths.nm, first.wavelengths.nm);
    EXPECT_GT(predict_difference(first.wavelengths, content).worst, target);
    // Another rule is never "kept".
    EXPECT_EQ(plan_wavelengths({WavelengthRule::uniform, 31}, content, target, &first.wavelengths).wavelengths.size(),
              31);
}

TEST(WavelengthsPlan, ManyDifferentLampsAreSolvedInUniformChannels) {
    SpectralContent content{{}, library_paints("Cornell box")};
    for (const NamedSpectrum& lamp : library_lights()) {
        if (content.lights.size() == 40) break;
        content.lights.push_back(lamp.spectrum);
    }
    const WavelengthsPlan plan = plan_wavelengths(automatic, content, target);
    EXPECT_FALSE(plan.wavelengths.folded());
    EXPECT_LE(plan.wavelengths.size(), max_channels);
    EXPECT_EQ(plan.wavelengths.asked, automatic);
    // What was asked for and does not fit is said.
    const WavelengthsPlan folded = plan_wavelengths({WavelengthRule::folded, 8}, content, target);
    EXPECT_FALSE(folded.wavelengths.folded());
    EXPECT_THAT(folded.reason, testing::HasSubstr("more than the 96 channels"));
}

} // namespace
} // namespace lueur
