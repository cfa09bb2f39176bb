// Error against time of one scene, method by method: the figures behind `lueur chart` and the editor's chart panel.
//
// A method is a solver with what else decides how it works; a budget is what it may spend (elements, target error,
// samples). A run is one of both: a solve from nothing to its end, looked at on the way.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/scene/scene.h"
#include "core/view/error_statistics.h"

namespace lueur {

struct ChartMethod {
    SolverKind solver = SolverKind::gathering;
    FormFactorMethod form_factors = FormFactorMethod::automatic; // automatic where the solver has none to choose
    RefinementOracle oracle = RefinementOracle::error;           // of the hierarchical solver only
    bool operator==(const ChartMethod&) const = default;
};
std::string to_string(const ChartMethod& method); // "jacobi, hemicube"
bool has_oracle(SolverKind solver);

// Every method there is, in the order of the enums.
std::vector<ChartMethod> all_chart_methods();

struct ChartBudget {
    double element_scale = 1; // longest element edge, times the automatic one (or the scene's own)
    double target_error = 0.02;
    int samples = 0; // of form factors; 0: the method has none
    bool operator==(const ChartBudget&) const = default;
};
// From hardly anything to more than one waits for, in steps that about triple the time.
std::span<const ChartBudget> chart_budgets();
ChartBudget budget_of(const ChartMethod& method, std::size_t level); // samples filled in

// How a run ended.
enum class RunEnd {
    settled,       // the solver says that it is done
    unfinished,    // not within the time limit of a run
    refused,       // the solver would not begin: too large, no finite solution
    diverged,      // began and went astray: its word, or figures that are not finite
    out_of_memory, //
    not_started,   // the time for all is over, or a smaller budget of the method did not end well
};
inline constexpr std::array all_run_ends{RunEnd::settled,  RunEnd::unfinished,    RunEnd::refused,
                                         RunEnd::diverged, RunEnd::out_of_memory, RunEnd::not_started};
std::string to_string(RunEnd end);

struct ChartPoint {             // a look at a run
    double seconds = 0;         // of solving; looking is not counted
    double estimated_error = 1; // what the solver says of itself
    ErrorStatistics error;      // against the reference
};

struct ChartRun {
    ChartMethod method;
    std::size_t level = 0; // of chart_budgets
    ChartBudget budget;
    RunEnd end = RunEnd::not_started;
    std::string reason;             // why not settled, in a line
    double seconds = 0;             // of solving, until it ended
    std::uint32_t elements = 0;     // of the mesh
    std::uint64_t rays = 0;         // traced
    std::vector<ChartPoint> points; // in order of time; the last of a settled run is its end
};

struct MethodChart {
    std::string scene;
    int points = 0;             // measured at
    int reference_paths = 0;    // a point
    double reference_error = 0; // RMS of the reference's relative standard errors over the points that count
    double seconds = 0;         // that all runs took
    std::vector<ChartRun> runs; // in the order they were run
};

// Which of the points (time, error) no other one beats in both, in order of time; of equal ones the first.
std::vector<std::size_t> pareto_front(std::span<const glm::dvec2> points);

// A method's curve: the least error that any of its runs had reached by then. x: seconds, y: error (RMS without noise).
std::vector<glm::dvec2> curve_of(const MethodChart& chart, const ChartMethod& method);
// The best of all methods, and whose each point is.
struct FrontPoint {
    glm::dvec2 place{0};
    ChartMethod method;
};
std::vector<FrontPoint> front_of(const MethodChart& chart);
std::vector<ChartMethod> methods_of(const MethodChart& chart); // in the order they first ran

} // namespace lueur
