// Runs every method that a scene admits with ever larger budgets, and measures each against traced paths.
#pragma once

#include <atomic>
#include <functional>

#include "editor/chart/method_chart.h"

namespace lueur {

struct ChartParams {
    int points = 400; // random surface points to measure at
    // Paths of the reference at each point; 0: as many (a power of two) as its standard error needs to come down to
    // reference_error, but no more than fit in a third of the time limit.
    int reference_paths = 0;
    double reference_error = 0.01;
    double time_limit = 90; // s for everything; a run that has begun is ended
    double run_limit = 0;   // s of solving for one run; 0: a twelfth of time_limit
    std::vector<ChartMethod> methods = all_chart_methods();
    std::size_t levels = chart_budgets().size();
    double row_memory = 1024; // MiB that kept rays may take; a matrix has the scene's own limit (solve.matrix_memory)
};

// Budget by budget from the smallest, in each method by method, so that a time limit leaves out the same largest
// budgets of all. A method whose run did not end well is given no larger budget. Everything but times (and so, what the
// time limits leave out) is the same for the same seed.
//
// `progress`: share 0..1 of the time or of the runs, what is run, and the chart so far; from the calling thread, after
// each step. Cancelled: the chart so far.
using ChartProgress = std::function<void(double share, const std::string& what, const MethodChart& so_far)>;
MethodChart run_chart(const Scene& scene, const ChartParams& params, const std::atomic<bool>& cancel,
                      const ChartProgress& progress = {});

} // namespace lueur
