// The calibration picture: striped and plain parts send the same light through the curve it is made for.
#include "core/display/calibration.h"

#include <cmath>
#include <gtest/gtest.h>

namespace lueur {
namespace {

TEST(Calibration, StripesAndPatchesAreEquallyBright) {
    const int width = 160, height = 120;
    for (const TransferCurve curve : all_transfer_curves) {
        const glm::dvec3 gamma(1.8, 2.2, 2.6);
        const auto light = [&](std::uint8_t code, int channel) { // of a monitor with that curve
            return curve == TransferCurve::srgb ? srgb_decode(code / 255.0) : std::pow(code / 255.0, gamma[channel]);
        };
        const DisplayImage picture = calibration_picture(width, height, curve, gamma);
        ASSERT_EQ(picture.rgb.size(), static_cast<std::size_t>(width * height));
        for (int column = 0; column < calibration_column_count; ++column)
            for (int row = 0; row < calibration_row_count; ++row)
                for (int channel = 0; channel < 3; ++channel) {
                    double striped = 0, plain = 0;
                    for (int line = 0; line < 8; ++line) { // of the middle of the cell, beside and within the patch
                        const int y = row * 40 + 16 + line;
                        const auto at = [&](int x) {
                            return picture.rgb[static_cast<std::size_t>(y * width + column * 40 + x)]
                                              [static_cast<std::size_t>(channel)];
                        };
                        striped += light(at(3), channel) / 8;
                        plain += light(at(20), channel) / 8;
                    }
                    EXPECT_NEAR(striped, plain, 0.006) << column << row << channel; // codes are whole
                    const bool lit = column == 3 || column == channel;
                    EXPECT_NEAR(plain, lit ? 0.25 * (row + 1) : 0, 0.006);
                }
    }
}

TEST(Calibration, OfNoSizeIsEmpty) {
    EXPECT_TRUE(calibration_picture(0, 0, TransferCurve::srgb, glm::dvec3(2.2)).rgb.empty());
    EXPECT_TRUE(calibration_picture(-3, 5, TransferCurve::srgb, glm::dvec3(2.2)).rgb.empty());
}

} // namespace
} // namespace lueur
