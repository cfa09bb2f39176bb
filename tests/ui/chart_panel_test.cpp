// The chart panel in an ImGui context without a window: buttons ask, a click on a point takes its method.
#include <cmath>

#include <gtest/gtest.h>
#include <imgui.h>

#include "tests/support/scenes.h"
#include "tests/ui/panel_fixture.h"
#include "ui/panels.h"

namespace lueur {
namespace {

const ChartMethod shooting{SolverKind::shooting, FormFactorMethod::automatic, RefinementOracle::error},
    hemicubes{SolverKind::jacobi, FormFactorMethod::hemicube, RefinementOracle::error},
    links{SolverKind::hierarchical, FormFactorMethod::automatic, RefinementOracle::flux};

ChartRun run_of(const ChartMethod& method, double seconds, double error) {
    ChartRun run;
    run.method = method;
    run.end = RunEnd::settled;
    run.seconds = seconds;
    ChartPoint& point = run.points.emplace_back();
    point.seconds = seconds;
    point.error.rms_without_noise = error;
    return run;
}

class ChartPanelTest : public test::PanelFixture {
protected:
    void SetUp() override {
        PanelFixture::SetUp();
        document_ = Document(test::small_room());
        MethodChart chart;
        chart.points = 100;
        // Decades apart in both: x from 0.8 * 0.01 to 1.3 * 1, y from 0.7 * 0.01 to 1.4 * 1 are shown.
        chart.runs = {run_of(shooting, 0.01, 1), run_of(hemicubes, 0.1, 0.1), run_of(links, 1, 0.01)};
        chart.runs.push_back({hemicubes, 1, {}, RunEnd::refused, "too large", 0.5, 0, 0, {}});
        state_->chart.chart = std::make_shared<const MethodChart>(std::move(chart));
    }
    std::optional<Edit> frame(float height = 300) {
        std::optional<Edit> edit;
        draw_frame([&] { edit = chart_panel(document_, snapshot_, *state_); }, height);
        return edit;
    }
    std::optional<Edit> click(float x, float y) {
        auto& io = ImGui::GetIO();
        std::optional<Edit> taken;
        const auto step = [&] {
            if (auto edit = frame()) taken = std::move(edit);
        };
        step();
        io.MousePos = {x, y};
        step();
        io.MouseDown[0] = true;
        step();
        io.MouseDown[0] = false;
        step();
        return taken;
    }
    ImVec2 place(double seconds, double error) {
        frame();
        const auto area = box_of("chart");
        const double x = std::log(seconds / 0.008) / std::log(1.3 / 0.008),
                     y = std::log(error / 0.007) / std::log(1.4 / 0.007);
        return {area[0] + static_cast<float>(x) * (area[2] - area[0]),
                area[3] - static_cast<float>(y) * (area[3] - area[1])};
    }

    Snapshot snapshot_;
};

TEST_F(ChartPanelTest, AClickOnAPointTakesItsMethod) {
    auto at = place(0.1, 0.1);
    const auto jacobi = click(at.x + 3, at.y - 3);
    ASSERT_TRUE(jacobi && std::holds_alternative<SetSolve>(*jacobi));
    SolveSettings expected = document_.scene().solve;
    expected.solver = SolverKind::jacobi;
    expected.form_factors = FormFactorMethod::hemicube;
    EXPECT_EQ(std::get<SetSolve>(*jacobi).solve, expected) << "and nothing else";
    at = place(1, 0.01);
    const auto hierarchical = click(at.x, at.y);
    ASSERT_TRUE(hierarchical);
    EXPECT_EQ(std::get<SetSolve>(*hierarchical).solve.solver, SolverKind::hierarchical);
    EXPECT_EQ(std::get<SetSolve>(*hierarchical).solve.oracle, RefinementOracle::flux);
    at = place(0.012, 0.02);
    EXPECT_FALSE(click(at.x, at.y)) << "nothing is there";
    const auto area = box_of("chart");
    at = place(0.5, 0.1);
    EXPECT_TRUE(click(at.x, area[1] + 7)) << "the cross of the run that failed";
}

TEST_F(ChartPanelTest, ButtonsAsk) {
    frame();
    auto box = box_of("chart:compute");
    click(box[0] + 5, box[1] + 5);
    EXPECT_EQ(state_->chart.request, ChartRequest::compute);
    state_->chart.request = ChartRequest::none;
    state_->chart.running = true;
    state_->chart.what = "jacobi, hemicube";
    frame();
    box = box_of("chart:cancel");
    click(box[0] + 5, box[1] + 5);
    EXPECT_EQ(state_->chart.request, ChartRequest::cancel);
}

TEST_F(ChartPanelTest, DrawsWithAndWithoutAnythingToShow) {
    for (int i = 1; i < 50; ++i) snapshot_.history.push_back({0.001 * i, 1, 1.0 / i});
    snapshot_.status.seconds = 0.05;
    snapshot_.status.estimated_error = 0.02;
    for (const float height : {300.0f, 60.0f, 1.0f}) EXPECT_FALSE(frame(height));
    state_->chart.chart = std::make_shared<const MethodChart>();
    EXPECT_FALSE(frame());
    state_->chart.chart.reset();
    EXPECT_FALSE(frame());
    snapshot_ = {};
    EXPECT_FALSE(frame());
    state_->chart.what = "the scene has no lit surface to measure on";
    EXPECT_FALSE(frame());
}

} // namespace
} // namespace lueur
