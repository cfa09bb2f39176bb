// Radiometric quantities and their luminous twins.
#include <gtest/gtest.h>

#include "core/spectrum/photometry.h"
#include "tests/spectrum/illuminants.h"

namespace lueur {
namespace {

TEST(LightQuantity, OfALineIsItsEfficacy) {
    // 2 W in a line at 555 nm, and at 507 nm where V' peaks.
    const LightQuantity green = light_quantity(Spectrum{{554.999, 555, 555.001}, {0, 2000, 0}});
    EXPECT_NEAR(green.radiant, 2, 1e-9);
    EXPECT_NEAR(green.luminous, 2 * 683, 1e-3);
    EXPECT_NEAR(luminous_efficacy(green), 683, 1e-3);
    EXPECT_NEAR(green.scotopic, 2 * 1700 * 0.402, 1e-2); // V'(555)
    const LightQuantity cyan = light_quantity(Spectrum{{506.999, 507, 507.001}, {0, 1000, 0}});
    EXPECT_NEAR(cyan.scotopic, 1700, 1e-2);
    EXPECT_NEAR(scotopic_ratio(cyan), 1700 / (683 * 0.4443), 0.01); // V(507) = 0.4443
}

TEST(LightQuantity, CountsWattsThatNobodySees) {
    const LightQuantity heat = light_quantity(Spectrum{{1000, 2000}, {1, 1}});
    EXPECT_NEAR(heat.radiant, 1000, 1e-9);
    EXPECT_EQ(heat.luminous, 0);
    EXPECT_EQ(luminous_efficacy(heat), 0);
    EXPECT_EQ(luminous_efficacy(light_quantity(Spectrum{})), 0);
    EXPECT_EQ(scotopic_ratio(light_quantity(Spectrum{})), 0);
}

TEST(LightQuantity, OfEqualEnergyAndOfIlluminantA) {
    const LightQuantity flat = light_quantity(Spectrum{{380, 780}, {1, 1}});
    EXPECT_NEAR(flat.radiant, 400, 1e-9);
    EXPECT_NEAR(flat.luminous, 683 * 106.8564, 0.05);
    EXPECT_NEAR(luminous_efficacy(flat), 182.46, 0.005); // wavelengths.h
    // Scotopic to photopic of an incandescent lamp of 2856 K: 1.41 (CIE 191:2010, table A1 prints 1.41).
    EXPECT_NEAR(scotopic_ratio(light_quantity(linear_spectrum("A"))), 1.41, 0.01);
}

TEST(LightQuantity, OfBinsIsExact) {
    const Spectrum bins{{500, 510}, {1, 3}, Interpolation::bin}; // 495..505 at 1, 505..515 at 3
    EXPECT_NEAR(light_quantity(bins).radiant, 40, 1e-12);
}

TEST(LightKind, HasTwinsAndUnits) {
    EXPECT_EQ(light_kind_names(LightKind::flux).luminous_unit, "lm");
    EXPECT_EQ(light_kind_names(LightKind::intensity).luminous_unit, "cd");
    EXPECT_EQ(light_kind_names(LightKind::irradiance).radiant_unit, "W/m²");
    EXPECT_EQ(light_kind_names(LightKind::irradiance).luminous, "illuminance");
    EXPECT_EQ(light_kind_names(LightKind::exitance).luminous_unit, "lm/m²");
    EXPECT_EQ(light_kind_names(LightKind::radiance).luminous_unit, "cd/m²");
}

} // namespace
} // namespace lueur
