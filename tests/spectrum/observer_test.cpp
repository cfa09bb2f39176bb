// The CIE 1931 observer against its published sums and the chromaticities of the standard illuminants.
#include <gtest/gtest.h>
#include <vector>

#include "core/spectrum/colour.h"
#include "core/spectrum/observer.h"
#include "core/spectrum/rgb_spectrum.h"
#include "tests/spectrum/illuminants.h"

namespace lueur {
namespace {

TEST(Observer, SumsAreThePublishedOnes) {
    // Sums of the 1 nm table from 360 to 830 nm, CIE 15:2018: 106.865, 106.857, 106.892 nm.
    Xyz sum(0);
    for (int nm = observer_first_nm; nm <= observer_last_nm; ++nm) sum += observer_xyz(nm);
    EXPECT_NEAR(sum.x, 106.86546948959484, 1e-9);
    EXPECT_NEAR(sum.y, 106.85691710117203, 1e-9);
    EXPECT_NEAR(sum.z, 106.89225127863597, 1e-9);
    // From 380 to 780 nm.
    Xyz visible(0);
    for (int nm = 380; nm <= 780; ++nm) visible += observer_xyz(nm);
    EXPECT_NEAR(visible.x, 106.85508530329987, 1e-9);
    EXPECT_NEAR(visible.y, 106.85642627788003, 1e-9);
    EXPECT_NEAR(visible.z, 106.84608243163598, 1e-9);
}

TEST(Observer, HasTheTablesValuesAndIsZeroOutside) {
    EXPECT_EQ(observer_xyz(555), Xyz(0.5120501, 1, 0.005749999)) << "ybar peaks at 555 nm with 1";
    EXPECT_EQ(observer_xyz(359), Xyz(0));
    EXPECT_EQ(observer_xyz(831), Xyz(0));
    EXPECT_EQ(observer_xyz(359.9), Xyz(0));
    EXPECT_EQ(observer_xyz(830.1), Xyz(0));
    EXPECT_EQ(observer_xyz(830.0), observer_xyz(830));
    EXPECT_EQ(observer_xyz(360.0), observer_xyz(360));
    const Xyz middle = (observer_xyz(500) + observer_xyz(501)) / 2.0;
    EXPECT_NEAR(glm::distance(observer_xyz(500.5), middle), 0, 1e-15);
}

TEST(Observer1964, SumsAndPeakAreThePublishedOnes) {
    Xyz sum(0); // CIE 15:2018: 116.649, 116.662, 116.674 nm at 1 nm
    for (int nm = observer_first_nm; nm <= observer_last_nm; ++nm) sum += observer_xyz(nm, Observer::cie1964_10degree);
    EXPECT_NEAR(sum.x, 116.649, 5e-4);
    EXPECT_NEAR(sum.y, 116.662, 5e-4);
    EXPECT_NEAR(sum.z, 116.674, 5e-4);
    EXPECT_EQ(observer_xyz(557, Observer::cie1964_10degree).y, 1) << "ybar10 peaks at 557 nm with 1";
    EXPECT_EQ(observer_xyz(360, Observer::cie1964_10degree), Xyz(1.222e-07, 1.3398e-08, 5.35027e-07));
    EXPECT_EQ(observer_xyz(831, Observer::cie1964_10degree), Xyz(0));
    EXPECT_NE(observer_xyz(500), observer_xyz(500, Observer::cie1964_10degree));
}

TEST(Photometry, ALineAt555NmHas683LumenAWatt) {
    // One watt in a triangle narrower than the table: ybar falls linearly by less than 3e-6 over it.
    const Spectrum line{{554.99, 555, 555.01}, {0, 100, 0}};
    EXPECT_NEAR(xyz_from_spectrum(line).y, 683, 683 * 3e-6);
    // A line at 507.5 nm, between two entries, has 683 times their mean.
    const Spectrum between{{507.49, 507.5, 507.51}, {0, 100, 0}};
    EXPECT_NEAR(xyz_from_spectrum(between).y, 683 * (observer_xyz(507).y + observer_xyz(508).y) / 2, 1e-6);
}

TEST(Photometry, AFlatSpectrumHas683Times106857) {
    const Xyz xyz = xyz_from_spectrum(Spectrum{{360, 830}, {1, 1}});
    EXPECT_NEAR(xyz.x, 683 * 106.865, 683 * 6e-4);
    EXPECT_NEAR(xyz.y, 683 * 106.857, 683 * 6e-4);
    EXPECT_NEAR(xyz.z, 683 * 106.892, 683 * 6e-4);
    EXPECT_EQ(xyz_from_spectrum(Spectrum{{900, 1000}, {1, 1}}), Xyz(0));
    EXPECT_EQ(xyz_from_spectrum(Spectrum{}), Xyz(0));
}

TEST(Photometry, LightOutsideItsGridIsDark) {
    // Only 400..500 nm: the integral must stop there, not slope to the next nanometre.
    const Spectrum blue{{400.25, 499.75}, {1, 1}};
    Xyz expected(0); // exact integral of the piecewise linear table
    for (int nm = 401; nm < 499; ++nm) expected += (observer_xyz(nm) + observer_xyz(nm + 1)) / 2.0;
    expected += 0.75 * (observer_xyz(400.25) + observer_xyz(401)) / 2.0 +
                0.75 * (observer_xyz(499) + observer_xyz(499.75)) / 2.0;
    EXPECT_NEAR(glm::distance(xyz_from_spectrum(blue), 683.0 * expected), 0, 1e-8);
}

TEST(Chromaticity, OfIlluminantAIsThePublishedOne) {
    // CIE 15:2018: A is Planck's law with c2 / T = 1.435e-2 m K / 2848 K; x = 0.44758, y = 0.40745.
    const Chromaticity a = chromaticity(xyz_from_spectrum(blackbody(2848 * 1.438776877 / 1.435)));
    EXPECT_NEAR(a.x, 0.44758, 1e-4);
    EXPECT_NEAR(a.y, 0.40745, 1e-4);
}

TEST(Chromaticity, OfIlluminantD65IsThePublishedOne) {
    const Chromaticity d65 = chromaticity(xyz_from_spectrum(illuminant_d65())); // CIE 15:2018
    EXPECT_NEAR(d65.x, 0.31272, 1e-4);
    EXPECT_NEAR(d65.y, 0.32903, 1e-4);
    EXPECT_EQ(value_at(illuminant_d65(), 560, Outside::zero), 100);
    EXPECT_EQ(illuminant_d65().nm.front(), 300);
    EXPECT_EQ(illuminant_d65().nm.back(), 780);
}

// Two independent computations of each published illuminant: summed at 5 nm as CIE 15 does, and as a spectrum that is
// linear between its samples, summed at 1 nm.
TEST(Chromaticity, OfPublishedIlluminantsIsTheReference) {
    for (const PublishedIlluminant& illuminant : published_illuminants) {
        const Chromaticity lines = chromaticity(xyz_from_spectrum(line_spectrum(illuminant.name)));
        EXPECT_NEAR(lines.x, illuminant.summed_at_5nm.x, 1e-8) << illuminant.name;
        EXPECT_NEAR(lines.y, illuminant.summed_at_5nm.y, 1e-8) << illuminant.name;
        const Spectrum linear = linear_spectrum(illuminant.name);
        std::vector<double> nm, power;
        for (int at = 380; at <= 780; ++at) {
            for (const double place : {-1e-4, 0.0, 1e-4}) nm.push_back(at + place);
            for (const double peak : {0.0, 1e4, 0.0}) power.push_back(peak * value_at(linear, at, Outside::zero));
        }
        const Chromaticity at_1nm = chromaticity(xyz_from_spectrum(*make_spectrum(nm, power)));
        EXPECT_NEAR(at_1nm.x, illuminant.linear_at_1nm.x, 1e-8) << illuminant.name;
        EXPECT_NEAR(at_1nm.y, illuminant.linear_at_1nm.y, 1e-8) << illuminant.name;
        const Chromaticity exact = chromaticity(xyz_from_spectrum(linear)); // the 1 nm sum is a trapezoidal rule of it
        EXPECT_NEAR(exact.x, illuminant.linear_at_1nm.x, 2e-5) << illuminant.name;
        EXPECT_NEAR(exact.y, illuminant.linear_at_1nm.y, 2e-5) << illuminant.name;
    }
}

TEST(Chromaticity, OfIlluminantsIsThatOfTheStandard) {
    // CIE 15:2018: x, y and x10, y10.
    struct Row {
        const char* name;
        Chromaticity two_degree, ten_degree;
    };
    for (const auto& [name, two, ten] : {
             Row{"A", {0.44758, 0.40745}, {0.45117, 0.40594}},
             Row{"C", {0.31006, 0.31616}, {0.31039, 0.31905}},
             Row{"D50", {0.34567, 0.35851}, {0.34773, 0.35952}},
             Row{"D55", {0.33243, 0.34744}, {0.33412, 0.34877}},
             Row{"D65", {0.31272, 0.32903}, {0.31381, 0.33098}},
             Row{"D75", {0.29903, 0.31488}, {0.29968, 0.31740}},
         }) {
        const Spectrum spectrum = line_spectrum(name);
        const Chromaticity xy = chromaticity(xyz_from_spectrum(spectrum));
        const Chromaticity xy10 = chromaticity(xyz_from_spectrum(spectrum, Observer::cie1964_10degree));
        EXPECT_NEAR(xy.x, two.x, 1.5e-5) << name; // half a digit, and the table ends at 780 nm
        EXPECT_NEAR(xy.y, two.y, 1.5e-5) << name;
        EXPECT_NEAR(xy10.x, ten.x, 1.5e-5) << name;
        EXPECT_NEAR(xy10.y, ten.y, 1.5e-5) << name;
    }
}

TEST(Chromaticity, OfEqualEnergyIsOneThirdAndOfBlackIsZero) {
    const Chromaticity e = chromaticity(xyz_from_spectrum(Spectrum{{360, 830}, {2, 2}}));
    EXPECT_NEAR(e.x, 1.0 / 3, 2e-4);
    EXPECT_NEAR(e.y, 1.0 / 3, 2e-4);
    EXPECT_EQ(chromaticity(Xyz(0)), Chromaticity{});
}

} // namespace
} // namespace lueur
