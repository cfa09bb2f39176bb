// `lueur measure`: irradiance and illuminance at the points of a table.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "core/scene/files.h"
#include "core/scene/scene_file.h"
#include "editor/commands/batch_session.h"
#include "editor/commands/measure_table.h"
#include "editor/commands/output_file.h"

namespace lueur {

namespace {

int measure(const MeasureCommand& command, BatchSession& session) {
    const auto scene = session.load();
    const auto place = check_writable(command.output);
    if (!place) session.error(place.error());
    // Mistakes in the table are told whether the scene is right or not; they do not depend on its axes.
    const auto text = read_bytes(command.points);
    if (!text) {
        session.error(command.points.string() + ": " + text.error());
        return exit_mistake;
    }
    const auto table = parse_measure_table(*text, command.points.string(), scene ? scene->up : UpAxis::y);
    if (!table)
        for (const auto& fault : table.error()) session.error(fault);
    if (!scene || !place || !table) return exit_mistake;
    const auto faults = check(*scene);
    for (const auto& fault : faults) session.error(command.batch.scene.string() + ": " + fault);
    if (!faults.empty()) return exit_mistake;

    Solution solution(scene);
    if (const auto solved = session.solve(solution, command.at == MeasureAt::reference); !solved) return solved.error();

    std::vector<Irradiance> measured;
    session.timed("measure", [&] {
        const MeasureParams params{.at = command.at, .rays = command.rays, .seed = scene->solve.seed};
        measured = measure_points(solution, table->points, params, session.cancel(),
                                  [&](double share) { session.bar().show("measure", share); });
    });
    if (session.cancel()) return exit_interrupted;

    const auto off =
        std::ranges::count_if(measured, [](const Irradiance& e) { return !std::isfinite(e.illuminance_lx); });
    if (off > 0)
        session.warning(
            fmt::format("{} of {} points lie on no lit surface and read nan; use --at gather for points in the air",
                        off, measured.size()));
    const bool rgb = scene->solve.wavelengths.rule == WavelengthRule::rgb;
    const auto written = write_text(command.output, completed_table(*table, measured, rgb));
    if (!written) return session.failed(written.error());
    session.bar().wipe();
    const std::string how =
        command.at == MeasureAt::reference
            ? std::string("traced paths")
            : fmt::format("solved in {:.2f} s, {}", session.solve_seconds(), error_text(solution.status()));
    fmt::print("{}: {} points, {}\n", command.output.string(), measured.size(), how);
    return session.finish(solution);
}

} // namespace

int run(const MeasureCommand& command) {
    return run_batch("measure", command.batch, [&](BatchSession& session) { return measure(command, session); });
}

} // namespace lueur
