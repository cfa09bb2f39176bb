// A whole solve in one call, for commands and tests: steps until the target error is met, the time is out or it is
// cancelled.
#pragma once

#include <array>
#include <atomic>
#include <functional>

#include "core/solve/solution.h"

namespace lueur {

struct BatchSolveParams {
    double time_limit = 0;      // s; 0: none. Not before the first sweep or shot: until then there is nothing to show
    bool geometry_only = false; // stop as soon as rays can be traced: the reference needs no field
    std::function<void(const SolveStatus&)> progress; // after each step, from the calling thread
};

enum class SolveEnd { settled, out_of_time, cancelled, failed };
std::string to_string(SolveEnd end);

struct BatchSolveResult {
    SolveEnd end = SolveEnd::settled;
    double seconds = 0;
    std::array<double, static_cast<std::size_t>(SolveStage::failed) + 1> stage_seconds{}; // of each SolveStage
};

BatchSolveResult solve_batch(Solution& solution, const BatchSolveParams& params, const std::atomic<bool>& cancel);

} // namespace lueur
