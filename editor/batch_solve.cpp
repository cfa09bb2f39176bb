#include "editor/batch_solve.h"

#include <chrono>

namespace lueur {

std::string to_string(SolveEnd end) {
    switch (end) {
    case SolveEnd::settled:
        return "settled";
    case SolveEnd::out_of_time:
        return "out of time";
    case SolveEnd::cancelled:
        return "cancelled";
    case SolveEnd::failed:
        return "failed";
    }
    return {};
}

BatchSolveResult solve_batch(Solution& solution, const BatchSolveParams& params, const std::atomic<bool>& cancel) {
    using Clock = std::chrono::steady_clock;
    BatchSolveResult result;
    const auto start = Clock::now();
    auto before = start;
    for (;;) {
        if (cancel) {
            result.end = SolveEnd::cancelled;
            break;
        }
        if (params.geometry_only && solution.world()) break;
        const bool more = solution.step(cancel);
        const auto now = Clock::now();
        // A step belongs to the stage that it ended in; the last one settles what the solver did.
        SolveStage stage = solution.status().stage;
        if (stage == SolveStage::settled) stage = SolveStage::solving;
        result.stage_seconds[static_cast<std::size_t>(stage)] += std::chrono::duration<double>(now - before).count();
        before = now;
        if (params.progress) params.progress(solution.status());
        if (solution.status().stage == SolveStage::failed) {
            result.end = SolveEnd::failed;
            break;
        }
        if (!more) {
            if (cancel) result.end = SolveEnd::cancelled;
            break;
        }
        const double seconds = std::chrono::duration<double>(now - start).count();
        const SolveStatus& status = solution.status();
        const bool lit = status.sweeps > 0 || status.shots > 0 || status.estimated_error < 1;
        if (params.time_limit > 0 && seconds >= params.time_limit && lit) {
            result.end = SolveEnd::out_of_time;
            break;
        }
    }
    result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return result;
}

} // namespace lueur
