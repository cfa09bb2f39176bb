// Spectra chosen and made in the panels, with real clicks in an ImGui context without a window.
#include <array>

#include <gtest/gtest.h>
#include <imgui.h>

#include "core/spectrum/operations.h"
#include "tests/support/scenes.h"
#include "tests/ui/panel_fixture.h"
#include "ui/dropped_files.h"
#include "ui/panels.h"
#include "ui/spectrum_plot.h"

namespace lueur {
namespace {

class SpectrumPanels : public test::PanelFixture {
protected:
    void SetUp() override {
        PanelFixture::SetUp();
        test::SceneBuilder builder;
        const auto grey = builder.material("grey", 0.6);
        builder.material("drawn", Drawn{{{400, 500, 600, 700}, {0.1, 0.9, 0.9, 0.2}}});
        builder.room("room", {grey, grey, grey, grey, grey, grey}, {0, 0, 0}, {4, 3, 4});
        const auto lamp = builder.polygon("lamp", grey, {{1, 2.9f, 1}, {2, 2.9f, 1}, {2, 2.9f, 2}, {1, 2.9f, 2}});
        builder.light("light", {lamp}, PowerUnit::lumen, 1000, Flat{});
        document_ = Document(builder.build());
        state_->luminaire = LuminaireIndex{0};
        state_->material = MaterialIndex{1};
    }
    using Panel = std::optional<Edit> (*)(const Document&, const Snapshot&, UiState&);
    void frame() {
        draw_frame([&] {
            if (const auto edit = panel_(document_, snapshot_, *state_)) {
                const auto applied = document_.apply(*edit);
                EXPECT_TRUE(applied.has_value()) << (applied ? "" : applied.error());
            }
        });
        for (const Command command : std::exchange(state_->commands, {}))
            if (command == Command::undo) document_.undo();
        const bool active = ImGui::IsAnyItemActive(); // as the window does it
        if (was_active_ && !active) document_.end_drag();
        was_active_ = active;
    }
    std::array<float, 4> widget(const std::string& name) {
        frame();
        return box_of(name);
    }
    void press(int button, ImVec2 at) {
        ImGui::GetIO().MousePos = at;
        frame();
        ImGui::GetIO().MouseDown[button] = true;
        frame();
    }
    void release(int button) {
        ImGui::GetIO().MouseDown[button] = false;
        frame();
        frame();
    }
    void move(ImVec2 to) {
        ImGui::GetIO().MousePos = to;
        frame();
    }
    void click(const std::string& name) {
        const auto box = widget(name);
        press(0, {0.5f * (box[0] + box[2]), 0.5f * (box[1] + box[3])});
        release(0);
    }
    void key(ImGuiKey code) {
        ImGui::GetIO().KeysDown[code] = true;
        frame();
        ImGui::GetIO().KeysDown[code] = false;
        frame();
    }
    // Where a wavelength and a value are on the curve that is being drawn; its field is 150 high above the numbers.
    ImVec2 place(double nm, double value, double top) {
        const auto box = widget("curve");
        return {box[0] + static_cast<float>((nm - 380) / 400) * (box[2] - box[0]),
                box[1] + 150 * static_cast<float>(1 - value / top)};
    }
    const EmissionSpectrum& light() const { return document_.scene().luminaires[0].spectrum; }
    const Spectrum& drawn() const { return std::get<Drawn>(document_.scene().materials[1].reflectance).spectrum; }

    Snapshot snapshot_;
    Panel panel_ = luminaires_panel;
    bool was_active_ = false;
};

TEST_F(SpectrumPanels, ALampIsFoundInTheLibraryByItsName) {
    click("spectrum_form");
    click("spectrum_form:Library");
    ASSERT_TRUE(std::holds_alternative<LibrarySpectrum>(light()));
    click("library_button:lamp");
    for (const char letter : std::string("fl11")) ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(letter));
    click("library:FL11");
    EXPECT_EQ(std::get<LibrarySpectrum>(light()).name, "FL11");
    EXPECT_GT(std::get<LibrarySpectrum>(light()).spectrum.nm.size(), 80u);
}

TEST_F(SpectrumPanels, TemperaturesKeepTheColourOfWhatWasThere) {
    document_.apply(SetEmissionSpectrum{LuminaireIndex{0}, Blackbody{5000}});
    click("spectrum_form");
    click("spectrum_form:Daylight");
    EXPECT_EQ(std::get<Daylight>(light()).kelvin, 5000);
    const auto box = widget("kelvin");
    press(0, {box[0] + 0.5f * (box[2] - box[0]), 0.5f * (box[1] + box[3])});
    move({box[0] + 0.9f * (box[2] - box[0]), 0.5f * (box[1] + box[3])});
    release(0);
    EXPECT_GT(std::get<Daylight>(light()).kelvin, 12000);
    EXPECT_LE(std::get<Daylight>(light()).kelvin, 25000);
}

TEST_F(SpectrumPanels, AMixtureHasTwoLightsAndAShare) {
    document_.apply(SetEmissionSpectrum{LuminaireIndex{0}, Blackbody{2000}});
    click("spectrum_form");
    click("spectrum_form:Mixture");
    ASSERT_TRUE(std::holds_alternative<Mix>(light()));
    EXPECT_EQ(std::get<Mix>(light()).lights[0], SimpleEmission(Blackbody{2000}));
    const auto box = widget("mixture_share");
    press(0, {box[0] + 0.5f * (box[2] - box[0]), 0.5f * (box[1] + box[3])});
    move({box[0] + 0.98f * (box[2] - box[0]), 0.5f * (box[1] + box[3])});
    release(0);
    EXPECT_GT(std::get<Mix>(light()).share, 0.9);
    click("first_light");
    click("first_light:Lines");
    EXPECT_TRUE(std::holds_alternative<Lines>(std::get<Mix>(light()).lights[0]));
    click("add_line");
    EXPECT_EQ(std::get<Lines>(std::get<Mix>(light()).lights[0]).lines.size(), 2u);
}

TEST_F(SpectrumPanels, DraggingAPointIsOneStepOfUndo) {
    panel_ = materials_panel;
    const Spectrum before = drawn();
    press(0, place(600, 0.9, 1));
    for (const double value : {0.8, 0.6, 0.4}) move(place(620, value, 1));
    release(0);
    EXPECT_NEAR(drawn().nm[2], 620, 2);
    EXPECT_NEAR(drawn().value[2], 0.4, 0.01);
    EXPECT_EQ(drawn().nm.size(), 4u);
    document_.undo();
    EXPECT_EQ(drawn(), before);
    EXPECT_FALSE(document_.can_undo());
}

TEST_F(SpectrumPanels, APointStaysBetweenItsNeighboursAndWithinTheAxis) {
    panel_ = materials_panel;
    press(0, place(500, 0.9, 1));
    move(place(760, 3, 1));
    move(place(760, 3, 1));
    release(0);
    EXPECT_LT(drawn().nm[1], 600);
    EXPECT_GT(drawn().nm[1], 599);
    EXPECT_EQ(drawn().value[1], 1);
    EXPECT_TRUE(make_spectrum(drawn().nm, drawn().value));
}

TEST_F(SpectrumPanels, EscapeTakesADragBack) {
    panel_ = materials_panel;
    const Spectrum before = drawn();
    press(0, place(600, 0.9, 1));
    move(place(620, 0.5, 1));
    EXPECT_TRUE(state_->curve.active()) << "so that the window leaves Escape to it";
    EXPECT_NE(drawn(), before);
    key(ImGuiKey_Escape);
    EXPECT_EQ(drawn(), before);
    move(place(640, 0.2, 1)); // the button is still down
    EXPECT_EQ(drawn(), before);
    release(0);
    EXPECT_EQ(drawn(), before);
    EXPECT_FALSE(document_.can_undo());
}

TEST_F(SpectrumPanels, AClickAddsAndARightClickOrDeleteTakesAway) {
    panel_ = materials_panel;
    press(0, place(550, 0.5, 1));
    release(0);
    ASSERT_EQ(drawn().nm.size(), 5u);
    EXPECT_NEAR(drawn().nm[2], 550, 2);
    EXPECT_NEAR(drawn().value[2], 0.5, 0.01);
    press(1, place(500, 0.9, 1));
    release(1);
    ASSERT_EQ(drawn().nm.size(), 4u);
    EXPECT_NEAR(drawn().nm[1], 550, 2);
    press(0, place(600, 0.9, 1)); // chosen
    release(0);
    key(ImGuiKey_Delete);
    ASSERT_EQ(drawn().nm.size(), 3u);
    for (int i = 0; i < 3; ++i) { // two remain whatever is done
        press(1, place(drawn().nm[0], drawn().value[0], 1));
        release(1);
    }
    EXPECT_EQ(drawn().nm.size(), 2u);
}

TEST_F(SpectrumPanels, AnyCurveBecomesAFewPointsNearIt) {
    click("draw_curve");
    EXPECT_TRUE(std::holds_alternative<Drawn>(light()));
    const Spectrum lamp = scaled(blackbody(2700), 1 / value_at(blackbody(2700), 780, Outside::zero));
    const Spectrum few = points_near(lamp, CurveKind::light);
    EXPECT_LE(few.nm.size(), 40u);
    EXPECT_TRUE(make_spectrum(few.nm, few.value));
    for (double nm = 380; nm <= 780; nm += 7)
        EXPECT_NEAR(value_at(few, nm, Outside::zero), value_at(lamp, nm, Outside::zero), 0.006) << nm;
    const Spectrum line{{588.9, 589, 589.1}, {0, 5, 0}};
    EXPECT_EQ(value_at(points_near(line, CurveKind::light), 589, Outside::zero), 1);
}

TEST_F(SpectrumPanels, AFileDroppedBesideThePictureIsForWhatIsOpen) {
    const auto file = std::filesystem::temp_directory_path() / ("lueur-dropped-" + std::to_string(getpid()) + ".spd");
    std::ofstream(file) << "400 0.1\n700 0.9\n";
    EXPECT_EQ(kind_of_dropped(file), DroppedKind::spectrum);
    frame();
    const auto lamp = edit_of_dropped(file, document_.scene(), {}, state_->spectrum_target);
    ASSERT_TRUE(lamp) << lamp.error();
    EXPECT_TRUE(std::holds_alternative<SetEmissionSpectrum>(*lamp));
    panel_ = materials_panel;
    frame();
    const auto paint = edit_of_dropped(file, document_.scene(), {}, state_->spectrum_target);
    ASSERT_TRUE(paint) << paint.error();
    EXPECT_EQ(std::get<SetReflectance>(*paint).material, MaterialIndex{1});
    EXPECT_FALSE(edit_of_dropped(file, document_.scene(), {}, {})) << "nothing is open";
    std::filesystem::remove(file);
}

} // namespace
} // namespace lueur
