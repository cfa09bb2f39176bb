// The three reflectances that texels are mixed of (Mallett & Yuksel 2019).
#include "core/spectrum/rgb_basis.h"

#include <gtest/gtest.h>

#include "core/spectrum/colour.h"
#include "core/spectrum/rgb_spectrum.h"
#include "tests/spectrum/library_spectra.h"

namespace lueur {
namespace {

TEST(RgbBasis, SumsToOneAndIsBounded) {
    const auto& basis = rgb_reflectance_basis();
    for (std::size_t i = 0; i < basis[0].nm.size(); ++i) {
        EXPECT_NEAR(basis[0].value[i] + basis[1].value[i] + basis[2].value[i], 1, 1e-12);
        for (const Spectrum& one : basis) {
            EXPECT_GE(one.value[i], 0);
            EXPECT_LE(one.value[i], 1);
        }
    }
}

TEST(RgbBasis, HasEveryRgbUnderD65) {
    const std::vector<double> d65 = each_nanometre(illuminant_d65(), Outside::zero);
    const Rgb white = rgb_from_xyz(srgb) * summed_xyz(d65);
    for (const Rgb rgb : {Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1), Rgb(0), Rgb(1), Rgb(1, 1, 0), Rgb(0.2, 0.7, 0.05),
                          Rgb(0.9, 0.1, 0.6)}) {
        const auto paint = each_nanometre(reflectance_from_texel(rgb), Outside::constant);
        const Rgb seen = rgb_from_xyz(srgb) * summed_xyz(times(d65, paint)) / white;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], rgb[c], 3e-4) << rgb.r << ' ' << rgb.g << ' ' << rgb.b;
    }
}

TEST(RgbBasis, ATexelInChannelsIsTheSumOfTheBasisInChannels) {
    const SpectralContent content{{illuminant_d65()}, {reflectance_from_texel({0.5, 0.3, 0.2})}};
    const Rgb rgb(0.31, 0.62, 0.17);
    for (const char* text : {"uniform:31", "folded:8", "meyer:4"}) {
        const Wavelengths w = make_wavelengths(*parse_wavelengths(text), content);
        const auto basis = basis_channels(w);
        const std::vector<double> texel = reflectance_channels(w, reflectance_from_texel(rgb));
        for (std::size_t k = 0; k < texel.size(); ++k)
            EXPECT_NEAR(rgb.r * basis[0][k] + rgb.g * basis[1][k] + rgb.b * basis[2][k], texel[k], 1e-12) << text;
    }
    const auto rgb_basis = basis_channels(make_wavelengths({WavelengthRule::rgb, 3}));
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(rgb_basis[c][k], c == k ? 1 : 0);
}

} // namespace
} // namespace lueur
