#include "editor/commands/batch_session.h"

#include <cstdio>
#include <exception>
#include <optional>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "core/scene/scene_file.h"
#include "core/solve/form_factor_matrix.h"
#include "editor/asset_path.h"
#include "editor/commands/interrupt.h"
#include "editor/commands/output_file.h"
#include "editor/commands/solve_report.h"

namespace lueur {

BatchSession::BatchSession(std::string command, const BatchParams& params, const std::atomic<bool>& cancel)
    : command_(std::move(command))
    , params_(params)
    , cancel_(cancel) {}

void BatchSession::error(const std::string& line) {
    bar_.wipe();
    fmt::print(stderr, "{}\n", line);
}

void BatchSession::warning(const std::string& line) {
    error("warning: " + line);
}

int BatchSession::failed(const std::string& line) {
    error(fmt::format("lueur {}: {}", command_, line));
    return exit_failed;
}

void BatchSession::timed(const std::string& stage, const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    stage_seconds_.emplace_back(stage, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

std::shared_ptr<Scene> BatchSession::load() {
    if (!params_.report.empty())
        if (auto possible = check_writable(params_.report); !possible) {
            error(possible.error());
            return {};
        }
    std::shared_ptr<Scene> scene;
    timed("load", [&] {
        auto loaded = load_scene(params_.scene, {.spectrum_library = asset_path("spectra")});
        if (!loaded) {
            for (const auto& line : loaded.error()) error(line);
            return;
        }
        for (const auto& line : loaded->warnings) warning(line);
        scene = std::make_shared<Scene>(std::move(loaded->scene));
        scene->solve = with_overrides(scene->solve, params_.solve);
    });
    return scene;
}

std::expected<void, int> BatchSession::solve(Solution& solution, bool geometry_only) {
    BatchSolveParams params;
    params.time_limit = params_.time_limit;
    params.geometry_only = geometry_only;
    bool stated = false;
    params.progress = [&](const SolveStatus& status) {
        if (status.stage == SolveStage::form_factors && !std::exchange(stated, true))
            error(
                fmt::format("a matrix of {} patches takes {}", status.matrix_patches, bytes_text(status.matrix_bytes)));
        bar_.show(to_string(status.stage), status.progress, error_text(status));
    };
    solved_ = solve_batch(solution, params, cancel_);
    for (const auto stage : {SolveStage::meshing, SolveStage::direct, SolveStage::gathering_rays,
                             SolveStage::form_factors, SolveStage::solving})
        if (const double seconds = solved_.stage_seconds[static_cast<std::size_t>(stage)]; seconds > 0)
            stage_seconds_.emplace_back(to_string(stage), seconds);
    bar_.wipe();

    const SolveStatus& status = solution.status();
    switch (solved_.end) {
    case SolveEnd::cancelled:
        return std::unexpected(exit_interrupted);
    case SolveEnd::failed:
        return std::unexpected(failed(status.message.empty() ? "the solve failed" : status.message));
    case SolveEnd::settled:
    case SolveEnd::out_of_time:
        break;
    }
    if (solved_.end == SolveEnd::out_of_time && !geometry_only) solution.take_stock();
    if (!status.message.empty()) warning(status.message);
    if (params_.solve.target_error && solved_.end == SolveEnd::settled &&
        status.estimated_error > *params_.solve.target_error)
        warning(
            fmt::format("the {} stays above the {:.2g} % asked for: the rays or the mesh of the scene allow no less",
                        error_text(status), 100 * *params_.solve.target_error));
    return {};
}

int BatchSession::finish(const Solution& solution, const SolveStatus& status) {
    if (params_.report.empty()) return exit_done;
    const auto written =
        write_text(params_.report, report_json(command_, params_, solution, status, solved_, stage_seconds_));
    if (!written) return failed(written.error());
    return exit_done;
}

std::string error_text(const SolveStatus& status) {
    if (status.estimated_error >= 1) return "error not estimated yet";
    if (status.estimated_error < 1e-4) return "estimated error under 0.01 %";
    return fmt::format("estimated error {:.2f} %", 100 * status.estimated_error);
}

int run_batch(const std::string& command, const BatchParams& params, const std::function<int(BatchSession&)>& work) {
    std::optional<tbb::global_control> limit;
    if (params.threads > 0)
        limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(params.threads));
    tbb::task_arena arena(params.threads > 0 ? params.threads : tbb::task_arena::automatic);
    const Interrupt interrupt;
    try {
        BatchSession session(command, params, interrupt.requested());
        return arena.execute([&] { return work(session); });
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "lueur {}: there is not enough memory\n", command);
    } catch (const std::exception& error) {
        fmt::print(stderr, "lueur {}: {}\n", command, error.what());
    }
    return exit_failed;
}

} // namespace lueur
