// Exitance by hand: what a luminaire's power, unit, side and dimmer mean.
#include <cmath>

#include "core/scene/luminaire.h"
#include "scene_fixture.h"

namespace lueur {
namespace {

constexpr double pi = 3.14159265358979323846;
// Km times the integral of ybar over the 400 nm that one unit of white is spread over (core/spectrum/wavelengths.h).
constexpr double white_efficacy = 683 * 106.857 / 400;

const WavelengthsSpec uniform31{}, uniform4{WavelengthRule::uniform, 4}, rgb_rule{WavelengthRule::rgb, 3};

class LuminaireTest : public SceneTest {
protected:
    void SetUp() override {
        SceneTest::SetUp();
        write("s.toml", small_scene);
        scene = load("s.toml").scene; // its lamp is 2 m2
    }
    Luminaire lamp(EmissionSpectrum spectrum, PowerUnit unit, double power) const {
        Luminaire luminaire = scene.luminaires.at(0);
        luminaire.spectrum = std::move(spectrum);
        luminaire.unit = unit;
        luminaire.power = power;
        return luminaire;
    }
    Scene scene;
};

const std::vector<EmissionSpectrum> spectra{Flat{}, Rgb(1, 0.5, 0.25), Blackbody{2700},
                                            SpectrumFile{"line.csv", "", Spectrum{{540, 546, 547, 560}, {0, 1, 1, 0}}}};

TEST_F(LuminaireTest, LumensAreMetExactlyInEveryQuadrature) { // 3000 lm over 2 m2: 1500 lm/m2
    for (const WavelengthsSpec& spec : {uniform31, uniform4, rgb_rule})
        for (const EmissionSpectrum& spectrum : spectra) {
            const Wavelengths wavelengths = make_wavelengths(spec);
            EXPECT_NEAR(xyz_from_channels(wavelengths,
                                          exitance_channels(scene, lamp(spectrum, PowerUnit::lumen, 3000), wavelengths))
                            .y,
                        1500, 1e-9)
                << to_string(spec) << " " << spectrum.index();
        }
}

TEST_F(LuminaireTest, WattsAreMetExactlyInEveryQuadrature) { // 40 W over 2 m2
    for (const WavelengthsSpec& spec : {uniform31, uniform4, rgb_rule})
        for (const EmissionSpectrum& spectrum : spectra) {
            const Wavelengths wavelengths = make_wavelengths(spec);
            EXPECT_NEAR(watts_from_channels(wavelengths,
                                            exitance_channels(scene, lamp(spectrum, PowerUnit::watt, 40), wavelengths)),
                        20, 1e-11)
                << to_string(spec) << " " << spectrum.index();
        }
}

TEST_F(LuminaireTest, SidesAndDimmer) {
    const Wavelengths wavelengths = make_wavelengths(uniform31);
    Luminaire luminaire = lamp(Flat{}, PowerUnit::lumen, 3000);
    EXPECT_NEAR(emitting_area(scene, luminaire), 2, 1e-12);
    luminaire.side = EmitSide::both;
    EXPECT_NEAR(emitting_area(scene, luminaire), 4, 1e-12);
    EXPECT_NEAR(xyz_from_channels(wavelengths, exitance_channels(scene, luminaire, wavelengths)).y, 750, 1e-9);
    luminaire.side = EmitSide::back;
    luminaire.dimmer = 0.25;
    EXPECT_NEAR(emitting_area(scene, luminaire), 2, 1e-12);
    EXPECT_NEAR(xyz_from_channels(wavelengths, exitance_channels(scene, luminaire, wavelengths)).y, 375, 1e-9);
    EXPECT_NEAR(luminous_flux(scene, luminaire), 750, 1e-9);
}

// 100 W/m2 of equal energy over 380..780 nm is 0.25 W m^-2 nm^-1 at each wavelength; as a radiance pi times that.
TEST_F(LuminaireTest, ExitanceAndRadianceOfAFlatSpectrum) {
    const Wavelengths wavelengths = make_wavelengths(uniform31);
    for (const double channel : exitance_channels(scene, lamp(Flat{}, PowerUnit::exitance, 100), wavelengths))
        EXPECT_NEAR(channel, 0.25, 1e-12);
    for (const double channel : exitance_channels(scene, lamp(Flat{}, PowerUnit::radiance, 100), wavelengths))
        EXPECT_NEAR(channel, 0.25 * pi, 1e-12);
}

// A measured spectrum is scaled to its own integral: a triangle of base 20 nm and height 1 holds 10, so 5 W/m2 halve
// it. Its Y is Km times the sum over the triangle, narrow enough for the mean of ybar near 546 nm.
TEST_F(LuminaireTest, ExitanceOfASpectrumFile) {
    const SpectrumFile triangle{"t.csv", "", Spectrum{{540, 550, 560}, {0, 1, 0}}};
    const Wavelengths wavelengths = make_wavelengths(uniform31);
    const auto channels = exitance_channels(scene, lamp(triangle, PowerUnit::exitance, 5), wavelengths);
    double sum = 0; // the hats add up to 1: nothing of the line is lost
    for (const double channel : channels) sum += channel * 10;
    EXPECT_NEAR(sum, 5, 1e-9);
    EXPECT_NEAR(radiant_flux(scene, lamp(triangle, PowerUnit::exitance, 5)), 10, 1e-9);
    EXPECT_NEAR(luminous_flux(scene, lamp(triangle, PowerUnit::exitance, 5)), 683 * 0.99 * 10, 0.01 * 6830);
}

TEST_F(LuminaireTest, RgbMultipliesChannelByChannel) { // OBJ Ke is a radiance: exitance = pi Ke
    const Wavelengths wavelengths = make_wavelengths(rgb_rule);
    const Rgb colour(4, 2, 1);
    const auto exitance = exitance_channels(scene, lamp(colour, PowerUnit::exitance, 0.5), wavelengths);
    const auto radiance = exitance_channels(scene, lamp(colour, PowerUnit::radiance, 1), wavelengths);
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(exitance[static_cast<std::size_t>(k)], 0.5 * colour[k], 1e-12);
        EXPECT_NEAR(radiance[static_cast<std::size_t>(k)], pi * colour[k], 1e-12);
    }
    EXPECT_NEAR(luminous_flux(scene, lamp(Rgb(1), PowerUnit::exitance, 1)), 2 * white_efficacy,
                1e-3 * 2 * white_efficacy);
    EXPECT_NEAR(radiant_flux(scene, lamp(Rgb(1), PowerUnit::exitance, 1)), 2, 2e-3);
}

TEST_F(LuminaireTest, FluxInBothUnits) {
    const Luminaire watts = lamp(Flat{}, PowerUnit::watt, 10);
    EXPECT_NEAR(radiant_flux(scene, watts), 10, 1e-12);
    EXPECT_NEAR(luminous_flux(scene, watts), 10 * white_efficacy, 1e-3 * 10 * white_efficacy);
    const Luminaire lumens = lamp(Flat{}, PowerUnit::lumen, 1000);
    EXPECT_NEAR(luminous_flux(scene, lumens), 1000, 1e-9);
    EXPECT_NEAR(radiant_flux(scene, lumens), 1000 / white_efficacy, 1e-3 * 1000 / white_efficacy);
}

TEST_F(LuminaireTest, ASpectrumWithoutPowerEmitsNothingAndIsTold) {
    const Wavelengths wavelengths = make_wavelengths(uniform31);
    for (const Spectrum& dark : {Spectrum{{400, 700}, {0, 0}}, Spectrum{{800, 830}, {1, 1}}})
        for (const PowerUnit unit : {PowerUnit::lumen, PowerUnit::watt}) {
            scene.luminaires[0] = lamp(SpectrumFile{"dark.csv", "", dark}, unit, 100);
            for (const double channel : exitance_channels(scene, scene.luminaires[0], wavelengths))
                EXPECT_EQ(channel, 0);
            EXPECT_THAT(lines(check(scene)), testing::HasSubstr("it emits nothing"));
        }
}

TEST_F(LuminaireTest, WhoLightsWhom) {
    const auto lit = luminaire_of_objects(scene);
    ASSERT_EQ(lit.size(), 2u);
    EXPECT_FALSE(lit[0].has_value());
    EXPECT_EQ(lit[1], LuminaireIndex{0});
}

TEST_F(LuminaireTest, GreyReflectanceIsTheSameInEveryChannel) {
    for (const WavelengthsSpec& spec : {uniform31, rgb_rule})
        for (const double channel : reflectance_channels(Reflectance(0.3), make_wavelengths(spec)))
            EXPECT_EQ(channel, 0.3);
}

} // namespace
} // namespace lueur
