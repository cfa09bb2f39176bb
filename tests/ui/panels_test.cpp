// The panels in an ImGui context without a window: they change nothing untouched, and a drag of a real widget gives its
// edit.
#include "ui/panels.h"

#include <functional>

#include <gtest/gtest.h>
#include <imgui.h>

#include "tests/support/scenes.h"
#include "tests/ui/panel_fixture.h"

namespace lueur {
namespace {

using Panel = std::optional<Edit> (*)(const Document&, const Snapshot&, UiState&);

Scene scene_of_all_kinds() {
    test::SceneBuilder builder;
    const auto grey = builder.material("grey", 0.6);
    const auto coloured = builder.material("red paint", Rgb(0.8, 0.1, 0.2));
    const auto measured =
        builder.material("measured", SpectrumFile{"paint.csv", "x", Spectrum{{400, 700}, {0.2, 0.7}}});
    builder.room("room", {grey, grey, coloured, measured, grey, grey}, {0, 0, 0}, {4, 3, 4});
    std::vector<ObjectIndex> lamps;
    for (int i = 0; i < 4; ++i) {
        const auto x = 0.5f + 0.8f * static_cast<float>(i);
        lamps.push_back(builder.polygon("lamp " + std::to_string(i), grey,
                                        {{x, 2.9f, 1}, {x + 0.3f, 2.9f, 1}, {x + 0.3f, 2.9f, 2}, {x, 2.9f, 2}}));
    }
    builder.light("flat", {lamps[0]}, PowerUnit::lumen, 1000, Flat{});
    builder.light("warm", {lamps[1]}, PowerUnit::watt, 12, Blackbody{2700});
    builder.light("coloured", {lamps[2]}, PowerUnit::exitance, 30, Rgb(1, 0.4, 0.2));
    builder.light("measured", {lamps[3]}, PowerUnit::radiance, 10,
                  SpectrumFile{"lamp.csv", "", Spectrum{{400, 550, 700}, {0, 1, 0}}});
    return builder.build();
}

class PanelsTest : public test::PanelFixture {
protected:
    void SetUp() override {
        PanelFixture::SetUp();
        document_ = Document(scene_of_all_kinds());
    }

    std::optional<Edit> frame(Panel panel) {
        std::optional<Edit> edit;
        draw_frame([&] { edit = panel(document_, snapshot_, *state_); });
        return edit;
    }
    // Presses at one place of the widget and lets go at another, in shares of its width; every edit on the way is
    // applied.
    std::vector<Edit> drag(Panel panel, const std::string& name, float from, float to) {
        auto& io = ImGui::GetIO();
        std::vector<Edit> edits;
        const auto step = [&] {
            if (auto edit = frame(panel)) {
                EXPECT_TRUE(document_.apply(*edit).has_value());
                edits.push_back(std::move(*edit));
            }
        };
        frame(panel);
        const auto box = box_of(name);
        const float y = 0.5f * (box[1] + box[3]);
        io.MousePos = {box[0] + from * (box[2] - box[0]), y};
        step();
        io.MouseDown[0] = true;
        step();
        for (int i = 1; i <= 4; ++i) {
            const float share = from + (to - from) * static_cast<float>(i) / 4;
            io.MousePos = {box[0] + share * (box[2] - box[0]), y};
            step();
        }
        io.MouseDown[0] = false;
        step();
        step();
        return edits;
    }

    Snapshot snapshot_;
};

TEST_F(PanelsTest, UntouchedTheyChangeNothing) {
    for (const Panel panel : {materials_panel, luminaires_panel, display_panel, solver_panel})
        for (std::uint32_t open = 0; open < 4; ++open)
            for (int i = 0; i < 4; ++i) {
                state_->material = MaterialIndex{open % 3};
                state_->luminaire = LuminaireIndex{open};
                state_->selected = ObjectIndex{open};
                EXPECT_FALSE(frame(panel).has_value());
            }
    EXPECT_TRUE(state_->commands.empty());
    EXPECT_FALSE(state_->file_request.has_value());
}

TEST_F(PanelsTest, AnEmptySceneIsNoTrouble) {
    document_ = Document{};
    state_->material = MaterialIndex{7};
    state_->luminaire = LuminaireIndex{7};
    state_->selected = ObjectIndex{7};
    for (const Panel panel : {materials_panel, luminaires_panel, display_panel, solver_panel})
        for (int i = 0; i < 3; ++i) EXPECT_FALSE(frame(panel).has_value());
}

TEST_F(PanelsTest, DraggingADimmerDimsThatLuminaireInOneStepOfUndo) {
    const auto edits = drag(luminaires_panel, "dimmer:warm", 0.99f, 0.5f);
    ASSERT_FALSE(edits.empty());
    for (const auto& edit : edits) {
        ASSERT_TRUE(std::holds_alternative<SetDimmer>(edit));
        EXPECT_EQ(std::get<SetDimmer>(edit).luminaire, LuminaireIndex{1});
    }
    EXPECT_NEAR(document_.scene().luminaires[1].dimmer, 0.5, 0.03);
    EXPECT_EQ(document_.scene().luminaires[0].dimmer, 1);
    document_.undo();
    EXPECT_EQ(document_.scene().luminaires[1].dimmer, 1);
    EXPECT_FALSE(document_.can_undo());
}

TEST_F(PanelsTest, MasterDimmerDimsAllByOneFactorWhenItIsLetGo) {
    ASSERT_TRUE(document_.apply(SetDimmer{LuminaireIndex{2}, 0.4}));
    document_.end_drag();
    const auto edits = drag(luminaires_panel, "dimmer:*", 0.5f, 0.25f); // 100 % -> 50 % of a slider that goes to 200 %
    ASSERT_EQ(edits.size(), 1u);
    const auto& luminaires = document_.scene().luminaires;
    EXPECT_NEAR(luminaires[0].dimmer, 0.5, 0.05);
    EXPECT_NEAR(luminaires[2].dimmer, 0.4 * luminaires[0].dimmer, 1e-9);
    EXPECT_FALSE(state_->preview.has_value());
}

TEST_F(PanelsTest, MuteGoesBackToWhereItWas) {
    ASSERT_TRUE(document_.apply(SetDimmer{LuminaireIndex{0}, 0.3}));
    drag(luminaires_panel, "mute:flat", 0.5f, 0.5f);
    EXPECT_EQ(document_.scene().luminaires[0].dimmer, 0);
    drag(luminaires_panel, "mute:flat", 0.5f, 0.5f);
    EXPECT_EQ(document_.scene().luminaires[0].dimmer, 0.3);
}

TEST_F(PanelsTest, ReflectanceSliderRepaintsTheOpenMaterial) {
    state_->material = MaterialIndex{0};
    const auto edits = drag(materials_panel, "reflectance:number", 0.6f, 0.2f);
    ASSERT_FALSE(edits.empty());
    ASSERT_TRUE(std::holds_alternative<SetReflectance>(edits.back()));
    EXPECT_NEAR(std::get<double>(document_.scene().materials[0].reflectance), 0.2, 0.04);
    state_->material = MaterialIndex{1};
    drag(materials_panel, "reflectance:Blue", 0.2f, 1.0f);
    const auto rgb = std::get<Rgb>(document_.scene().materials[1].reflectance);
    EXPECT_NEAR(rgb.b, 1, 0.02);
    EXPECT_EQ(rgb.r, 0.8) << "the others stay";
}

TEST_F(PanelsTest, GammaAndCurveChangeOnlyTheDisplay) {
    drag(display_panel, "curve:Gamma", 0.5f, 0.5f);
    EXPECT_EQ(document_.scene().display.curve, TransferCurve::gamma);
    const auto edits = drag(display_panel, "gamma", 0.6f, 0.1f);
    ASSERT_FALSE(edits.empty());
    EXPECT_LT(document_.scene().display.gamma.r, 1.4);
    EXPECT_EQ(document_.scene().display.gamma, glm::dvec3(document_.scene().display.gamma.r)) << "all channels";
    for (const auto& edit : edits) EXPECT_EQ(first_stale_stage(edit, document_.scene()), Stage::display);
    EXPECT_EQ(document_.scene().display.max_display_rule, MaxDisplayRule::percentile)
        << "gamma does not touch MAXDISPLAY";
}

TEST_F(PanelsTest, MaxDisplayByHandIsNoLongerAutomatic) {
    state_->exposure.chosen = 80;
    drag(display_panel, "max_display", 0.4f, 0.8f);
    EXPECT_EQ(document_.scene().display.max_display_rule, MaxDisplayRule::by_hand);
    EXPECT_GT(document_.scene().display.max_display, 80);
}

TEST_F(PanelsTest, SolverButtonsAsk) {
    drag(solver_panel, "pause", 0.5f, 0.5f);
    drag(solver_panel, "restart", 0.5f, 0.5f);
    EXPECT_EQ(state_->commands, (std::vector{Command::pause, Command::restart}));
}

TEST_F(PanelsTest, EverySolverCanBeChosenAndShowsWhatItWorksWith) {
    const std::pair<const char*, SolverKind> solvers[] = {{"Shooting", SolverKind::shooting},
                                                          {"Overshooting", SolverKind::overshooting},
                                                          {"Jacobi", SolverKind::jacobi},
                                                          {"Gauss-Seidel", SolverKind::gauss_seidel},
                                                          {"Hierarchical", SolverKind::hierarchical},
                                                          {"Traced paths", SolverKind::reference},
                                                          {"Gathering", SolverKind::gathering},
                                                          {"Automatic", SolverKind::automatic}};
    for (const auto& [name, kind] : solvers) {
        drag(solver_panel, "solver", 0.5f, 0.5f); // opens the list
        drag(solver_panel, std::string("solver:") + name, 0.5f, 0.5f);
        EXPECT_EQ(document_.scene().solve.solver, kind) << name;
    }
    drag(solver_panel, "solver", 0.5f, 0.5f);
    drag(solver_panel, "solver:Jacobi", 0.5f, 0.5f);
    drag(solver_panel, "form_factors", 0.5f, 0.5f);
    drag(solver_panel, "form_factors:Hemicube", 0.5f, 0.5f);
    EXPECT_EQ(document_.scene().solve.form_factors, FormFactorMethod::hemicube);
    drag(solver_panel, "solver", 0.5f, 0.5f);
    drag(solver_panel, "solver:Hierarchical", 0.5f, 0.5f);
    drag(solver_panel, "oracle", 0.5f, 0.5f);
    drag(solver_panel, "oracle:Flux", 0.5f, 0.5f);
    EXPECT_EQ(document_.scene().solve.oracle, RefinementOracle::flux);
}

TEST_F(PanelsTest, CurvesOfSolversThatRanBeforeStayUntilClearedOrAnotherScene) {
    const auto show = [](const Document&, const Snapshot& snapshot, UiState& state) -> std::optional<Edit> {
        convergence_plot(snapshot, 0.02, state, 300, 140);
        return {};
    };
    const auto run = [&](SolverKind solver, FormFactorMethod method) {
        Scene scene = document_.scene();
        scene.solve.solver = solver;
        scene.solve.form_factors = method;
        snapshot_.scene = std::make_shared<const Scene>(scene);
        ++snapshot_.revision;
        snapshot_.history = {{0.1, 1, 1}, {0.2, 0.1 * static_cast<double>(snapshot_.revision), 0.5}};
        frame(show);
    };
    const auto& runs = state_->convergence_runs.runs;
    run(SolverKind::automatic, FormFactorMethod::automatic);
    EXPECT_EQ(runs.size(), 1u);
    run(SolverKind::gathering, FormFactorMethod::hemicube); // the same by its name
    EXPECT_EQ(runs.size(), 1u);
    run(SolverKind::jacobi, FormFactorMethod::hemicube);
    run(SolverKind::jacobi, FormFactorMethod::analytic);
    ASSERT_EQ(runs.size(), 3u);
    EXPECT_EQ(runs[1].name, "Jacobi, Hemicube");
    run(SolverKind::jacobi, FormFactorMethod::hemicube);
    ASSERT_EQ(runs.size(), 3u);
    EXPECT_EQ(runs[1].history.back().unshot_share, 0.1 * static_cast<double>(snapshot_.revision));
    drag(show, "convergence:clear", 0.5f, 0.5f);
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_EQ(runs[0].name, "Jacobi, Hemicube");
    Scene other = *snapshot_.scene;
    other.geometry = std::make_shared<const Geometry>();
    snapshot_.scene = std::make_shared<const Scene>(other);
    snapshot_.history.clear();
    ++snapshot_.revision;
    frame(show);
    EXPECT_TRUE(runs.empty());
}

TEST_F(PanelsTest, ReadoutsDrawWithAndWithoutAnythingToShow) {
    const auto show = [](const Document& document, const Snapshot& snapshot, UiState& state) -> std::optional<Edit> {
        convergence_plot(snapshot, 0.02, state, 300, 140);
        probe_readout(document, state);
        status_line(document, snapshot, state);
        return {};
    };
    EXPECT_FALSE(frame(show).has_value());
    for (int i = 0; i < 200; ++i)
        snapshot_.history.push_back({0.01 * i, i == 7 ? 0.0 : std::pow(0.9, i), 1.0 / (1 + i)});
    snapshot_.status.stage = SolveStage::solving;
    snapshot_.status.progress = 0.5;
    snapshot_.status.message = "a warning";
    state_->hovered = Probe{};
    state_->hovered->object = ObjectIndex{1};
    state_->hovered->luminaire = LuminaireIndex{0};
    EXPECT_FALSE(frame(show).has_value());
    EXPECT_GT(ImGui::GetDrawData()->TotalVtxCount, 500);
}

} // namespace
} // namespace lueur
