#include "editor/chart/method_chart.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include "core/scene/solver_words.h"

namespace lueur {

std::string to_string(const ChartMethod& method) {
    std::string words = to_string(method.solver);
    if (method.form_factors != FormFactorMethod::automatic) words += ", " + to_string(method.form_factors);
    if (has_oracle(method.solver)) words += ", " + to_string(method.oracle);
    std::ranges::replace(words, '_', ' ');
    return words;
}

bool has_oracle(SolverKind solver) {
    return solver == SolverKind::hierarchical;
}

std::vector<ChartMethod> all_chart_methods() {
    std::vector<ChartMethod> methods;
    for (const SolverKind solver : all_solvers) {
        if (solver == SolverKind::automatic) continue;
        if (has_oracle(solver)) {
            for (const RefinementOracle oracle : all_oracles)
                methods.push_back({solver, FormFactorMethod::automatic, oracle});
        } else if (uses_form_factors(solver)) {
            for (const FormFactorMethod form_factors : all_form_factor_methods)
                if (form_factors != FormFactorMethod::automatic) methods.push_back({solver, form_factors, {}});
        } else
            methods.push_back({solver, FormFactorMethod::automatic, {}});
    }
    for (ChartMethod& method : methods)
        if (!has_oracle(method.solver)) method.oracle = ChartMethod{}.oracle;
    return methods;
}

std::string to_string(RunEnd end) {
    switch (end) {
    case RunEnd::settled:
        return "settled";
    case RunEnd::unfinished:
        return "unfinished";
    case RunEnd::refused:
        return "refused";
    case RunEnd::diverged:
        return "diverged";
    case RunEnd::out_of_memory:
        return "out of memory";
    case RunEnd::not_started:
        return "not started";
    }
    return {};
}

std::vector<std::size_t> pareto_front(std::span<const glm::dvec2> points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
        return std::tuple(points[a].x, points[a].y, a) < std::tuple(points[b].x, points[b].y, b);
    });
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || points[i].y < points[front.back()].y) front.push_back(i);
    return front;
}

namespace {

std::vector<glm::dvec2> places_of(const MethodChart& chart, const ChartMethod& method) {
    std::vector<glm::dvec2> places;
    for (const ChartRun& run : chart.runs)
        if (run.method == method)
            for (const ChartPoint& point : run.points)
                places.emplace_back(point.seconds, point.error.rms_without_noise);
    return places;
}

} // namespace

std::vector<glm::dvec2> curve_of(const MethodChart& chart, const ChartMethod& method) {
    const std::vector<glm::dvec2> places = places_of(chart, method);
    std::vector<glm::dvec2> curve;
    for (const std::size_t i : pareto_front(places)) curve.push_back(places[i]);
    return curve;
}

std::vector<FrontPoint> front_of(const MethodChart& chart) {
    std::vector<glm::dvec2> places;
    std::vector<ChartMethod> whose;
    for (const ChartMethod& method : methods_of(chart)) {
        for (const glm::dvec2& place : curve_of(chart, method)) {
            places.push_back(place);
            whose.push_back(method);
        }
    }
    std::vector<FrontPoint> front;
    for (const std::size_t i : pareto_front(places)) front.push_back({places[i], whose[i]});
    return front;
}

std::vector<ChartMethod> methods_of(const MethodChart& chart) {
    std::vector<ChartMethod> methods;
    for (const ChartRun& run : chart.runs)
        if (std::ranges::find(methods, run.method) == methods.end()) methods.push_back(run.method);
    return methods;
}

} // namespace lueur
