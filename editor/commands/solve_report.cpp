#include "editor/commands/solve_report.h"

#include <algorithm>

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <tbb/task_arena.h>

#include "core/scene/solver_words.h"
#include "core/solve/choose_solver.h"

namespace lueur {

std::string report_json(const std::string& command, const BatchParams& params, const Solution& solution,
                        const SolveStatus& status, const BatchSolveResult& solved,
                        const std::vector<std::pair<std::string, double>>& stage_seconds) {
    const SolveSettings& settings = solution.scene()->solve;
    nlohmann::ordered_json stages = nlohmann::ordered_json::object();
    for (auto [stage, seconds] : stage_seconds) {
        std::ranges::replace(stage, ' ', '_');
        stages[stage] = seconds;
    }

    rusage usage{};
    getrusage(RUSAGE_SELF, &usage); // ru_maxrss is in KiB on Linux

    nlohmann::ordered_json report;
    report["version"] = LUEUR_VERSION;
    report["command"] = command;
    report["scene"] = params.scene.string();
    report["solver"] = to_string(settings.solver);
    report["solver_in_use"] = to_string(chosen_solver(*solution.scene()));
    if (uses_form_factors(chosen_solver(*solution.scene()))) {
        report["form_factors"] = to_string(settings.form_factors);
        report["form_factor_samples"] = settings.form_factor_samples;
    }
    report["wavelengths"] = to_string(settings.wavelengths);
    report["wavelengths_in_use"] = status.wavelengths;
    if (status.predicted_colour_error >= 0) report["predicted_colour_error"] = status.predicted_colour_error;
    report["seed"] = settings.seed;
    report["threads"] = tbb::this_task_arena::max_concurrency();
    report["end"] = to_string(solved.end);
    report["stage_seconds"] = stages;
    report["solve_seconds"] = solved.seconds;
    report["rays"] = status.rays;
    report["form_factor_cost"] = status.form_factor_cost;
    report["form_factor_pairs"] = status.form_factor_pairs;
    report["form_factors_warned"] = status.form_factors_warned;
    report["form_factors_missed"] = status.form_factors_missed;
    if (status.paths > 0) report["paths"] = status.paths;
    report["rays_per_receiver"] = status.rays_per_receiver;
    report["rows"] = status.receivers;
    report["row_entries"] = status.row_entries;
    report["residual"] = status.residual;
    report["matrix_patches"] = status.matrix_patches;
    report["matrix_bytes"] = status.matrix_bytes;
    report["vertices"] = status.vertices;
    report["elements"] = status.elements;
    if (chosen_solver(*solution.scene()) == SolverKind::hierarchical) {
        report["links"] = status.links;
        report["link_elements"] = status.link_elements;
        report["link_levels"] = status.link_levels;
        report["link_rounds"] = status.link_rounds;
        report["error_bound_percent"] = 100 * status.error_bound;
    }
    report["sweeps"] = status.sweeps;
    report["shots"] = status.shots;
    report["emitted_lumens"] = status.emitted_lumens;
    report["unshot_share"] = status.unshot_share;
    report["target_error_percent"] = 100 * settings.target_error;
    report["estimated_error_percent"] = 100 * status.estimated_error;
    if (!status.message.empty()) report["message"] = status.message;
    report["peak_memory_bytes"] = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    // Names of files need not be UTF-8.
    return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace lueur
