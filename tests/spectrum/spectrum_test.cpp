// Measured spectra as piecewise linear functions, and Planck's law.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "core/spectrum/spectrum.h"

namespace lueur {
namespace {

TEST(Spectrum, IsMadeFromSortedFiniteSamples) {
    const auto made = make_spectrum({400, 500, 700}, {0.1, 0.2, 0.3});
    ASSERT_TRUE(made);
    EXPECT_EQ(made->nm, (std::vector<double>{400, 500, 700}));
    EXPECT_EQ(made->value, (std::vector<double>{0.1, 0.2, 0.3}));
}

TEST(Spectrum, RefusesBadSamplesAndNamesThem) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const auto error = [](std::vector<double> nm, std::vector<double> value) {
        const auto made = make_spectrum(std::move(nm), std::move(value));
        return made ? std::string() : made.error();
    };
    EXPECT_NE(error({400, 500}, {1}).find("2 wavelengths but 1 values"), std::string::npos);
    EXPECT_NE(error({400}, {1}).find("two or more"), std::string::npos);
    EXPECT_NE(error({}, {}).find("two or more"), std::string::npos);
    EXPECT_NE(error({400, 600, 500}, {1, 1, 1}).find("sample 3: wavelength 500 follows 600"), std::string::npos);
    EXPECT_NE(error({400, 400}, {1, 2}).find("sample 2: wavelength 400 repeats"), std::string::npos);
    EXPECT_NE(error({-1, 400}, {1, 2}).find("sample 1: wavelength -1"), std::string::npos);
    EXPECT_NE(error({400, nan}, {1, 2}).find("sample 2"), std::string::npos);
    EXPECT_NE(error({400, inf}, {1, 2}).find("sample 2"), std::string::npos);
    EXPECT_NE(error({400, 500}, {nan, 2}).find("sample 1: value nan"), std::string::npos);
    EXPECT_NE(error({400, 500}, {1, -inf}).find("sample 2: value -inf"), std::string::npos);
}

TEST(Spectrum, IsLinearBetweenSamplesAndZeroOrConstantOutside) {
    const Spectrum s{{400, 500, 600}, {1, 3, 2}};
    EXPECT_DOUBLE_EQ(value_at(s, 400, Outside::zero), 1);
    EXPECT_DOUBLE_EQ(value_at(s, 450, Outside::zero), 2);
    EXPECT_DOUBLE_EQ(value_at(s, 500, Outside::zero), 3);
    EXPECT_DOUBLE_EQ(value_at(s, 575, Outside::zero), 2.25);
    EXPECT_DOUBLE_EQ(value_at(s, 600, Outside::zero), 2);
    EXPECT_DOUBLE_EQ(value_at(s, 399.999, Outside::zero), 0);
    EXPECT_DOUBLE_EQ(value_at(s, 600.001, Outside::zero), 0);
    EXPECT_DOUBLE_EQ(value_at(s, 100, Outside::constant), 1);
    EXPECT_DOUBLE_EQ(value_at(s, 900, Outside::constant), 2);
}

TEST(Spectrum, IntegralIsTheAreaOfTheTrapezia) {
    const Spectrum s{{400, 500, 600}, {1, 3, 2}};
    // (1 + 3) / 2 * 100 + (3 + 2) / 2 * 100
    EXPECT_NEAR(integral(s, 400, 600, Outside::zero), 450, 1e-9);
    EXPECT_NEAR(integral(s, 0, 1000, Outside::zero), 450, 1e-9);
    // 450 to 550: (2 + 3) / 2 * 50 + (3 + 2.5) / 2 * 50
    EXPECT_NEAR(integral(s, 450, 550, Outside::zero), 262.5, 1e-9);
    EXPECT_NEAR(integral(s, 300, 700, Outside::constant), 450 + 100 * 1 + 100 * 2, 1e-9);
    EXPECT_NEAR(integral(s, 600, 400, Outside::zero), -450, 1e-9);
    EXPECT_EQ(integral(s, 700, 800, Outside::zero), 0);
    EXPECT_EQ(integral(s, 500, 500, Outside::constant), 0);
}

TEST(Spectrum, IntegralFindsANarrowLineWhereverItStands) {
    // A triangle of base 0.02 nm and height 100: area 1. Sampling each nm would miss it.
    const Spectrum line{{546.06, 546.07, 546.08}, {0, 100, 0}};
    EXPECT_NEAR(integral(line, 360, 830, Outside::zero), 1, 1e-9);
    EXPECT_NEAR(integral(line, 546.07, 830, Outside::zero), 0.5, 1e-9);
}

TEST(Blackbody, IsPlancksLawRelativeToThe560NmValue) {
    const double kelvin = 3000;
    const Spectrum s = blackbody(kelvin);
    EXPECT_EQ(s.nm.front(), 300);
    EXPECT_EQ(s.nm.back(), 830);
    EXPECT_EQ(s.nm.size(), 107u);
    EXPECT_NEAR(value_at(s, 560, Outside::zero), 1, 1e-15);
    // h c / k from the exact constants of the SI of 2019.
    const double c2 = 6.62607015e-34 * 299792458.0 / 1.380649e-23;
    const auto planck = [&](double nm) { return std::pow(nm * 1e-9, -5) / (std::exp(c2 / (nm * 1e-9 * kelvin)) - 1); };
    for (const double nm : {300.0, 400.0, 555.0, 700.0, 830.0})
        EXPECT_NEAR(value_at(s, nm, Outside::zero), planck(nm) / planck(560), 1e-8 * planck(nm) / planck(560)) << nm;
}

TEST(Blackbody, PeaksWhereWienSaysAndStaysFinite) {
    // Wien: lambda T = 2.897771955e-3 m K, so 4600 K peaks at 629.95 nm; the nearest sample is 630 nm.
    const Spectrum s = blackbody(2.897771955e6 / 630);
    const auto peak = std::max_element(s.value.begin(), s.value.end()) - s.value.begin();
    EXPECT_EQ(s.nm[static_cast<std::size_t>(peak)], 630);
    for (const double kelvin : {1.0, 20.0, 1000.0, 25000.0, 1e9}) {
        for (const double value : blackbody(kelvin).value) {
            EXPECT_TRUE(std::isfinite(value)) << kelvin;
            EXPECT_GE(value, 0) << kelvin;
        }
    }
}

} // namespace
} // namespace lueur
