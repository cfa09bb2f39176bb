// Traced paths in a solution: irradiance of each vertex, pass by pass, until its own standard error is small enough.
#include <algorithm>
#include <cmath>

#include "core/solve/error_estimate.h"
#include "core/solve/solution_steps.h"
#include "core/solve/traced_field.h"

namespace lueur {

using State = Solution::State;

namespace {

constexpr std::uint32_t first_passes = 2; // before these a spread says little

double relative_error(const State& s) {
    const std::uint32_t count = static_cast<std::uint32_t>(s.mesh.vertices.size());
    std::vector<float> illuminance(count), deviation(count);
    for (std::uint32_t v = 0; v < count; ++v) {
        double sum = 0;
        for (int b = 0; b < path_batches; ++b) sum += s.traced->batches[std::size_t(v) * path_batches + std::size_t(b)];
        const std::uint32_t passes = s.traced->passes_at(v);
        illuminance[v] = passes > 0 ? static_cast<float>(sum / path_batches / passes) : 0.0f;
        deviation[v] = static_cast<float>(s.traced->standard_error(v));
    }
    return relative_rms(illuminance, deviation, {}, vertex_areas(s.mesh), s.traced->buried);
}

} // namespace

void start_reference(State& s, bool same_sources) {
    if (!s.fully_refined()) {
        s.phase = SolvePhase::refine;
        return;
    }
    if (!s.traced || !s.solving || !same_sources) {
        s.traced = std::make_unique<TracedField>(make_traced_field(s));
        s.status.sweeps = 0;
    }
    s.solving = true;
    s.phase = SolvePhase::solve;
}

void step_reference(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::solving;
    if (absorbs_nothing(s)) return fail(s, no_finite_solution);
    const std::uint32_t before = s.traced->cursor;
    const bool done = trace_pass(s, cancel, *s.traced);
    if (s.traced->cut_short)
        return fail(s, "paths are reflected more than 20,000 times here: a reflectance is too close to 1");
    const std::uint32_t vertices = static_cast<std::uint32_t>(s.mesh.vertices.size());
    s.status.paths += std::uint64_t((done ? vertices : s.traced->cursor) - before) * path_batches;
    if (!done) {
        const double target = s.scene->solve.target_error;
        // Errors fall with the root of the paths.
        if (s.status.estimated_error < 1 && s.status.estimated_error > 0)
            s.status.progress = std::clamp(std::pow(target / s.status.estimated_error, 2.0), 0.0, 1.0);
        return;
    }
    s.status.sweeps = s.traced->passes;
    s.status.unshot_share = 0;
    if (s.traced->passes < first_passes) return;
    s.status.estimated_error = std::min(1.0, relative_error(s));
    if (s.status.estimated_error <= s.scene->solve.target_error) settle(s);
}

} // namespace lueur
