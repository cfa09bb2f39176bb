// The chart of methods: its front, its curves, when it looks, what it runs, and its table.
#include "editor/chart/method_chart.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/solver_words.h"
#include "editor/chart/chart_picture.h"
#include "editor/chart/chart_table.h"
#include "editor/chart/edit_times.h"
#include "editor/chart/milestones.h"
#include "editor/chart/run_chart.h"
#include "tests/support/scenes.h"

namespace lueur {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const ChartMethod gathering{SolverKind::gathering, {}, ChartMethod{}.oracle},
    shooting{SolverKind::shooting, {}, ChartMethod{}.oracle}, paths{SolverKind::reference, {}, ChartMethod{}.oracle};

ChartPoint look(double seconds, double error) {
    ChartPoint point;
    point.seconds = seconds;
    point.estimated_error = 2 * error;
    point.error.rms = 1.1 * error;
    point.error.rms_without_noise = error;
    point.error.median = 0.5 * error;
    point.error.percentile95 = 2 * error;
    point.error.reference_error = 0.015;
    point.error.counted = 390;
    point.error.missing = 3;
    point.error.resolution = resolution_of(0.015, 390);
    return point;
}

MethodChart small_method_chart() {
    MethodChart chart;
    chart.scene = "box & ball";
    chart.points = 393;
    chart.reference_paths = 4096;
    chart.reference_error = 0.015;
    chart.runs.push_back({gathering,
                          0,
                          budget_of(gathering, 0),
                          RunEnd::settled,
                          "",
                          0.2,
                          100,
                          5000,
                          {look(0.01, 0.5), look(0.2, 0.1)}});
    chart.runs.push_back({shooting, 0, budget_of(shooting, 0), RunEnd::settled, "", 0.1, 100, 700, {look(0.1, 0.2)}});
    chart.runs.push_back({paths, 0, budget_of(paths, 0), RunEnd::settled, "", 4, 0, 6400, {look(4, 0.02)}});
    chart.runs.push_back({gathering,
                          1,
                          budget_of(gathering, 1),
                          RunEnd::settled,
                          "",
                          1,
                          400,
                          50000,
                          {look(0.05, 0.4), look(0.15, 0.25), look(1, 0.03)}});
    chart.runs.push_back({shooting,
                          1,
                          budget_of(shooting, 1),
                          RunEnd::unfinished,
                          "not finished within 2 s",
                          2,
                          400,
                          9000,
                          {look(0.5, 0.3)}});
    chart.runs.push_back({shooting,
                          2,
                          budget_of(shooting, 2),
                          RunEnd::not_started,
                          "a smaller budget: not finished within 2 s",
                          0,
                          0,
                          0,
                          {}});
    chart.seconds = 7.3;
    return chart;
}

TEST(ParetoFront, KeepsWhatNothingBeatsInBoth) {
    const std::vector<glm::dvec2> points{{3, 1}, {1, 5}, {2, 5}, {2, 2}, {4, 1}, {1, 6}, {5, 0.5}, {2, 2}};
    EXPECT_THAT(pareto_front(points), ElementsAre(1, 3, 0, 6));
    EXPECT_TRUE(pareto_front({}).empty());
    EXPECT_THAT(pareto_front(std::vector<glm::dvec2>{{1, 1}}), ElementsAre(0));
}

TEST(ParetoFront, NoPointOfItIsBeatenAndEveryOtherIs) {
    std::vector<glm::dvec2> points;
    std::uint32_t x = 1;
    for (int i = 0; i < 300; ++i) {
        const auto next = [&] { return double((x = x * 1664525u + 1013904223u) >> 20); };
        const double first = next();
        points.emplace_back(first, next());
    }
    const auto front = pareto_front(points);
    const std::set<std::size_t> in_front(front.begin(), front.end());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool beaten = std::ranges::any_of(
            points, [&](const glm::dvec2& p) { return p.x <= points[i].x && p.y <= points[i].y && p != points[i]; });
        EXPECT_EQ(beaten, !in_front.contains(i)) << i;
    }
}

TEST(MethodChart, ACurveIsTheBestOfAllBudgetsByThen) {
    const MethodChart chart = small_method_chart();
    EXPECT_THAT(curve_of(chart, gathering),
                ElementsAre(glm::dvec2(0.01, 0.5), glm::dvec2(0.05, 0.4), glm::dvec2(0.15, 0.25), glm::dvec2(0.2, 0.1),
                            glm::dvec2(1, 0.03)));
    EXPECT_THAT(curve_of(chart, shooting), ElementsAre(glm::dvec2(0.1, 0.2)));
    EXPECT_THAT(methods_of(chart), ElementsAre(gathering, shooting, paths));
    const auto front = front_of(chart);
    std::vector<glm::dvec2> places;
    for (const FrontPoint& point : front) {
        places.push_back(point.place);
        EXPECT_EQ(point.method, point.place.x == 0.1 ? shooting : point.place.x == 4 ? paths : gathering);
    }
    EXPECT_THAT(places, ElementsAre(glm::dvec2(0.01, 0.5), glm::dvec2(0.05, 0.4), glm::dvec2(0.1, 0.2),
                                    glm::dvec2(0.2, 0.1), glm::dvec2(1, 0.03), glm::dvec2(4, 0.02)));
}

TEST(MethodChart, HasEveryMethodOnceAndBudgetsThatGrow) {
    const auto methods = all_chart_methods();
    std::set<std::string> names;
    for (const ChartMethod& method : methods) EXPECT_TRUE(names.insert(to_string(method)).second) << to_string(method);
    for (const SolverKind solver : all_solvers) {
        if (solver == SolverKind::automatic) continue;
        EXPECT_TRUE(std::ranges::any_of(methods, [&](const ChartMethod& m) { return m.solver == solver; }))
            << to_string(solver);
    }
    EXPECT_TRUE(names.contains("jacobi, hemicube"));
    EXPECT_TRUE(names.contains("hierarchical, flux"));
    for (const ChartMethod& method : methods)
        for (std::size_t level = 1; level < chart_budgets().size(); ++level) {
            const ChartBudget less = budget_of(method, level - 1), more = budget_of(method, level);
            EXPECT_LT(more.element_scale, less.element_scale);
            EXPECT_LT(more.target_error, less.target_error);
            EXPECT_GE(more.samples, less.samples);
        }
}

TEST(Milestones, AreSetByWorkNotByTheClock) {
    Milestones milestones(true), without_shots(false);
    SolveStatus status;
    EXPECT_FALSE(milestones.due(status)) << "nothing has been done";
    std::vector<std::uint32_t> due;
    for (status.sweeps = 1; status.sweeps <= 20; ++status.sweeps) {
        status.seconds += 10;
        if (milestones.due(status)) due.push_back(status.sweeps);
        EXPECT_FALSE(milestones.due(status)) << "the same sweep is looked at once";
    }
    EXPECT_THAT(due, ElementsAre(1, 2, 3, 4, 6, 9, 13, 19));
    status.rays_per_receiver = 64; // new rays: from the first sweep again
    status.sweeps = 1;
    EXPECT_TRUE(milestones.due(status));
    status.shots = 1;
    EXPECT_TRUE(milestones.due(status));
    status.shots = 100; // many at once
    EXPECT_TRUE(milestones.due(status));
    status.shots = 149;
    EXPECT_FALSE(milestones.due(status));
    status.shots = 150;
    EXPECT_TRUE(milestones.due(status));
    EXPECT_TRUE(without_shots.due(status)) << "the sweep";
    status.shots = 500;
    EXPECT_FALSE(without_shots.due(status));
}

TEST(ChartTable, ReadsWhatItWrites) {
    const MethodChart chart = small_method_chart();
    const std::string text = chart_table(chart);
    const auto read = parse_chart_table(text, "a.csv");
    ASSERT_TRUE(read) << read.error().front();
    EXPECT_EQ(chart_table(*read), text);
    ASSERT_EQ(read->runs.size(), chart.runs.size());
    for (std::size_t i = 0; i < chart.runs.size(); ++i) {
        const ChartRun &a = chart.runs[i], &b = read->runs[i];
        EXPECT_EQ(a.method, b.method);
        EXPECT_EQ(a.level, b.level);
        EXPECT_EQ(a.budget.samples, b.budget.samples);
        EXPECT_EQ(a.end, b.end);
        EXPECT_EQ(a.reason, b.reason);
        EXPECT_EQ(a.seconds, b.seconds);
        EXPECT_EQ(a.elements, b.elements);
        EXPECT_EQ(a.rays, b.rays);
        ASSERT_EQ(a.points.size(), b.points.size());
        for (std::size_t k = 0; k < a.points.size(); ++k) {
            EXPECT_EQ(a.points[k].seconds, b.points[k].seconds);
            EXPECT_NEAR(a.points[k].error.rms_without_noise, b.points[k].error.rms_without_noise, 1e-9);
            EXPECT_NEAR(a.points[k].error.resolution, b.points[k].error.resolution, 1e-9);
            EXPECT_NEAR(a.points[k].estimated_error, b.points[k].estimated_error, 1e-9);
            EXPECT_EQ(a.points[k].error.missing, b.points[k].error.missing);
        }
    }
    EXPECT_EQ(read->reference_paths, chart.reference_paths);
    EXPECT_NEAR(read->reference_error, chart.reference_error, 1e-9);
    EXPECT_EQ(read->points, chart.points);
    EXPECT_NEAR(read->seconds, chart.seconds, 1e-9);
}

TEST(ChartTable, TellsEveryFaultWithItsPlace) {
    EXPECT_THAT(parse_chart_table("x,y\n1,2\n", "a.csv").error().front(), testing::StartsWith("a.csv:1:1: "));
    EXPECT_FALSE(parse_chart_table("", "a.csv"));
    std::string text = chart_table(small_method_chart());
    text.replace(text.find("gathering"), 9, "gathering?");
    text.replace(text.find("unfinished"), 10, "exhausted");
    const auto faults = parse_chart_table(text, "a.csv");
    ASSERT_FALSE(faults);
    ASSERT_EQ(faults.error().size(), 2u);
    EXPECT_THAT(faults.error()[0],
                testing::StartsWith("a.csv:2:1: solver is \"gathering?\"; allowed: auto, gathering, "));
    EXPECT_THAT(faults.error()[1], HasSubstr("end is \"exhausted\"; allowed: settled, unfinished, "));
    text = chart_table(small_method_chart());
    text += "jacobi,hemicube\n";
    EXPECT_THAT(parse_chart_table(text, "a.csv").error().front(), HasSubstr(": 2 columns; 22 are needed"));
}

TEST(ChartPicture, DrawsEveryMethodAndMarksWhatFailed) {
    const MethodChart chart = small_method_chart();
    const Chart picture = picture_of(chart);
    ASSERT_EQ(picture.panels.size(), 1u);
    EXPECT_EQ(picture.series.size(), 3u);
    ASSERT_EQ(picture.panels[0].failures.size(), 1u);
    EXPECT_EQ(picture.panels[0].failures[0].series, 1u);
    EXPECT_EQ(picture.panels[0].failures[0].x, 2);
    EXPECT_EQ(picture.panels[0].front.size(), 6u);
    EXPECT_THAT(failures_of(chart), ElementsAre("\u00d7 not finished within 2 s \u2013 shooting from level 1 on"));
    const std::string svg = svg_text(picture);
    for (const char* word :
         {">gathering<", ">shooting<", ">reference<", "box &amp; ball", "solve time, s", "not finished within 2 s"})
        EXPECT_THAT(svg, HasSubstr(word));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
    EXPECT_TRUE(svg_text(picture_of({})).ends_with("</svg>\n"));
}

// A small room: both live solvers come within a few per cent of the paths, larger budgets within fewer, and the same
// seed gives the same errors.
TEST(RunChart, ChartsASmallRoom) {
    const Scene scene = test::small_room();
    ChartParams params;
    params.points = 60;
    params.reference_paths = 512;
    params.time_limit = 60;
    params.methods = {gathering, shooting, paths};
    params.levels = 2;
    std::vector<std::string> told;
    double last = 0;
    const auto progress = [&](double share, const std::string& what, const MethodChart&) {
        EXPECT_GE(share, 0);
        EXPECT_LE(share, 1);
        last = share;
        if (told.empty() || told.back() != what) told.push_back(what);
    };
    const MethodChart chart = run_chart(scene, params, test::never, progress);
    EXPECT_THAT(told, ElementsAre("reference paths", "gathering", "shooting", "reference", "gathering", "shooting",
                                  "reference"));
    EXPECT_GE(last, 5.0 / 6);
    EXPECT_EQ(chart.points, 60);
    EXPECT_GT(chart.reference_error, 0);
    EXPECT_LT(chart.reference_error, 0.2);
    ASSERT_EQ(chart.runs.size(), 6u);
    for (const ChartRun& run : chart.runs) {
        EXPECT_EQ(run.end, RunEnd::settled) << to_string(run.method) << ": " << run.reason;
        ASSERT_FALSE(run.points.empty());
        EXPECT_EQ(run.points.back().seconds, run.seconds);
        for (std::size_t i = 1; i < run.points.size(); ++i) EXPECT_GT(run.points[i].seconds, run.points[i - 1].seconds);
        EXPECT_LT(run.points.back().error.rms, run.level == 0 ? 0.6 : 0.25) << to_string(run.method);
        EXPECT_GT(run.rays, 0u);
    }
    const MethodChart again = run_chart(scene, params, test::never);
    ASSERT_EQ(again.runs.size(), chart.runs.size());
    for (std::size_t i = 0; i < chart.runs.size(); ++i) {
        ASSERT_EQ(again.runs[i].points.size(), chart.runs[i].points.size());
        for (std::size_t k = 0; k < chart.runs[i].points.size(); ++k)
            EXPECT_EQ(again.runs[i].points[k].error.rms, chart.runs[i].points[k].error.rms);
    }
}

TEST(EditTimes, AreThoseOfASceneThatSettles) {
    const auto times = edit_times(test::small_room(), 60, test::never);
    ASSERT_TRUE(times);
    EXPECT_GT(times->reflectance, 0);
    EXPECT_GT(times->dimmer, 0);
    EXPECT_GT(times->spectrum, 0);
    EXPECT_FALSE(edit_times(test::small_room(), 1e-9, test::never)) << "no time";
    const std::atomic<bool> always{true};
    EXPECT_FALSE(edit_times(test::small_room(), 60, always));
    EXPECT_FALSE(edit_times({}, 60, test::never)) << "nothing to edit";
}

TEST(RunChart, MarksWhatDoesNotSettle) {
    ChartParams params;
    params.points = 20;
    params.reference_paths = 64;
    params.levels = 2;
    params.methods = {gathering, shooting};
    params.run_limit = 1e-9;
    for (const ChartRun& run : run_chart(test::small_room(), params, test::never).runs) {
        EXPECT_EQ(run.end, run.level == 0 ? RunEnd::unfinished : RunEnd::not_started);
        EXPECT_THAT(run.reason, HasSubstr("not finished within 1e-09 s"));
    }
    params.run_limit = 60;
    params.row_memory = 1e-3;
    params.methods = {gathering};
    EXPECT_EQ(run_chart(test::small_room(), params, test::never).runs[0].end, RunEnd::out_of_memory);
    params.row_memory = 1000;
    params.time_limit = 1e-9;
    for (const ChartRun& run : run_chart(test::small_room(), params, test::never).runs) {
        EXPECT_EQ(run.end, RunEnd::not_started);
        EXPECT_THAT(run.reason, HasSubstr("for all are over"));
    }
    // All of the light stays for ever: there is no finite solution, and a path of the reference ends at its limit only.
    params.time_limit = 60;
    params.points = 2;
    params.reference_paths = 16;
    params.methods = {gathering};
    const MethodChart furnace = run_chart(test::furnace(1), params, test::never);
    ASSERT_FALSE(furnace.runs.empty());
    EXPECT_EQ(furnace.runs[0].end, RunEnd::refused);
    EXPECT_THAT(furnace.runs[0].reason, HasSubstr("no finite solution"));
    const std::atomic<bool> always{true};
    EXPECT_TRUE(run_chart(test::small_room(), params, always).runs.empty());
}

} // namespace
} // namespace lueur
