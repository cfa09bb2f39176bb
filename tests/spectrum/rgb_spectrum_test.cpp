// RGB -> smooth spectrum -> RGB under D65, over the whole sRGB cube.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "core/spectrum/chromatic_adaptation.h"
#include "core/spectrum/colour.h"
#include "core/spectrum/observer.h"
#include "core/spectrum/rgb_spectrum.h"

namespace lueur {
namespace {

// Linear sRGB of a reflectance under D65 to an eye adapted to the table's white, (0.31272, 0.32903), which is in the
// fifth digit not sRGB's: the perfect reflector has (1,1,1). Sampled each 0.5 nm.
Rgb rgb_under_d65(const Spectrum& reflectance) {
    Xyz sum(0), white(0);
    for (int i = 720; i <= 1560; ++i) {
        const double nm = i / 2.0;
        const Xyz light = value_at(illuminant_d65(), nm, Outside::zero) * observer_xyz(nm);
        const double weight = i == 720 || i == 1560 ? 0.5 : 1; // trapezoidal rule
        sum += weight * value_at(reflectance, nm, Outside::constant) * light;
        white += weight * light;
    }
    const Xyz srgb_white = xyz_from_rgb(srgb) * Rgb(1);
    return rgb_from_xyz(srgb) * (bradford_adaptation(white, srgb_white) * sum);
}

double largest_difference(const Rgb& a, const Rgb& b) {
    const Rgb d = glm::abs(a - b);
    return std::max(d.r, std::max(d.g, d.b));
}

double roughness(const Spectrum& s) { // largest second difference at 5 nm
    double largest = 0;
    for (std::size_t i = 2; i < s.value.size(); ++i)
        largest = std::max(largest, std::abs(s.value[i] - 2 * s.value[i - 1] + s.value[i - 2]));
    return largest;
}

TEST(RgbSpectrum, IsBoundedAndGivesEveryColourOfTheCubeBack) {
    for (int r = 0; r <= 8; ++r) {
        for (int g = 0; g <= 8; ++g) {
            for (int b = 0; b <= 8; ++b) {
                const Rgb rgb(srgb_decode(r / 8.0), srgb_decode(g / 8.0), srgb_decode(b / 8.0)); // corners included
                const Spectrum s = reflectance_from_rgb(rgb);
                ASSERT_EQ(s.nm.size(), 81u);
                for (const double value : s.value) {
                    ASSERT_TRUE(std::isfinite(value)) << r << g << b;
                    ASSERT_GE(value, 0);
                    ASSERT_LE(value, 1);
                }
                // The fit is exact to 1e-10; what remains is the 0.5 nm sampling here.
                EXPECT_LT(largest_difference(rgb_under_d65(s), rgb), 2e-5) << r << " " << g << " " << b;
            }
        }
    }
}

TEST(RgbSpectrum, OfGreyIsFlat) {
    for (const double grey : {0.0, 1e-9, 0.18, 0.5, 0.999, 1.0})
        for (const double value : reflectance_from_rgb(Rgb(grey)).value) EXPECT_EQ(value, grey);
}

TEST(RgbSpectrum, OfEverydayColoursIsSmooth) {
    for (const Rgb& rgb : {Rgb(0.6, 0.1, 0.08), Rgb(0.15, 0.4, 0.1), Rgb(0.1, 0.2, 0.5), Rgb(0.7, 0.6, 0.45)})
        EXPECT_LT(roughness(reflectance_from_rgb(rgb)), 0.01);
}

TEST(RgbSpectrum, ChangesLittleWhenTheColourDoes) {
    // Dragging a colour must not make the spectrum jump.
    Spectrum before = reflectance_from_rgb(Rgb(0.2, 0.3, 0.0));
    for (int i = 1; i <= 200; ++i) {
        const Spectrum next = reflectance_from_rgb(Rgb(0.2, 0.3, i * 0.005));
        for (std::size_t k = 0; k < next.value.size(); ++k) EXPECT_NEAR(next.value[k], before.value[k], 0.08) << i;
        before = next;
    }
}

TEST(RgbSpectrum, BoundsInputThatIsNoReflectance) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(reflectance_from_rgb(Rgb(2, inf, 1)), reflectance_from_rgb(Rgb(1)));
    EXPECT_EQ(reflectance_from_rgb(Rgb(-1, nan, -inf)), reflectance_from_rgb(Rgb(0)));
}

} // namespace
} // namespace lueur
