// The JSON that `--report` writes: what a run cost and how good its solution is.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/solve/solution.h"
#include "editor/batch_solve.h"
#include "editor/commands/command_line.h"

namespace lueur {

// Seconds, bytes and percent as the keys say. `stage_seconds` in the order they ran.
std::string report_json(const std::string& command, const BatchParams& params, const Solution& solution,
                        const SolveStatus& status, const BatchSolveResult& solved,
                        const std::vector<std::pair<std::string, double>>& stage_seconds);

} // namespace lueur
