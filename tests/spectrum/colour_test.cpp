// RGB matrices from chromaticities, and the sRGB curve.
#include <cmath>
#include <gtest/gtest.h>
#include <optional>

#include "core/spectrum/colour.h"

namespace lueur {
namespace {

void expect_matrix(const glm::dmat3& matrix, const double (&rows)[3][3], double tolerance) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            EXPECT_NEAR(matrix[column][row], rows[row][column], tolerance) << row << "," << column;
}

TEST(RgbSpace, SrgbMatrixIsThatOfItsChromaticities) {
    // IEC 61966-2-1 chromaticities, solved in exact arithmetic (SMPTE RP 177).
    expect_matrix(xyz_from_rgb(srgb),
                  {{0.41239079926595923, 0.357584339383878, 0.1804807884018343},
                   {0.21263900587151022, 0.715168678767756, 0.07219231536073371},
                   {0.019330818715591818, 0.11919477979462598, 0.9505321522496607}},
                  1e-12);
    expect_matrix(rgb_from_xyz(srgb),
                  {{3.2409699419045235, -1.5373831775700944, -0.4986107602930036},
                   {-0.9692436362808797, 1.8759675015077204, 0.041555057407175626},
                   {0.05563007969699364, -0.20397695888897652, 1.0569715142428786}},
                  1e-12);
    // The standard prints four digits.
    expect_matrix(xyz_from_rgb(srgb), {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}},
                  6e-5);
}

TEST(RgbSpace, OtherSpacesComeFromTheSameFunction) {
    // NTSC 1953 under illuminant C, and ACES AP0 whose green primary lies at (0, 1) (SMPTE ST 2065-1).
    const RgbSpace ntsc{{0.67, 0.33}, {0.21, 0.71}, {0.14, 0.08}, {0.31006, 0.31616}};
    expect_matrix(xyz_from_rgb(ntsc),
                  {{0.6068638092956182, 0.17350728095553722, 0.20033488140876357},
                   {0.2989030702500806, 0.5866198546591973, 0.11447707509072202},
                   {0, 0.06609801179258568, 1.1161514821345397}},
                  1e-12);
    const RgbSpace aces{{0.7347, 0.2653}, {0, 1}, {0.0001, -0.077}, {0.32168, 0.33767}};
    expect_matrix(xyz_from_rgb(aces),
                  {{0.9525523959381857, 0, 9.367863166046855e-05},
                   {0.34396644976507507, 0.7281660966134857, -0.07213254637856079},
                   {0, 0, 1.0088251843515859}},
                  1e-12);
}

TEST(RgbSpace, WhiteAndPrimariesHaveTheirChromaticities) {
    const glm::dmat3 xyz = xyz_from_rgb(srgb);
    const Chromaticity white = chromaticity(xyz * Rgb(1)), red = chromaticity(xyz * Rgb(1, 0, 0));
    EXPECT_NEAR(white.x, 0.3127, 1e-14);
    EXPECT_NEAR(white.y, 0.3290, 1e-14);
    EXPECT_NEAR((xyz * Rgb(1)).y, 1, 1e-14);
    EXPECT_NEAR(red.x, 0.64, 1e-14);
    EXPECT_NEAR(red.y, 0.33, 1e-14);
}

TEST(RgbSpace, PresetsAreNamed) {
    EXPECT_EQ(rgb_space_named("srgb"), srgb);
    EXPECT_EQ(rgb_space_named("rec709"), srgb);
    EXPECT_EQ(rgb_space_named("lecture"), lecture_monitor);
    EXPECT_EQ(rgb_space_named("sRGB2"), std::nullopt);
    for (const auto& [name, space] : rgb_spaces) EXPECT_EQ(make_rgb_space(space), space) << name;
    // Computed independently from the same chromaticities.
    expect_matrix(xyz_from_rgb(display_p3),
                  {{0.4865709486482161, 0.26566769316909306, 0.19821728523436247},
                   {0.22897456406974875, 0.6917385218365063, 0.07928691409374498},
                   {0, 0.04511338185890263, 1.0439443689009757}},
                  1e-12);
    expect_matrix(xyz_from_rgb(lecture_monitor),
                  {{0.478206716896092, 0.29855963610193, 0.17460142815699314},
                   {0.26347057969115895, 0.6550487538355776, 0.08148066647326346},
                   {0.019798367260029304, 0.16042010298014148, 0.9079274264163643}},
                  1e-12);
    expect_matrix(rgb_from_xyz(lecture_monitor),
                  {{2.739386694386696, -1.1447089397089405, -0.4240748440748443},
                   {-1.1189857131981626, 2.0285007739741667, 0.033144618976324015},
                   {0.1379762477231329, -0.33345058894960553, 1.1048007771706132}},
                  1e-12);
    // ITU-R BT.2020-2, table 4: E_Y = 0.2627 R + 0.6780 G + 0.0593 B.
    const glm::dmat3 wide = xyz_from_rgb(rec2020);
    EXPECT_NEAR(wide[0].y, 0.2627, 5e-5);
    EXPECT_NEAR(wide[1].y, 0.6780, 5e-5);
    EXPECT_NEAR(wide[2].y, 0.0593, 5e-5);
}

TEST(RgbSpace, WhiteHasTheLuminanceOfTheDisplay) {
    RgbSpace display = srgb;
    display.white_luminance = 250; // cd m^-2
    EXPECT_NEAR((xyz_from_rgb(display) * Rgb(1)).y, 250, 1e-10);
    EXPECT_NEAR((rgb_from_xyz(display) * Xyz(xyz_from_chromaticity(d65_white, 125))).g, 0.5, 1e-12);
}

TEST(RgbSpace, OfOnesOwnIsChecked) {
    const auto error = [](const RgbSpace& space) {
        const auto made = make_rgb_space(space);
        return made ? std::string("none") : made.error();
    };
    EXPECT_EQ(error({{0.64, 0.33}, {0.30, 0.60}, {0.47, 0.465}, d65_white}),
              "phosphors on one line; allowed: three that span a triangle");
    EXPECT_EQ(error({{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.7, 0.2}}),
              "white (0.7, 0.2); allowed: one inside the triangle of the phosphors and above y = 0");
    EXPECT_EQ(error({{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, d65_white, 0}),
              "luminance of white 0; allowed: a number above 0");
    EXPECT_EQ(error({{0.64, 0.33}, {0.30, 0.60}, {0.15, NAN}, d65_white}),
              "chromaticity (0.15, nan); allowed: numbers from -2 to 2");
    EXPECT_FALSE(make_rgb_space({{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.64, 0.33}})) << "white on a corner";
}

TEST(XyY, ComesBack) {
    const Xyz xyz(12, 34, 5);
    EXPECT_NEAR(glm::distance(xyz_from_chromaticity(chromaticity(xyz), xyz.y), xyz), 0, 1e-13);
    EXPECT_EQ(xyz_from_chromaticity({0, 0}, 1), Xyz(0));
}

TEST(SrgbCurve, HasTheStandardsValues) {
    EXPECT_EQ(srgb_encode(0), 0);
    EXPECT_NEAR(srgb_encode(1), 1, 1e-15);
    EXPECT_NEAR(srgb_encode(0.001), 0.01292, 1e-15);            // the linear part
    EXPECT_NEAR(srgb_encode(0.18), 0.46135612950044164, 1e-12); // 1.055 * 0.18^(1/2.4) - 0.055
    EXPECT_NEAR(srgb_decode(0.5), 0.21404114048223255, 1e-12);  // ((0.5 + 0.055) / 1.055)^2.4
    EXPECT_NEAR(srgb_decode(0.04), 0.04 / 12.92, 1e-15);
}

TEST(SrgbCurve, IsMonotoneAndDecodesWhatItEncodes) {
    double before = -1;
    for (int i = 0; i <= 20000; ++i) {
        const double linear = i / 20000.0, encoded = srgb_encode(linear);
        EXPECT_GT(encoded, before);
        // The standard's two thresholds do not match exactly: 0.0031308 encodes to 0.0404499.
        EXPECT_NEAR(srgb_decode(encoded), linear, 1e-7);
        before = encoded;
    }
}

} // namespace
} // namespace lueur
