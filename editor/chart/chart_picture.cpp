#include "editor/chart/chart_picture.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace lueur {

namespace {

double nice_below(double value) { // 1, 2, 5, 10 ...
    const double decade = std::pow(10.0, std::floor(std::log10(value) + 1e-9));
    for (const double step : {5.0, 2.0})
        if (step * decade <= value * (1 + 1e-9)) return step * decade;
    return decade;
}
double nice_above(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value) + 1e-9));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * decade >= value * (1 - 1e-9)) return step * decade;
    return 10 * decade;
}

constexpr double worst_shown = 300, best_shown = 0.01; // percent

} // namespace

int colour_of(SolverKind solver) {
    switch (solver) {
    case SolverKind::automatic:
    case SolverKind::gathering:
        return 1;
    case SolverKind::shooting:
        return 0;
    case SolverKind::overshooting:
        return 5;
    case SolverKind::jacobi:
        return 4;
    case SolverKind::gauss_seidel:
        return 2;
    case SolverKind::hierarchical:
        return 3;
    case SolverKind::reference:
        return 7;
    }
    return 7;
}

ChartMark mark_of(const ChartMethod& method) {
    if (has_oracle(method.solver)) switch (method.oracle) {
        case RefinementOracle::form_factor:
            return ChartMark::triangle;
        case RefinementOracle::flux:
            return ChartMark::square;
        case RefinementOracle::error:
            return ChartMark::circle;
        }
    switch (method.form_factors) {
    case FormFactorMethod::automatic:
        return ChartMark::circle;
    case FormFactorMethod::analytic:
        return ChartMark::diamond;
    case FormFactorMethod::point_to_disk:
        return ChartMark::bar;
    case FormFactorMethod::area_sampled:
        return ChartMark::plus;
    case FormFactorMethod::monte_carlo:
        return ChartMark::star;
    case FormFactorMethod::hemicube:
        return ChartMark::square;
    case FormFactorMethod::hemisphere:
        return ChartMark::triangle;
    }
    return ChartMark::circle;
}

std::vector<std::string> failures_of(const MethodChart& chart) {
    // The first failure of each method: what follows from it is not told again.
    std::vector<std::pair<std::string, std::vector<std::string>>> by_reason;
    for (const ChartMethod& method : methods_of(chart)) {
        const auto failed = std::ranges::find_if(
            chart.runs, [&](const ChartRun& run) { return run.method == method && run.end != RunEnd::settled; });
        if (failed == chart.runs.end()) continue;
        const std::string reason = failed->reason.empty() || failed->end == RunEnd::unfinished
                                       ? failed->reason.empty() ? to_string(failed->end) : failed->reason
                                       : fmt::format("{}: {}", to_string(failed->end), failed->reason);
        const std::string who = failed->level == 0
                                    ? to_string(method)
                                    : fmt::format("{} from level {} on", to_string(method), failed->level);
        auto known = std::ranges::find(by_reason, reason, &std::pair<std::string, std::vector<std::string>>::first);
        if (known == by_reason.end()) known = by_reason.insert(by_reason.end(), {reason, {}});
        known->second.push_back(who);
    }
    std::vector<std::string> lines;
    for (const auto& [reason, who] : by_reason) {
        std::string line = "\u00d7 " + reason + " \u2013 ";
        for (std::size_t i = 0; i < who.size(); ++i) line += (i > 0 ? "; " : "") + who[i];
        lines.push_back(std::move(line));
    }
    return lines;
}

Chart picture_of(const MethodChart& chart) {
    Chart picture;
    picture.title = fmt::format("{}: error of irradiance against solve time", chart.scene);
    picture.note =
        fmt::format("Relative RMS error at {} random surface points against {} traced paths a point, whose own "
                    "standard error ({:.2g} %) is taken off. Wide band: the best of all.",
                    chart.points, chart.reference_paths, 100 * chart.reference_error);
    picture.panel_width = 660;
    picture.panel_height = 440;
    picture.names_width = 210;
    const std::vector<ChartMethod> methods = methods_of(chart);
    double first = 1e30, last = 0, least = 1e30, most = 0, resolution = 0;
    ChartPanel panel;
    for (std::size_t m = 0; m < methods.size(); ++m) {
        picture.series.push_back({to_string(methods[m]), colour_of(methods[m].solver), false, mark_of(methods[m])});
        ChartCurve curve{m, {}, false};
        for (const glm::dvec2& point : curve_of(chart, methods[m])) curve.points.emplace_back(point.x, 100 * point.y);
        panel.curves.push_back(std::move(curve));
    }
    for (const ChartRun& run : chart.runs) {
        for (const ChartPoint& point : run.points) {
            const double error = 100 * point.error.rms_without_noise;
            first = std::min(first, point.seconds), last = std::max(last, point.seconds);
            least = std::min(least, error), most = std::max(most, error);
            resolution = std::max(resolution, 100 * point.error.resolution);
            panel.dots.emplace_back(point.seconds, error);
        }
        if (run.end != RunEnd::settled && run.end != RunEnd::not_started) {
            last = std::max(last, run.seconds);
            const auto m = static_cast<std::size_t>(std::ranges::find(methods, run.method) - methods.begin());
            panel.failures.push_back({m, run.seconds});
        }
    }
    for (const FrontPoint& point : front_of(chart)) panel.front.emplace_back(point.place.x, 100 * point.place.y);
    if (last <= 0) first = 0.001, last = 1, least = 1, most = 100; // nothing to show but why
    first = std::max(first, 1e-5), last = std::max(last, 2 * first);
    least = std::clamp(least, best_shown, worst_shown / 2), most = std::clamp(most, 2 * least, worst_shown);
    panel.x = {"solve time, s", 0.9 * first, 1.15 * last};
    panel.y = {"relative RMS error, %", nice_below(least), nice_above(most)};
    if (resolution > panel.y.low) panel.level = resolution;
    picture.panels.push_back(std::move(panel));
    picture.remarks = failures_of(chart);
    if (resolution > 0)
        picture.remarks.insert(
            picture.remarks.begin(),
            fmt::format("Below {:.2g} % (dotted) an error cannot be told from the noise of the reference. "
                        "Grey: every look at every run; a curve is what its method had reached by then. "
                        "Crosses at the top: a run of that colour ended without settling.",
                        resolution));
    return picture;
}

} // namespace lueur
