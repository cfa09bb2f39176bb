// What the commands without a window share: load, solve with a progress bar, report.
#pragma once

#include <atomic>
#include <chrono>
#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "editor/batch_solve.h"
#include "editor/commands/command_line.h"
#include "editor/commands/progress_bar.h"

namespace lueur {

inline constexpr int exit_done = 0, exit_failed = 1, exit_mistake = 2, exit_interrupted = 130;

// One run of a command. Messages go to stderr as they come.
class BatchSession {
public:
    BatchSession(std::string command, const BatchParams& params, const std::atomic<bool>& cancel);

    // The scene with the command line's overrides; nothing when it has mistakes, which have been told then.
    std::shared_ptr<Scene> load();
    // The exit status when it is not done.
    std::expected<void, int> solve(Solution& solution, bool geometry_only);
    // The last thing a command does: the report, when one is asked for.
    int finish(const Solution& solution) { return finish(solution, solution.status()); }
    int finish(const Solution& solution, const SolveStatus& status); // of what was made of it

    void timed(const std::string& stage, const std::function<void()>& work); // adds to the stage times of the report
    void error(const std::string& line);                                     // as it is: `FILE:LINE:COLUMN: ...`
    void warning(const std::string& line);                                   // `warning: ...`
    int failed(const std::string& line);                                     // `lueur COMMAND: ...`; exit_failed

    const std::atomic<bool>& cancel() const { return cancel_; }
    ProgressBar& bar() { return bar_; }
    double solve_seconds() const { return solved_.seconds; }

private:
    std::string command_;
    const BatchParams& params_;
    const std::atomic<bool>& cancel_;
    ProgressBar bar_;
    std::vector<std::pair<std::string, double>> stage_seconds_;
    BatchSolveResult solved_;
};

std::string error_text(const SolveStatus& status); // "estimated error 1.85 %"

// Runs a command with its threads and Ctrl-C in place; what it throws (no memory) becomes a line and exit_failed.
int run_batch(const std::string& command, const BatchParams& params, const std::function<int(BatchSession&)>& work);

} // namespace lueur
