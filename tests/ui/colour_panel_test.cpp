// The colour panel: readings of lights, worked out once, and the diagram's marks.
#include "ui/panels.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include "core/spectrum/colour_temperature.h"
#include "core/spectrum/observer.h"
#include "tests/support/scenes.h"
#include "tests/ui/panel_fixture.h"

namespace lueur {
namespace {

TEST(LightReadings, SayWhatALightIs) {
    LightReadings readings;
    const LightReading bulb = readings.of(Blackbody{2856});
    ASSERT_TRUE(bulb.temperature && bulb.rendering && bulb.scotopic_ratio);
    EXPECT_NEAR(bulb.temperature->kelvin, 2856, 1);
    EXPECT_NEAR(bulb.rendering->general, 100, 0.1);
    EXPECT_NEAR(*bulb.scotopic_ratio, 1.41, 0.01);
    EXPECT_NEAR(bulb.xy.x, 0.4476, 1e-4);
    const LightReading green = readings.of(Rgb(0, 1, 0));
    EXPECT_EQ(green.xy.x, chromaticity(xyz_from_rgb(srgb) * Rgb(0, 1, 0)).x);
    EXPECT_FALSE(green.temperature || green.rendering || green.scotopic_ratio)
        << "no white, and an RGB has no spectrum";
    EXPECT_FALSE(readings.of(Lines{{{546.1, 1, 1}}}).temperature);
    EXPECT_EQ(readings.of(Rgb(0)).xy, Chromaticity{});
}

TEST(LightReadings, AreWorkedOutWhenTheSpectrumChanges) {
    LightReadings readings;
    for (int frame = 0; frame < 3; ++frame) {
        readings.of(Blackbody{2700});
        readings.of(Flat{});
        readings.of_arriving(daylight(5000));
    }
    EXPECT_EQ(readings.computed, 3);
    readings.of(Blackbody{2701});
    readings.of_arriving(daylight(5001));
    EXPECT_EQ(readings.computed, 5);
    for (int frame = 0; frame < 3; ++frame) readings.of_arriving(Xyz(1, 1, 1));
    EXPECT_EQ(readings.computed, 6);
    for (int kelvin = 1000; kelvin < 1200; ++kelvin) readings.of(Blackbody{static_cast<double>(kelvin)}); // a drag
    EXPECT_EQ(readings.of(Flat{}).xy.x, LightReadings().of(Flat{}).xy.x);
}

class ColourPanel : public test::PanelFixture {
protected:
    void SetUp() override {
        PanelFixture::SetUp();
        test::SceneBuilder builder;
        const auto grey = builder.material("grey", 0.6);
        std::vector<ObjectIndex> lamps;
        for (int i = 0; i < 4; ++i) {
            const auto x = static_cast<float>(i);
            lamps.push_back(builder.polygon("lamp " + std::to_string(i), grey,
                                            {{x, 2.9f, 1}, {x + 0.3f, 2.9f, 1}, {x + 0.3f, 2.9f, 2}, {x, 2.9f, 2}}));
        }
        builder.light("warm", {lamps[0]}, PowerUnit::lumen, 1000, Blackbody{2700});
        builder.light("cool", {lamps[1]}, PowerUnit::watt, 12, Daylight{6504});
        builder.light("screen", {lamps[2]}, PowerUnit::lumen, 30, Rgb(0.1, 0.2, 1));
        builder.light("warm too", {lamps[3]}, PowerUnit::lumen, 500, Blackbody{2700});
        document_ = Document(builder.build());
    }
    void frame() {
        draw_frame([&] { colour_panel(document_, *state_); });
    }
    void click(const std::string& name) {
        const auto box = box_of(name);
        auto& io = ImGui::GetIO();
        io.MousePos = {0.5f * (box[0] + box[2]), 0.5f * (box[1] + box[3])};
        frame();
        io.MouseDown[0] = true;
        frame();
        io.MouseDown[0] = false;
        frame();
    }
};

TEST_F(ColourPanel, MarksLuminairesAndTheProbe) {
    frame();
    EXPECT_TRUE(widgets().contains("mark:warm +1")) << "two of one colour share a mark";
    EXPECT_TRUE(widgets().contains("mark:cool"));
    EXPECT_TRUE(widgets().contains("mark:screen"));
    EXPECT_FALSE(widgets().contains("mark:light here"));
    click("mark:cool");
    EXPECT_EQ(state_->luminaire, LuminaireIndex{1});

    Probe probe;
    probe.irradiance_spectrum = daylight(5000);
    probe.irradiance = xyz_from_spectrum(probe.irradiance_spectrum);
    probe.radiance = Xyz(2, 3, 1);
    state_->hovered = probe;
    frame();
    EXPECT_TRUE(widgets().contains("mark:light here"));
    EXPECT_TRUE(widgets().contains("mark:seen"));
    const int computed = state_->readings.computed;
    for (int i = 0; i < 5; ++i) frame();
    EXPECT_EQ(state_->readings.computed, computed) << "nothing is worked out twice";
    state_->hovered->irradiance_spectrum = {}; // rgb wavelengths: only its colour is known
    frame();
    EXPECT_TRUE(widgets().contains("mark:light here"));
    EXPECT_EQ(state_->readings.computed, computed + 1);
}

TEST_F(ColourPanel, SwitchesScaleAndPart) {
    frame();
    click("chromaticity_scale:x y");
    EXPECT_EQ(state_->chromaticity_scale, ChromaticityScale::xy);
    click("chromaticity_part:Whites");
    EXPECT_TRUE(state_->chromaticity_whites);
    click("chromaticity_scale:u' v'");
    EXPECT_EQ(state_->chromaticity_scale, ChromaticityScale::uv);
}

TEST_F(ColourPanel, OfASceneWithoutLuminairesAndOfDarkness) {
    Scene dark = document_.scene();
    dark.luminaires.clear();
    document_ = Document(dark);
    state_->luminaire = LuminaireIndex{7}; // of another scene
    state_->hovered = Probe{};
    frame();
    state_->hovered->irradiance_spectrum = Spectrum{{400, 700}, {0, 0}};
    frame();
    EXPECT_FALSE(widgets().contains("mark:light here"));
}

} // namespace
} // namespace lueur
