// Error figures of points whose answer is known, with and without noise in the reference.
#include "core/view/error_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

using namespace lueur;

namespace {

std::vector<Irradiance> lux(const std::vector<double>& values, double standard_error_percent = 0) {
    std::vector<Irradiance> result;
    for (const double value : values) {
        result.emplace_back();
        result.back().illuminance_lx = value;
        result.back().standard_error_percent = standard_error_percent;
    }
    return result;
}

} // namespace

TEST(ErrorStatistics, RootOfTheMeanSquareMedianAndPercentile) {
    // 100 points that show 1 %, 2 % ... 100 % less or more than the truth: relative to the larger of both.
    std::vector<double> values, errors;
    double square = 0, of_truth = 0;
    for (int i = 1; i <= 100; ++i) {
        values.push_back(100 + (i % 2 == 0 ? i : -i));
        errors.push_back(i % 2 == 0 ? i / (100.0 + i) : i / 100.0);
        square += errors.back() * errors.back() / 100;
        of_truth += 1e-4 * i * i / 100;
    }
    std::ranges::sort(errors);
    const ErrorStatistics e = error_statistics(lux(values), lux(std::vector<double>(100, 100)));
    EXPECT_NEAR(e.rms, std::sqrt(square), 1e-12);
    EXPECT_NEAR(e.rms_of_truth, std::sqrt(of_truth), 1e-12);
    EXPECT_NEAR(e.rms_without_noise, e.rms, 1e-12);
    EXPECT_NEAR(e.median, errors[50], 1e-12);
    EXPECT_NEAR(e.percentile95, errors[95], 1e-12);
    EXPECT_EQ(e.counted, 100);
    EXPECT_EQ(e.reference_error, 0);
    EXPECT_EQ(e.resolution, 0);
}

// One crevice that shows thirty times its light does not decide the figure of a hundred points.
TEST(ErrorStatistics, NothingIsMoreThanWhollyWrong) {
    std::vector<double> values(100, 101), truth(100, 100);
    truth[7] = 3, values[7] = 90;
    const ErrorStatistics e = error_statistics(lux(values), lux(truth));
    EXPECT_NEAR(e.rms, 0.1, 0.005);
    EXPECT_NEAR(e.rms_of_truth, 2.9, 0.005);
}

TEST(ErrorStatistics, DarkPointsDoNotCountAndMissingOnesAreTold) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    // The mean of the reference is 50; 2 % of it is 1.
    const ErrorStatistics e = error_statistics(lux({110, 90, 0.1, nan, 55}), lux({100, 100, 0.9, 0, 49.1}));
    EXPECT_EQ(e.counted, 3);
    EXPECT_EQ(e.missing, 0) << "a dark point is not missed";
    const ErrorStatistics m = error_statistics(lux({110, nan, INFINITY}), lux({100, 100, 100}));
    EXPECT_EQ(m.counted, 1);
    EXPECT_EQ(m.missing, 2);
    EXPECT_NEAR(m.rms, 10.0 / 110, 1e-12);
}

TEST(ErrorStatistics, NothingToCompareIsWhollyWrongNotANumberLess) {
    for (const ErrorStatistics& e : {error_statistics({}, {}), error_statistics(lux({1, 2}), lux({0, 0}))}) {
        EXPECT_EQ(e.counted, 0);
        EXPECT_EQ(e.rms, 1);
        EXPECT_EQ(e.median, 1);
        EXPECT_EQ(e.percentile95, 1);
        EXPECT_EQ(e.rms_without_noise, 1);
    }
}

// A method with an error of 3 % RMS against a reference with 4 %: 5 % are seen, 3 % are told. A method without error
// is below the resolution.
TEST(ErrorStatistics, TheReferencesNoiseIsTakenOff) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    std::vector<double> exact(4000, 200), wrong, noisy;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        wrong.push_back(200 * (1 + 0.03 * normal(random)));
        noisy.push_back(200 * (1 + 0.04 * normal(random)));
    }
    const ErrorStatistics e = error_statistics(lux(wrong), lux(noisy, 4));
    EXPECT_NEAR(e.rms, 0.05, 0.002);
    EXPECT_NEAR(e.rms_without_noise, 0.03, 0.003);
    EXPECT_NEAR(e.reference_error, 0.04, 1e-12);
    const ErrorStatistics none = error_statistics(lux(exact), lux(noisy, 4));
    EXPECT_NEAR(none.rms, 0.04, 0.002);
    EXPECT_LE(none.rms_without_noise, 1.3 * none.resolution);
    EXPECT_LT(none.resolution, 0.013);
}
