// `lueur chart`: accuracy against cost, of methods (error against time) or of spectra (colours against channels).
#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "core/scene/scene_file.h"
#include "editor/asset_path.h"
#include "editor/chart/chart_picture.h"
#include "editor/chart/chart_table.h"
#include "editor/chart/edit_times.h"
#include "editor/chart/run_chart.h"
#include "editor/commands/chart_commands.h"
#include "editor/commands/output_file.h"

namespace lueur {

namespace {

ChartParams chart_params(const ChartCommand& command) {
    ChartParams params;
    if (command.quick) {
        params.points = 200;
        params.reference_error = 0.02;
        params.time_limit = 25;
    }
    if (command.points > 0) params.points = command.points;
    if (command.paths > 0) params.reference_paths = command.paths;
    if (command.batch.time_limit > 0) params.time_limit = command.batch.time_limit;
    params.run_limit = command.run_time;
    if (const auto& only = command.batch.solve.solver; only && *only != SolverKind::automatic)
        std::erase_if(params.methods, [&](const ChartMethod& method) { return method.solver != *only; });
    return params;
}

void print_front(const MethodChart& chart) {
    std::string whose;
    for (const FrontPoint& point : front_of(chart)) {
        std::string name = to_string(point.method);
        if (name != whose) fmt::print("  from {:8.3f} s, {:6.2f} %: {}\n", point.place.x, 100 * point.place.y, name);
        whose = std::move(name);
    }
}

} // namespace

std::shared_ptr<Scene> chart_scene(const ChartCommand& command, BatchSession& session) {
    auto scene = session.load();
    bool possible = scene != nullptr;
    for (const auto& file : {command.output, command.csv}) {
        if (file.empty()) continue;
        if (const auto place = check_writable(file); !place) {
            session.error(place.error());
            possible = false;
        }
    }
    if (!possible) return {};
    const auto faults = check(*scene);
    for (const auto& fault : faults) session.error(command.batch.scene.string() + ": " + fault);
    return faults.empty() ? scene : nullptr;
}

int chart_methods(const ChartCommand& command, BatchSession& session) {
    const auto scene = chart_scene(command, session);
    if (!scene) return exit_mistake;
    if (scene->name.empty()) scene->name = command.batch.scene.stem().string();
    MethodChart chart;
    session.timed("runs", [&] {
        chart = run_chart(*scene, chart_params(command), session.cancel(),
                          [&](double share, const std::string& what, const MethodChart&) {
                              session.bar().show("charting", share, what);
                          });
    });
    session.bar().show("editing", 1);
    const auto edits = chart.points > 0 ? edit_times(*scene, 10, session.cancel()) : std::nullopt;
    if (session.cancel()) return exit_interrupted;
    session.bar().wipe();
    if (chart.points == 0) return session.failed("the scene has no lit surface to measure on");
    if (chart.reference_error == 0 && std::ranges::all_of(chart.runs, [](const ChartRun& run) {
            return std::ranges::all_of(run.points, [](const ChartPoint& point) { return point.error.counted == 0; });
        }))
        return session.failed("no light reaches any surface: there is no error to chart");
    if (const auto written = write_text(command.output, svg_text(picture_of(chart))); !written)
        return session.failed(written.error());
    if (!command.csv.empty())
        if (const auto written = write_text(command.csv, chart_table(chart)); !written)
            return session.failed(written.error());
    fmt::print(
        "{}: {} methods, {} runs; reference: {} paths at {} points, {:.2g} % standard error\nThe best of them:\n",
        command.output.string(), methods_of(chart).size(), chart.runs.size(), chart.reference_paths, chart.points,
        100 * chart.reference_error);
    print_front(chart);
    for (const std::string& line : failures_of(chart)) fmt::print("{}\n", line);
    if (edits)
        fmt::print("Settled after an edit (median of 5): reflectance {:.1f} ms, dimmer {:.1f} ms, spectrum {:.1f} ms\n",
                   1e3 * edits->reflectance, 1e3 * edits->dimmer, 1e3 * edits->spectrum);
    return exit_done;
}

int run(const ChartCommand& asked) {
    ChartCommand command = asked;
    if (command.batch.scene.empty()) command.batch.scene = default_scene_file();
    return run_batch("chart", command.batch, [&](BatchSession& session) {
        switch (command.of) {
        case ChartSubject::methods:
            return chart_methods(command, session);
        case ChartSubject::spectra:
            return chart_spectra(command, session);
        }
        return exit_failed;
    });
}

} // namespace lueur
