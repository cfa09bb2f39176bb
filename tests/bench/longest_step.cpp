// How long is the longest step of a solution? A step is what an edit has to wait for (asked: 10 ms).
//
//     longest_step SCENE [--solver WORD] [--error PERCENT] [--seconds N]
//
// By what the solution was at: steps, all of their processor time on the calling thread, the longest of them by that
// time and by the clock.
#include <algorithm>
#include <chrono>
#include <ctime>
#include <map>

#include <fmt/format.h>

#include "core/scene/solver_words.h"
#include "core/solve/solution_state.h"
#include "tests/bench/program.h"

using namespace lueur;

namespace {

// Of the calling thread: what others do on the machine does not count.
double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

std::string doing(const Solution::State& s) {
    static constexpr const char* phases[] = {"mesh",      "sketch", "light",   "burial", "refine",
                                             "transport", "solve",  "settled", "failed"};
    std::string name = phases[static_cast<int>(s.phase)];
    if (s.phase != SolvePhase::solve || s.solver() != SolverKind::hierarchical) return name;
    static constexpr const char* leaves[] = {"", "make", "cut", "light", "read", "values"};
    if (s.show_leaves != Solution::State::ShowLeaves::no)
        return name + ", leaves: " + leaves[static_cast<int>(s.show_leaves)];
    if (!s.hierarchy) return name + ", waits for the tree";
    return name + (s.hierarchy->settled() ? ", last gather" : std::string(", ") + s.hierarchy->doing());
}

struct Longest {
    int steps = 0;
    double all = 0, most = 0, most_by_clock = 0;
};

} // namespace

int main(int argc, char** argv) {
    std::string file, solver;
    double seconds = 1e9, error = 0;
    CLI::App program("How long is the longest step of a solution?");
    program.add_option("scene", file)->required();
    program.add_option("--solver", solver);
    program.add_option("--error", error, "percent");
    program.add_option("--seconds", seconds);
    if (const auto status = bench::parse(program, argc, argv)) return *status;
    auto loaded = bench::scene_of(file);
    if (!loaded) return bench::exit_mistake;
    Scene scene = std::move(*loaded);
    if (const auto kind = from_word(solver, all_solvers)) scene.solve.solver = *kind;
    if (error > 0) scene.solve.target_error = error / 100;
    Solution solution(std::make_shared<const Scene>(std::move(scene)));
    std::map<std::string, Longest> longest;
    const std::atomic<bool> never{false};
    for (bool more = true; more && solution.status().seconds < seconds;) {
        const std::string what = doing(solution.state());
        const auto start = std::chrono::steady_clock::now();
        const double before = processor_seconds();
        more = solution.step(never);
        const double used = processor_seconds() - before;
        Longest& l = longest[what];
        ++l.steps, l.all += used, l.most = std::max(l.most, used);
        const double clock = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        l.most_by_clock = std::max(l.most_by_clock, clock);
    }
    fmt::print("{:<32} {:>8} {:>10} {:>14} {:>14}\n", "at", "steps", "s in all", "longest, ms", "by the clock");
    for (const auto& [what, l] : longest)
        fmt::print("{:<32} {:>8} {:>10.3f} {:>14.1f} {:>14.1f}\n", what, l.steps, l.all, 1e3 * l.most,
                   1e3 * l.most_by_clock);
    const SolveStatus& status = solution.status();
    fmt::print("{}; {:.2f} s, {} links, {} rounds, {} sweeps; {}\n", to_string(status.stage), status.seconds,
               status.links, status.link_rounds, status.sweeps, status.message);
    return 0;
}
