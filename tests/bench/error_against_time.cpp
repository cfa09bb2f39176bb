// Error against time of one scene, every solver, as CSV on stdout: method,seconds,rms_percent,median_percent.
//
//     error_against_time SCENE [POINTS]
//
// Truth: paths traced from random surface points (its own noise is told on stderr). Time: the solver's own, measuring
// not counted; for paths the whole of tracing them, which gives these points and no picture. On stderr: what edits
// cost.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "core/scene/scene_file.h"
#include "core/solve/solution_state.h"
#include "core/view/measure.h"
#include "tests/support/surface_points.h"

using namespace lueur;

namespace {

const std::atomic<bool> never{false};

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Relative RMS and median error over the points brighter than 2 % of the mean, in per cent.
std::pair<double, double> errors(const std::vector<Irradiance>& values, const std::vector<Irradiance>& truth) {
    double mean = 0;
    for (const Irradiance& t : truth) mean += t.illuminance_lx / double(truth.size());
    std::vector<double> e;
    for (std::size_t i = 0; i < truth.size(); ++i)
        if (truth[i].illuminance_lx > 0.02 * mean && std::isfinite(values[i].illuminance_lx))
            e.push_back(100 * std::abs(values[i].illuminance_lx / truth[i].illuminance_lx - 1));
    if (e.empty()) return {100, 100};
    std::sort(e.begin(), e.end());
    double square = 0;
    for (const double x : e) square += x * x / double(e.size());
    return {std::sqrt(square), e[e.size() / 2]};
}

void watch(const Scene& scene, const char* name, const std::vector<MeasurePoint>& points,
           const std::vector<Irradiance>& truth) {
    Solution solution(std::make_shared<const Scene>(scene));
    double next = 0;
    bool more = true;
    while (more) {
        more = solution.step(never);
        const SolveStatus& s = solution.status();
        if (!solution.world() || solution.state().phase == SolvePhase::sketch || (more && s.seconds < next)) continue;
        const auto [rms, median] = errors(measure_points(solution, points, {MeasureAt::field, 0, 1}, never), truth);
        fmt::print("{},{:.5f},{:.3f},{:.3f}\n", name, s.seconds, rms, median);
        next = std::max(0.004, s.seconds * 1.15);
    }
    fmt::print(stderr, "{}: settled after {:.0f} ms, estimated error {:.2f} %, {:.1f} M rays\n", name,
               1e3 * solution.status().seconds, 100 * solution.status().estimated_error,
               1e-6 * double(solution.status().rays));
}

void edits(Scene scene) {
    Solution solution(std::make_shared<const Scene>(scene));
    while (solution.step(never)) {
    }
    const auto settle = [&](SolveFrom from) {
        solution.update(std::make_shared<const Scene>(scene), from);
        while (solution.step(never)) {
        }
        return 1e3 * solution.status().last_edit_seconds;
    };
    std::vector<double> paint, dimmer;
    for (int k = 0; k < 5; ++k) {
        scene.materials[std::size_t(k) % scene.materials.size()].reflectance = 0.2 + 0.1 * k;
        paint.push_back(settle(SolveFrom::reflectance));
        scene.luminaires[std::size_t(k) % scene.luminaires.size()].dimmer = 0.3 + 0.1 * k;
        dimmer.push_back(settle(SolveFrom::sources));
    }
    std::sort(paint.begin(), paint.end());
    std::sort(dimmer.begin(), dimmer.end());
    fmt::print(stderr, "edits settled (median of 5): reflectance {:.1f} ms, dimmer {:.1f} ms\n", paint[2], dimmer[2]);
}

} // namespace

int main(int argc, char** argv) {
    auto loaded = argc > 1 ? load_scene(argv[1])
                           : std::unexpected(std::vector<std::string>{"usage: error_against_time SCENE [POINTS]"});
    if (!loaded) {
        for (const std::string& line : loaded.error()) fmt::print(stderr, "{}\n", line);
        return 2;
    }
    Scene scene = loaded->scene;
    Solution solution(std::make_shared<const Scene>(scene));
    while (!solution.world()) solution.step(never);
    const auto points = test::surface_points(solution, argc > 2 ? std::atoi(argv[2]) : 500, 1);
    const auto truth = measure_points(solution, points, {MeasureAt::reference, 8192, 99}, never);
    double noise = 0;
    for (const Irradiance& t : truth) noise += t.standard_error_percent / double(truth.size());
    fmt::print(stderr, "truth: 8192 paths a point, {:.2f} % standard error on average\n", noise);
    fmt::print("method,seconds,rms_percent,median_percent\n");
    scene.solve.solver = SolverKind::gathering;
    watch(scene, "gathering", points, truth);
    edits(scene);
    scene.solve.solver = SolverKind::shooting;
    watch(scene, "shooting", points, truth);
    for (int paths = 16; paths <= 2048; paths *= 2) {
        const double start = now();
        const auto values = measure_points(solution, points, {MeasureAt::reference, paths, 5}, never);
        const double seconds = now() - start;
        const auto [rms, median] = errors(values, truth);
        fmt::print("paths ({} points only),{:.5f},{:.3f},{:.3f}\n", points.size(), seconds, rms, median);
    }
    return 0;
}
