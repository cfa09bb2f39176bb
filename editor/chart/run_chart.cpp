#include "editor/chart/run_chart.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <optional>

#include <fmt/format.h>

#include "core/transport/mesh.h"
#include "core/view/surface_points.h"
#include "editor/chart/milestones.h"

namespace lueur {

namespace {

constexpr int most_reference_paths = 1 << 20;
constexpr double astray = 10; // relative RMS error of a solver that has lost its way

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class ChartRunner {
public:
    ChartRunner(const Scene& scene, const ChartParams& params, const std::atomic<bool>& cancel,
                const ChartProgress& progress)
        : scene_(scene)
        , params_(params)
        , cancel_(cancel)
        , progress_(progress)
        , run_limit_(params.run_limit > 0 ? params.run_limit : params.time_limit / 12) {
        scene_.solve.compare_trichromatic = false;
        chart_.scene = scene.name;
    }

    MethodChart run() {
        if (!make_reference()) return std::move(chart_);
        const std::size_t levels = std::min(params_.levels, chart_budgets().size());
        const std::size_t all = levels * params_.methods.size();
        for (std::size_t level = 0; level < levels; ++level)
            for (const ChartMethod& method : params_.methods) {
                ChartRun& run = chart_.runs.emplace_back();
                run.method = method;
                run.level = level;
                run.budget = budget_of(method, level);
                what_ = to_string(method);
                share_of_runs_ = static_cast<double>(chart_.runs.size() - 1) / static_cast<double>(all);
                show();
                if (const auto why_not = reason_not_to_start(method))
                    run.reason = *why_not;
                else
                    solve(run);
                if (cancel_) {
                    chart_.runs.pop_back(); // what it found depends on when it was stopped
                    return std::move(chart_);
                }
                chart_.seconds += run.seconds;
            }
        return std::move(chart_);
    }

private:
    // The time is up or all runs are done, whatever comes first.
    void show() const {
        if (progress_)
            progress_(std::clamp(seconds_since(start_) / params_.time_limit, share_of_runs_, 1.0), what_, chart_);
    }

    // Points and what arrives there. False: cancelled, or nowhere to measure.
    bool make_reference() {
        Scene scene = scene_;
        scene.solve.solver = SolverKind::gathering; // it traces nothing before the world is there
        base_.emplace(std::make_shared<const Scene>(std::move(scene)));
        while (!base_->world() && !cancel_)
            if (!base_->step(cancel_)) break;
        if (!base_->world()) return false;
        points_ = surface_points(*base_, params_.points, scene_.solve.seed);
        what_ = "reference paths";
        int paths = params_.reference_paths;
        if (paths <= 0) {
            constexpr int pilot = 256;
            const auto start = std::chrono::steady_clock::now();
            trace_truth(pilot);
            const double seconds = seconds_since(start), error = error_statistics(truth_, truth_).reference_error;
            paths = pilot;
            while (paths < most_reference_paths &&
                   error > params_.reference_error * std::sqrt(static_cast<double>(paths) / pilot) &&
                   2 * paths * seconds / pilot < params_.time_limit / 3)
                paths *= 2;
        }
        trace_truth(paths);
        chart_.points = static_cast<int>(truth_.size());
        chart_.reference_paths = paths;
        chart_.reference_error = error_statistics(truth_, truth_).reference_error;
        return !truth_.empty();
    }

    void trace_truth(int paths) {
        truth_ = measure_points(*base_, points_, {MeasureAt::reference, paths, scene_.solve.seed + 99}, cancel_,
                                [&](double) { show(); });
    }

    std::optional<std::string> reason_not_to_start(const ChartMethod& method) const {
        for (const ChartRun& run : chart_.runs) {
            if (!(run.method == method) || &run == &chart_.runs.back() || run.end == RunEnd::settled) continue;
            return fmt::format("a smaller budget: {}", run.reason);
        }
        if (seconds_since(start_) > params_.time_limit)
            return fmt::format("the {:g} s for all are over", params_.time_limit);
        return {};
    }

    // False: the figures are not of this world.
    bool look(ChartRun& run, const Solution& solution) {
        const SolveStatus& status = solution.status();
        const auto values = measure_points(solution, points_, {MeasureAt::field, 0, 1, false}, cancel_);
        if (cancel_) return true;
        const ErrorStatistics error = error_statistics(values, truth_);
        if (2 * error.missing > error.missing + error.counted || error.rms_of_truth > astray) {
            run.end = RunEnd::diverged;
            run.reason = error.rms_of_truth > astray ? fmt::format("relative error {:.2g}", error.rms_of_truth)
                                                     : fmt::format("{} points without a finite figure", error.missing);
            return false;
        }
        run.points.push_back({status.seconds, status.estimated_error, error});
        return true;
    }

    Scene scene_for(const ChartRun& run) const {
        Scene scene = scene_;
        SolveSettings& solve = scene.solve;
        solve.solver = run.method.solver;
        solve.form_factors = run.method.form_factors;
        solve.form_factor_samples = run.budget.samples;
        solve.oracle = run.method.oracle;
        solve.link_tolerance = 0;
        solve.target_error = run.budget.target_error;
        solve.max_rays = 1 << 16; // the target error ends it, or memory
        solve.element_size =
            run.budget.element_scale * (solve.element_size > 0 ? solve.element_size : automatic_element_size(scene));
        return scene;
    }

    void solve(ChartRun& run) {
        std::optional<Solution> solution;
        try {
            solution.emplace(std::make_shared<const Scene>(scene_for(run)));
            step_to_the_end(run, *solution);
        } catch (const std::bad_alloc&) {
            run.end = RunEnd::out_of_memory;
            run.reason = "there is not enough memory";
        }
        if (!solution) return;
        const SolveStatus& status = solution->status();
        run.seconds = status.seconds;
        run.elements = status.elements;
        run.rays = status.rays;
    }

    void step_to_the_end(ChartRun& run, Solution& solution) {
        constexpr double bytes_per_ray = 8; // its end in the coarse and in the fine mesh
        // Shots of the other solvers are taken by the clock, as in the window: shot by shot would cost them time.
        const bool shot_by_shot = run.method.solver == SolverKind::shooting;
        Milestones milestones(shot_by_shot);
        for (;;) {
            const bool more = solution.step(cancel_, shot_by_shot);
            if (cancel_) return;
            const SolveStatus& status = solution.status();
            show();
            if (status.stage == SolveStage::failed) {
                run.end = end_of_failed(status);
                run.reason = status.message;
                return;
            }
            if ((milestones.due(status) || !more) && !look(run, solution)) return;
            if (!more) {
                run.end = RunEnd::settled;
                return;
            }
            if (status.seconds > run_limit_) {
                run.end = RunEnd::unfinished;
                run.reason = fmt::format("not finished within {:.3g} s", run_limit_);
                return;
            }
            if (static_cast<double>(status.row_entries) * bytes_per_ray > params_.row_memory * (1 << 20)) {
                run.end = RunEnd::out_of_memory;
                run.reason = fmt::format("kept rays would take more than {:g} MiB", params_.row_memory);
                return;
            }
        }
    }

    // A solver that has swept or shot has begun.
    static RunEnd end_of_failed(const SolveStatus& status) {
        return status.sweeps > 0 || status.shots > 0 ? RunEnd::diverged : RunEnd::refused;
    }

    Scene scene_;
    const ChartParams& params_;
    const std::atomic<bool>& cancel_;
    const ChartProgress& progress_;
    const double run_limit_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double share_of_runs_ = 0;
    std::string what_;
    std::optional<Solution> base_;
    std::vector<MeasurePoint> points_;
    std::vector<Irradiance> truth_;
    MethodChart chart_;
};

} // namespace

MethodChart run_chart(const Scene& scene, const ChartParams& params, const std::atomic<bool>& cancel,
                      const ChartProgress& progress) {
    return ChartRunner(scene, params, cancel, progress).run();
}

} // namespace lueur
