// Is the estimated error right? For each scene and budget (rays, time, mesh, solver): the true relative RMS error over
// the estimated one, and the share of true values within the stated 95 % intervals.
//
//     error_calibration SCENE... [--points N] [--paths N] [--dump FILE.csv]
//
// Truth: paths at vertices and at surface points; their own variance is subtracted. With --dump every vertex as a line.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

#include "core/scene/scene_file.h"
#include "core/scene/solver_words.h"
#include "core/transport/mesh.h"
#include "tests/support/error_truth.h"

using namespace lueur;

namespace {

const std::atomic<bool> never{false};

struct Options {
    int points = 300, paths = 8192;
    std::FILE* dump = nullptr;
};

struct Truth {
    std::vector<test::TruePoint> coarse, fine, surface;
};

Truth truth_of(const Solution& solution, const Options& options) {
    return {test::true_vertices(solution, true, options.points, options.paths, 7),
            test::true_vertices(solution, false, options.points, options.paths, 8),
            test::true_surface_points(solution, options.points, options.paths, 9)};
}

void report(const std::string& budget, const Solution& solution, const Truth& truth, const Options& options) {
    const auto field = solution.field();
    const auto& points = solution.state().refined ? truth.fine : truth.coarse;
    const test::ErrorVerdict at_vertices = test::judge_vertices(*field, points),
                             scene = test::judge_scene(solution, *field, truth.surface);
    const auto marked = [](double ratio) { return ratio < 0.5 || ratio > 2 ? "!" : " "; };
    fmt::print("  {:<34} {:7.0f} {:7.2f} {:7.2f} {:6.2f}{} {:6.1f}{} {:7.2f} {:7.2f} {:6.2f}{} {:6.1f} {:6.2f}\n",
               budget, 1e3 * solution.status().seconds, 100 * at_vertices.truth, 100 * at_vertices.estimate,
               at_vertices.ratio(), marked(at_vertices.ratio()), 100 * at_vertices.covered,
               at_vertices.covered < 0.95 ? "!" : " ", 100 * scene.truth, 100 * scene.estimate, scene.ratio(),
               marked(scene.ratio()), 100 * scene.covered, 100 * scene.reference);
    if (options.dump)
        fmt::print("      worst {:.0f} % at {:.3f} {:.3f} {:.3f}\n", 100 * scene.worst, scene.worst_at.x,
                   scene.worst_at.y, scene.worst_at.z);
    std::fflush(stdout);
    if (options.dump)
        for (const test::TruePoint& p : points) {
            if (p.vertex >= field->irradiance_xyz.size()) continue;
            const MeshVertex& v = solution.state().mesh.vertices[p.vertex];
            fmt::print(options.dump, "{},{},{},{:.3f},{:.3f},{:.3f},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n", budget,
                       p.vertex, p.vertex < solution.state().mesh.coarse_vertex_count ? 1 : 0, v.position.x,
                       v.position.y, v.position.z, v.surface, p.illuminance, p.standard_error,
                       field->irradiance_xyz[p.vertex].y, field->error[p.vertex], field->interpolation_error[p.vertex]);
        }
}

void heading(const std::string& scene) {
    fmt::print("{}\n  {:<34} {:>7} {:>7} {:>7} {:>6}  {:>6}  {:>7} {:>7} {:>6}  {:>6} {:>6}\n", scene, "budget", "ms",
               "true %", "est. %", "ratio", "in 95%", "scene %", "est. %", "ratio", "in 95%", "ref. %");
}

Solution settled(const Scene& scene) {
    Solution solution(std::make_shared<const Scene>(scene));
    while (solution.step(never)) {
    }
    return solution;
}

void run(Scene scene, const Options& options) {
    heading(scene.name);
    scene.solve.target_error = 0.001;
    scene.solve.solver = SolverKind::gathering;
    const double size = automatic_element_size(scene);
    for (const double factor : {1.0, 2.0, 0.6}) {
        scene.solve.element_size = factor * size;
        scene.solve.max_rays = 64;
        Truth truth;
        for (const int rays : {64, 256, 1024}) {
            if (factor != 1 && rays == 1024) continue;
            scene.solve.max_rays = rays;
            const Solution solution = settled(scene);
            if (truth.coarse.empty()) truth = truth_of(solution, options);
            report(fmt::format("mesh x{}, {} rays", factor, rays), solution, truth, options);
            if (rays == 256) {
                // Cut off in the middle: wherever the solver is after a share of its steps.
                const double all = solution.status().seconds;
                for (const double share : {0.03, 0.1, 0.2, 0.35, 0.6, 0.8}) {
                    Solution cut(std::make_shared<const Scene>(scene));
                    while (cut.step(never) && (!cut.world() || cut.state().phase == SolvePhase::sketch ||
                                               cut.status().seconds < share * all)) {
                    }
                    report(fmt::format("mesh x{}, {} rays, cut at {:.0f} %", factor, rays, 100 * share), cut, truth,
                           options);
                }
            }
        }
        if (factor != 1) continue;
        for (const SolverKind kind : {SolverKind::shooting, SolverKind::gauss_seidel, SolverKind::hierarchical})
            for (const double target : {0.1, 0.02}) {
                scene.solve.target_error = target;
                scene.solve.solver = kind;
                const Solution solution = settled(scene);
                if (!solution.status().settled) {
                    fmt::print("  {}: {}\n", to_string(kind), solution.status().message);
                    continue;
                }
                report(fmt::format("{}, target {:.0f} %", to_string(kind), 100 * target), solution, truth, options);
            }
        scene.solve.target_error = 0.001;
        scene.solve.solver = SolverKind::gathering;
    }
}

} // namespace

int main(int argc, char** argv) {
    Options options;
    std::vector<std::string> scenes;
    for (int i = 1; i < argc; ++i) {
        if (!std::strcmp(argv[i], "--points") && i + 1 < argc)
            options.points = std::max(1, std::atoi(argv[++i]));
        else if (!std::strcmp(argv[i], "--paths") && i + 1 < argc)
            options.paths = std::max(16, std::atoi(argv[++i]));
        else if (!std::strcmp(argv[i], "--dump") && i + 1 < argc)
            options.dump = std::fopen(argv[++i], "w");
        else
            scenes.emplace_back(argv[i]);
    }
    for (const std::string& file : scenes) {
        auto loaded = load_scene(file);
        if (!loaded) {
            for (const std::string& line : loaded.error()) fmt::print(stderr, "{}\n", line);
            return 2;
        }
        run(loaded->scene, options);
    }
    return 0;
}
