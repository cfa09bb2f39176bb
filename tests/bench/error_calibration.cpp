// Is the estimated error right? For each scene and budget (rays, time, mesh, solver): the true relative RMS error over
// the estimated one, and the share of true values within the stated 95 % intervals.
//
//     error_calibration SCENE... [--budgets rays,cuts,mesh,solvers] [--solvers jacobi,...] [--element-size METRES]
//                       [--points N] [--paths N] [--seconds N] [--dump FILE.csv]
//
// Truth: paths at vertices and at surface points; their own variance is subtracted. --seconds: of solving, a scene;
// what runs then is judged where it is, what comes after is left out. With --dump every point judged
// as a line: position, m; truth, its standard error, what the field says, its standard deviation, lx.
#include <cstdio>

#include <fmt/format.h>

#include "core/scene/solver_words.h"
#include "core/transport/mesh.h"
#include "tests/bench/program.h"
#include "tests/support/error_truth.h"

using namespace lueur;

namespace {

const std::atomic<bool> never{false};

struct Options {
    int points = 200, paths = 4096;
    double seconds = 1e9, element_size = 0;
    std::string budgets = "rays,cuts,mesh,solvers", solvers = "shooting,gauss_seidel,jacobi,overshooting,hierarchical";
    std::FILE* dump = nullptr;

    bool wants(std::string_view word) const { return has(budgets, word); }
    bool wants(SolverKind kind) const { return wants("solvers") && has(solvers, to_string(kind)); }

private:
    static bool has(const std::string& list, std::string_view word) {
        return ("," + list + ",").find(fmt::format(",{},", word)) != list.npos;
    }
};

struct Truth {
    std::vector<test::TruePoint> coarse, fine, surface;
};

Truth truth_of(const Solution& solution, const Options& options) {
    return {test::true_vertices(solution, true, options.points, options.paths, 7),
            test::true_vertices(solution, false, options.points, options.paths, 8),
            test::true_surface_points(solution, options.points, options.paths, 9)};
}

// How many of all budgets are right.
struct Tally {
    int judged = 0, vertices = 0, covered = 0, scene = 0;
};

// One scene: what is left of its time, and its verdicts.
struct Bench {
    const Options& options;
    Tally& tally;
    double left;

    Solution solve(const Scene& scene, double share_of = 0, double share = 1) {
        Solution solution(std::make_shared<const Scene>(scene));
        const double most = share_of > 0 ? share * share_of : left;
        // To judge anything there must be direct light.
        while (solution.step(never) && (!solution.world() || solution.state().phase == SolvePhase::sketch ||
                                        solution.status().seconds < most)) {
        }
        left -= solution.status().seconds;
        return solution;
    }

    void report(const std::string& budget, const Solution& solution, const Truth& truth) {
        const SolveStatus& status = solution.status();
        if (status.stage == SolveStage::failed) {
            fmt::print("  {:<34} {}\n", budget, status.message);
            return;
        }
        const auto field = solution.field();
        const auto& points = solution.state().refined ? truth.fine : truth.coarse;
        const test::ErrorVerdict at_vertices = test::judge_vertices(solution, *field, points),
                                 scene = test::judge_scene(solution, *field, truth.surface);
        const auto marked = [](const test::ErrorVerdict& verdict) { return verdict.right() ? " " : "!"; };
        // So many points know a share of 0.95 to this.
        const double enough = 0.95 - 2 * std::sqrt(0.95 * 0.05 / std::max(1, at_vertices.counted));
        tally.judged += 1;
        tally.vertices += at_vertices.right();
        tally.covered += at_vertices.covered >= enough;
        tally.scene += scene.right();
        fmt::print("  {:<34} {:7.0f} {:7.2f} {:7.2f} {:6.3g}{} {:6.1f}{} {:7.2f} {:7.2f} {:6.3g}{} {:6.1f} {:6.2f}\n",
                   status.settled ? budget : budget + ", cut off", 1e3 * status.seconds, 100 * at_vertices.truth,
                   100 * at_vertices.estimate, at_vertices.ratio(), marked(at_vertices), 100 * at_vertices.covered,
                   at_vertices.covered < enough ? "!" : " ", 100 * scene.truth, 100 * scene.estimate, scene.ratio(),
                   marked(scene), 100 * scene.covered, 100 * scene.reference);
        if (options.dump) {
            dump(budget + " vertices", at_vertices);
            dump(budget + " surface", scene);
        }
        std::fflush(stdout);
    }

    void dump(const std::string& what, const test::ErrorVerdict& verdict) const {
        for (const test::JudgedPoint& p : verdict.points)
            fmt::print(options.dump, "\"{}\",{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{:.4f}\n", what, p.position.x,
                       p.position.y, p.position.z, p.truth, p.noise, p.value, p.sigma);
    }
};

void heading(const std::string& scene) {
    fmt::print("{}\n  {:<34} {:>7} {:>7} {:>7} {:>6}  {:>6}  {:>7} {:>7} {:>6}  {:>6} {:>6}\n", scene, "budget", "ms",
               "true %", "est. %", "ratio", "in 95%", "scene %", "est. %", "ratio", "in 95%", "ref. %");
}

void run(Scene scene, const Options& options, Tally& tally) {
    heading(scene.name);
    Bench bench{options, tally, options.seconds};
    scene.solve.target_error = 0.001;
    scene.solve.solver = SolverKind::gathering;
    const double size = options.element_size > 0 ? options.element_size : automatic_element_size(scene);
    for (const double factor : {1.0, 2.0, 0.6}) {
        if (factor != 1 && !options.wants("mesh")) continue;
        scene.solve.element_size = factor * size;
        scene.solve.solver = SolverKind::gathering;
        scene.solve.target_error = 0.001;
        Truth truth;
        for (const int rays : {64, 256, 1024}) {
            if (factor != 1 ? rays == 1024 : rays != 64 && !options.wants("rays")) continue;
            if (!(bench.left > 0)) return;
            scene.solve.max_rays = rays;
            const Solution solution = bench.solve(scene);
            if (truth.coarse.empty()) truth = truth_of(solution, options);
            bench.report(fmt::format("mesh x{}, {} rays", factor, rays), solution, truth);
        }
        if (options.wants("cuts")) {
            // Cut off in the middle: wherever the solver is after a share of its steps.
            scene.solve.max_rays = 256;
            const double all = bench.solve(scene).status().seconds;
            for (const double share : factor == 1 ? std::vector{0.03, 0.1, 0.2, 0.35, 0.6, 0.8} : std::vector{0.15}) {
                if (!(bench.left > 0)) return;
                bench.report(fmt::format("mesh x{}, 256 rays, {:.0f} %", factor, 100 * share),
                             bench.solve(scene, all, share), truth);
            }
        }
        if (factor != 1) continue;
        scene.solve.max_rays = SolveSettings{}.max_rays;
        for (const SolverKind kind : {SolverKind::shooting, SolverKind::gauss_seidel, SolverKind::jacobi,
                                      SolverKind::overshooting, SolverKind::hierarchical})
            for (const double target : {0.1, 0.02}) {
                if (!options.wants(kind)) continue;
                if ((kind == SolverKind::jacobi || kind == SolverKind::overshooting) && target == 0.1) continue;
                if (!(bench.left > 0)) return;
                scene.solve.target_error = target;
                scene.solve.solver = kind;
                bench.report(fmt::format("{}, target {:.0f} %", to_string(kind), 100 * target), bench.solve(scene),
                             truth);
            }
    }
}

} // namespace

int main(int argc, char** argv) {
    Options options;
    std::vector<std::string> scenes;
    std::string dump;
    CLI::App program("Is the estimated error right?");
    program.add_option("scenes", scenes)->required();
    program.add_option("--points", options.points)->check(CLI::PositiveNumber);
    program.add_option("--paths", options.paths)->check(CLI::Range(16, 1 << 24));
    program.add_option("--seconds", options.seconds, "of solving, a scene");
    program.add_option("--budgets", options.budgets);
    program.add_option("--solvers", options.solvers, "of the budget of that name");
    program.add_option("--element-size", options.element_size, "m; of the mesh x1, else as each scene's size asks for");
    program.add_option("--dump", dump);
    if (const auto status = bench::parse(program, argc, argv)) return *status;
    if (!dump.empty()) options.dump = std::fopen(dump.c_str(), "w");
    Tally tally;
    for (const std::string& file : scenes) {
        const auto scene = bench::scene_of(file);
        if (!scene) return bench::exit_mistake;
        run(*scene, options, tally);
    }
    fmt::print("{} budgets; ratio between 0.5 and 2 at the vertices: {}, of the scene: {}; 95 % inside: {}\n",
               tally.judged, tally.vertices, tally.scene, tally.covered);
    return 0;
}
