// Bins, sums and products, against closed forms and against their definition at many wavelengths.
#include "core/spectrum/operations.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "core/spectrum/observer_integral.h"
#include "core/spectrum/quadrature.h"

namespace lueur {
namespace {

Spectrum random_spectrum(std::mt19937& random, Interpolation interpolation) {
    std::uniform_real_distribution<double> step(0.001, 30), value(0, 2);
    Spectrum spectrum;
    spectrum.interpolation = interpolation;
    double nm = 350 + 100 * value(random);
    for (int count = 2 + static_cast<int>(random() % 20); count > 0; --count) {
        nm += step(random);
        spectrum.nm.push_back(nm);
        spectrum.value.push_back(value(random));
    }
    return spectrum;
}

// Values of the bins times their widths, by hand.
TEST(Bins, EdgesAreHalfwayAndTheEndsAreSymmetric) {
    const Spectrum s{{400, 410, 430}, {1, 3, 2}, Interpolation::bin};
    EXPECT_EQ(grid(s), (std::vector<double>{395, 405, 420, 440}));
    EXPECT_EQ(first_nm(s), 395);
    EXPECT_EQ(last_nm(s), 440);
    EXPECT_EQ(value_at(s, 395, Outside::zero), 1);
    EXPECT_EQ(value_at(s, 404.9, Outside::zero), 1);
    EXPECT_EQ(value_at(s, 405, Outside::zero), 3) << "an edge is the upper bin's";
    EXPECT_EQ(value_at(s, 419.9, Outside::zero), 3);
    EXPECT_EQ(value_at(s, 425, Outside::zero), 2);
    EXPECT_EQ(value_at(s, 440, Outside::zero), 2);
    EXPECT_EQ(value_at(s, 440.1, Outside::zero), 0);
    EXPECT_EQ(value_at(s, 394.9, Outside::zero), 0);
    EXPECT_EQ(value_at(s, 440.1, Outside::constant), 2);
    EXPECT_EQ(value_at(s, 100, Outside::constant), 1);
    EXPECT_NEAR(integral(s, 0, 1000, Outside::zero), 10 * 1 + 15 * 3 + 20 * 2, 1e-10);
    EXPECT_NEAR(integral(s, 400, 425, Outside::zero), 5 * 1 + 15 * 3 + 5 * 2, 1e-10);
    EXPECT_NEAR(integral(s, 385, 450, Outside::constant), 95 + 10 * 1 + 10 * 2, 1e-10);
    EXPECT_EQ(grid(Spectrum{}), std::vector<double>{});
    EXPECT_EQ(make_spectrum({400, 410}, {1, 2}, Interpolation::bin)->interpolation, Interpolation::bin);
}

// ybar is linear between whole nanometres, so over a bin from a to b its integral is a sum of trapezia.
TEST(Bins, ColourIsTheObserversIntegralOverEachBin) {
    const Spectrum s{{500, 510, 530.5}, {1, 0, 4}, Interpolation::bin};
    const auto y_over = [](double a, double b) {
        double sum = 0;
        for (double nm = a; nm < b;) {
            const double next = std::min(b, std::floor(nm) + 1);
            sum += (next - nm) * (observer_xyz(nm).y + observer_xyz(next).y) / 2;
            nm = next;
        }
        return sum;
    };
    EXPECT_NEAR(observer_integral(s, Outside::zero).y, y_over(495, 505) + 4 * y_over(520.25, 540.75), 1e-10);
    EXPECT_NEAR(observer_integral(piecewise_linear(s), Outside::zero).y, observer_integral(s, Outside::zero).y, 1e-10);
}

TEST(Operations, LinearPiecesOfBinsAreTheSameFunction) {
    std::mt19937 random(3);
    for (int round = 0; round < 50; ++round) {
        const Spectrum bins = random_spectrum(random, Interpolation::bin), pieces = piecewise_linear(bins);
        ASSERT_TRUE(make_spectrum(pieces.nm, pieces.value)) << "strictly increasing";
        EXPECT_EQ(pieces.interpolation, Interpolation::linear);
        EXPECT_NEAR(integral(pieces, 0, 2000, Outside::zero), integral(bins, 0, 2000, Outside::zero), 1e-9);
        for (double nm = first_nm(bins) + 0.0123; nm < last_nm(bins); nm += 0.731)
            EXPECT_DOUBLE_EQ(value_at(pieces, nm, Outside::zero), value_at(bins, nm, Outside::zero)) << nm;
    }
    const Spectrum linear{{400, 500}, {1, 2}};
    EXPECT_EQ(piecewise_linear(linear), linear);
}

TEST(Operations, SumIsTheSumAtEveryWavelengthWhateverTheGrids) {
    std::mt19937 random(4);
    for (int round = 0; round < 200; ++round) {
        const auto kind = [&] { return random() % 2 ? Interpolation::bin : Interpolation::linear; };
        const Spectrum a = random_spectrum(random, kind()), b = random_spectrum(random, kind());
        const Outside outside = random() % 2 ? Outside::zero : Outside::constant;
        const Spectrum both = sum(a, b, outside);
        ASSERT_TRUE(make_spectrum(both.nm, both.value)) << "strictly increasing";
        const double from = std::min(first_nm(a), first_nm(b)), to = std::max(last_nm(a), last_nm(b));
        for (double nm = from + 0.0123; nm < to; nm += 0.731)
            EXPECT_NEAR(value_at(both, nm, outside), value_at(a, nm, outside) + value_at(b, nm, outside), 1e-9) << nm;
        EXPECT_NEAR(integral(both, from, to, outside), integral(a, from, to, outside) + integral(b, from, to, outside),
                    1e-8);
    }
}

TEST(Operations, SumOnOneGridStaysOnIt) {
    const Spectrum a{{400, 500}, {1, 2}, Interpolation::bin}, b{{400, 500}, {3, 5}, Interpolation::bin};
    EXPECT_EQ(sum(a, b), (Spectrum{{400, 500}, {4, 7}, Interpolation::bin}));
    EXPECT_EQ(sum(a, Spectrum{}), a);
    EXPECT_EQ(sum(Spectrum{}, a), a);
    EXPECT_EQ(scaled(a, 2), (Spectrum{{400, 500}, {2, 4}, Interpolation::bin}));
}

TEST(Operations, SumKeepsALineThatFallsBetweenTheOthersSamples) {
    const Spectrum smooth{{380, 780}, {1, 1}}, line{{546.0699, 546.07, 546.0701}, {0, 1e4, 0}}; // of area 1
    const Spectrum both = sum(smooth, line);
    EXPECT_NEAR(integral(both, 380, 780, Outside::zero), 401, 1e-8);
    EXPECT_NEAR(xyz_from_spectrum(both).y, xyz_from_spectrum(smooth).y + 683 * observer_xyz(546.07).y, 1e-4);
}

TEST(Operations, ProductIsWithinItsBoundAndExactWithBins) {
    std::mt19937 random(5);
    for (int round = 0; round < 200; ++round) {
        const auto kind = [&] { return random() % 2 ? Interpolation::bin : Interpolation::linear; };
        const Spectrum light = random_spectrum(random, kind()), paint = random_spectrum(random, kind());
        const Spectrum seen = product(light, paint);
        ASSERT_TRUE(make_spectrum(seen.nm, seen.value)) << "strictly increasing";
        EXPECT_EQ(seen.nm.front(), first_nm(light));
        double largest = 0;
        for (const double value : seen.value) largest = std::max(largest, value);
        const bool exact = light.interpolation == Interpolation::bin || paint.interpolation == Interpolation::bin;
        for (double nm = first_nm(light) + 0.0123; nm < last_nm(light); nm += 0.731)
            EXPECT_NEAR(value_at(seen, nm, Outside::zero),
                        value_at(light, nm, Outside::zero) * value_at(paint, nm, Outside::constant),
                        exact ? 1e-9 : 1.001e-5 * largest)
                << nm;
    }
    EXPECT_TRUE(
        product(Spectrum{{400, 410}, {1, 1}}, Spectrum{{500, 510}, {1, 1}}, Outside::zero, Outside::zero).nm.empty())
        << "they do not overlap";
    EXPECT_TRUE(product(Spectrum{}, Spectrum{{500, 510}, {1, 1}}).nm.empty());
}

// 10,000 samples are no trouble: a second is far above what it needs.
TEST(Operations, TenThousandSamples) {
    Spectrum fine, other;
    for (int i = 0; i < 10000; ++i) {
        fine.nm.push_back(300 + 0.05 * i);
        fine.value.push_back(1 + std::sin(i));
        other.nm.push_back(300.02 + 0.05 * i);
        other.value.push_back(0.5);
    }
    const Spectrum seen = product(fine, other);
    EXPECT_NEAR(integral(seen, 0, 1000, Outside::zero), 0.5 * integral(fine, 0, 1000, Outside::zero), 1e-6);
    EXPECT_GT(xyz_from_spectrum(sum(fine, other)).y, xyz_from_spectrum(fine).y);
}

} // namespace
} // namespace lueur
