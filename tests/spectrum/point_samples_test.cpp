// The lecture's unequal wavelengths against what Meyer published and what their failures are known to be.
#include "core/spectrum/point_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/spectrum/library_spectra.h"

namespace lueur {
namespace {

constexpr double equal_energy_y = 106.856426; // sum of ybar, 380..780 nm at 1 nm (ISO/CIE 11664-1)

TEST(MeyerSamples, FourAreThePublishedOnes) {
    // G. W. Meyer 1988 (CVGIP 41), to the digits printed there: 456.4, 490.9, 557.7, 631.4 nm. Weights: the same
    // paper's samples to AC1C2, brought to XYZ, equal energy having Y = 1.
    const PointSamples samples = meyer_samples(4);
    const double nm[] = {456.4, 490.9, 557.7, 631.4};
    const Xyz weight[] = {{0.18778, -0.00329, 0.91052},
                          {-0.05385, 0.17541, 0.08805},
                          {0.46645, 0.63995, 0.07618},
                          {0.39967, 0.18793, -0.07474}};
    ASSERT_EQ(samples.nm.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(samples.nm[k], nm[k], 0.1) << "557.76 is printed as 557.7";
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(samples.weight[k][c] / equal_energy_y, weight[k][c], 2e-4) << nm[k];
    }
}

TEST(MeyerSamples, SixAndTenAreGaussianNodesOfItsAxes) {
    // Recomputed independently from the observer, 380..780 nm at 1 nm, for these orders of A, C1, C2.
    const double six[] = {456.4279, 483.0589, 490.8792, 557.7634, 631.4427, 632.3208};
    const double ten[] = {443.9677, 450.6625, 457.6764, 509.7674, 529.4224,
                          592.6354, 618.4706, 631.6856, 660.7981, 679.6675};
    const Xyz weights_of_ten[] = {{18.731447, -0.3285188, 90.824944},  {-2.9931019, -0.060341104, 1.0830507},
                                  {3.4447129, 4.7259976, 0.56254821},  {-20.441083, -0.4120934, 7.3965839},
                                  {37.312602, 51.191281, 6.093436},    {34.087538, 46.766633, 5.5667582},
                                  {29.600942, 0.59675666, -10.711069}, {1.3317373, -0.023356484, 6.457321},
                                  {3.1687724, 4.3474191, 0.51748499},  {2.6115189, 0.052648369, -0.94497529}};
    const PointSamples samples_six = meyer_samples(6), samples_ten = meyer_samples(10);
    ASSERT_EQ(samples_six.nm.size(), 6u);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(samples_six.nm[k], six[k], 1e-3);
    ASSERT_EQ(samples_ten.nm.size(), 10u);
    for (std::size_t k = 0; k < 10; ++k) {
        EXPECT_NEAR(samples_ten.nm[k], ten[k], 1e-3);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(samples_ten.weight[k][c], weights_of_ten[k][c], 5e-3) << ten[k];
    }
}

// CIELAB differences of the 24 ColorChecker patches from the 1 nm integral, computed independently with the published
// nodes: against the white of the true light, and each against its own white.
TEST(MeyerSamples, FailAsTheyAreKnownToFail) {
    const std::vector<std::string> smooth{"A", "C", "D50", "D65", "E"},
        led{"LED-B1", "LED-B2", "LED-B3", "LED-B4", "LED-B5", "LED-BH1", "LED-RGB1", "LED-V1", "LED-V2"},
        fluorescent{"FL2", "FL7", "FL11", "FL12"}, discharge{"HP1", "HP3", "HP4"};
    const struct {
        int count;
        const std::vector<std::string>& lights;
        double mean, worst, own_mean, own_worst;
    } known[] = {
        {4, smooth, 13.778, 258.172, 13.087, 271.221},       {4, led, 66.626, 982.436, 84.695, 2055.47},
        {4, fluorescent, 21.128, 148.956, 20.88, 276.819},   {4, discharge, 34.601, 214.078, 29.681, 392.759},
        {6, smooth, 13.654, 260.836, 12.978, 274.028},       {6, led, 66.976, 990.461, 88.062, 2158.25},
        {6, fluorescent, 22.466, 151.715, 23.1, 301.864},    {6, discharge, 35.399, 218.192, 30.618, 406.566},
        {10, smooth, 4.444, 18.161, 3.858, 18.161},          {10, led, 20.6, 103.803, 7.188, 81.436},
        {10, fluorescent, 42.223, 245.066, 40.676, 598.302}, {10, discharge, 27.578, 82.059, 12.399, 57.334},
    };
    const std::vector<Spectrum> paints = library_paints("ColorChecker");
    ASSERT_EQ(paints.size(), 24u);
    for (const auto& row : known) {
        const Wavelengths wavelengths = make_wavelengths({WavelengthRule::meyer, row.count});
        Differences true_white, own_white;
        for (const std::string& name : row.lights) {
            const Spectrum light = library_light(name);
            const std::vector<double> emission = emission_channels(wavelengths, light),
                                      fine = each_nanometre(light, Outside::zero);
            const Xyz white = summed_xyz(fine), own = xyz_from_channels(wavelengths, emission);
            for (const Spectrum& paint : paints) {
                const Lab truth =
                    lab_from_xyz(summed_xyz(times(fine, each_nanometre(paint, Outside::constant))), white);
                const std::vector<double> product = times(emission, reflectance_channels(wavelengths, paint));
                const Xyz seen = xyz_from_channels(wavelengths, product);
                true_white.add(delta_e_ab(truth, lab_from_xyz(seen, white)));
                own_white.add(delta_e_ab(truth, lab_from_xyz(seen, own)));
            }
        }
        // The four nodes are not rounded to 0.1 nm here, which moves the far-off colours of LEDs by up to 1.3 %.
        const double within = row.count == 4 ? 0.013 : 1e-3;
        EXPECT_NEAR(true_white.mean, row.mean, within * row.mean) << row.count << " under " << row.lights[0];
        EXPECT_NEAR(true_white.worst, row.worst, within * row.worst) << row.count << " under " << row.lights[0];
        EXPECT_NEAR(own_white.mean, row.own_mean, within * row.own_mean) << row.count << " under " << row.lights[0];
        EXPECT_NEAR(own_white.worst, row.own_worst, within * row.own_worst) << row.count << " under " << row.lights[0];
    }
}

// Gaussian quadrature of n nodes is exact to degree 2n - 1 under xbar + ybar + zbar; X, Y and Z by themselves to n - 1.
TEST(GaussSamples, IntegratePolynomialsExactly) {
    for (const int count : {3, 5, 10, 20}) {
        const PointSamples samples = gauss_samples(count);
        ASSERT_EQ(samples.nm.size(), static_cast<std::size_t>(count));
        EXPECT_TRUE(std::ranges::is_sorted(samples.nm));
        EXPECT_GT(samples.nm.front(), 380);
        EXPECT_LT(samples.nm.back(), 780);
        for (int degree = 0; degree < 2 * count; ++degree) {
            const auto power = [&](double nm) { return std::pow((nm - 580) / 200, degree); };
            Xyz exact(0), absolute(0), seen(0);
            for (int nm = 380; nm <= 780; ++nm) {
                exact += power(nm) * observer_xyz(nm);
                absolute += std::abs(power(nm)) * observer_xyz(nm);
            }
            for (std::size_t k = 0; k < samples.nm.size(); ++k) seen += samples.weight[k] * power(samples.nm[k]);
            const double scale = 1e-6 * (absolute.x + absolute.y + absolute.z);
            EXPECT_NEAR(seen.x + seen.y + seen.z, exact.x + exact.y + exact.z, scale) << count << " degree " << degree;
            for (int c = 0; c < 3 && degree < count; ++c)
                EXPECT_NEAR(seen[c], exact[c], scale) << count << " degree " << degree;
        }
    }
}

TEST(PointSamples, WidthsShareTheVisibleRange) {
    for (const PointSamples& samples : {meyer_samples(4), meyer_samples(6), meyer_samples(10), gauss_samples(10)}) {
        double sum = 0;
        for (const double width : samples.width) {
            EXPECT_GT(width, 0);
            sum += width;
        }
        EXPECT_NEAR(sum, 400, 1e-9);
    }
}

// A line between the samples is not seen at all: said to the user by the solution (core/solve/solution.cpp).
TEST(PointSamples, LoseALineBetweenThem) {
    const Wavelengths w = make_wavelengths({WavelengthRule::meyer, 4});
    for (const double channel : emission_channels(w, laser(589))) EXPECT_EQ(channel, 0);
}

} // namespace
} // namespace lueur
