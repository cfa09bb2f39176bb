// How does it grow? Halls of more and more triangles (tests/support/hall.h): seconds and memory of each stage, what
// `lueur plan` had said, and the exponent that fits them.
//
//     growth [TRIANGLES...] [--seconds N] [--folder FOLDER]
//
// Each hall is loaded and solved in a process of its own, so that its peak memory is its own. Processor seconds, of all
// threads: what else runs on the machine makes them no longer, as it does seconds on the wall. --seconds: of loading
// and solving each, on the wall, unless it settles before; the estimated error is what it is then.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/solve/memory_plan.h"
#include "core/solve/solution_state.h"
#include "tests/bench/program.h"
#include "tests/support/hall.h"

using namespace lueur;

namespace {

const std::atomic<bool> never{false};
using Clock = std::chrono::steady_clock;

double processor_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

enum Column {
    triangles,
    load,
    mesh,
    first_light,
    first_picture,
    first_wall,
    bounce,
    refined,
    solved,
    error,
    planned,
    peak,
    columns
};
using Figures = std::array<double, columns>;

// What a process has to say of one hall.
Figures measure(const std::filesystem::path& file, double seconds) {
    Figures f{};
    const auto start = Clock::now();
    const auto wall = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    auto loaded = load_scene(file, {});
    if (!loaded) return f;
    f[triangles] = double(loaded->scene.geometry->triangles.size());
    f[load] = processor_seconds();
    Solution solution(std::make_shared<const Scene>(std::move(loaded->scene)));
    while (solution.step(never)) {
        const SolvePhase phase = solution.state().phase;
        if (f[mesh] == 0) f[mesh] = processor_seconds();
        if (f[first_picture] == 0 && phase != SolvePhase::mesh && phase != SolvePhase::sketch) {
            f[first_light] = processor_seconds();
            (void)solution.field();
            f[first_picture] = processor_seconds();
            f[first_wall] = wall();
        }
        if (f[bounce] == 0 && solution.status().sweeps > 0) f[bounce] = processor_seconds();
        if (f[refined] == 0 && solution.state().refined) f[refined] = processor_seconds();
        if (f[solved] == 0 && solution.state().refined && phase == SolvePhase::transport &&
            solution.status().sweeps > 0)
            f[solved] = processor_seconds();
        if (wall() > seconds && solution.status().sweeps > 0) break;
    }
    if (f[solved] == 0) f[solved] = processor_seconds();
    solution.take_stock();
    f[error] = 100 * solution.status().estimated_error;
    f[planned] = double(plan_memory(*solution.scene(), solution.state().channels()).peak()) / 1048576;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    f[peak] = double(usage.ru_maxrss) / 1024;
    return f;
}

Figures in_a_process(const std::filesystem::path& file, double seconds) {
    int ends[2];
    Figures f{};
    if (pipe(ends) != 0) return f;
    const pid_t child = fork();
    if (child == 0) {
        f = measure(file, seconds);
        const bool told = write(ends[1], f.data(), sizeof f) == static_cast<ssize_t>(sizeof f);
        _exit(told ? 0 : 1);
    }
    close(ends[1]);
    if (read(ends[0], f.data(), sizeof f) != static_cast<ssize_t>(sizeof f)) f = {};
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return f;
}

// Of y ~ n^x, by least squares of the logarithms.
double exponent(const std::vector<Figures>& all, Column y) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0, n = 0;
    for (const Figures& f : all) {
        if (!(f[triangles] > 0 && f[y] > 0)) continue;
        const double a = std::log(f[triangles]), b = std::log(f[y]);
        sx += a, sy += b, sxx += a * a, sxy += a * b, n += 1;
    }
    return n > 1 ? (n * sxy - sx * sy) / (n * sxx - sx * sx) : 0;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App program{"How time and memory of each stage grow with the scene.", "growth"};
    std::vector<std::size_t> sizes;
    double seconds = 60;
    std::string kept;
    program.add_option("TRIANGLES", sizes)->check(CLI::PositiveNumber);
    program.add_option("--seconds", seconds, "of loading and solving each");
    program.add_option("--folder", kept, "keep the halls there");
    if (const auto status = bench::parse(program, argc, argv)) return *status;
    const bool keep = !kept.empty();
    const std::filesystem::path folder =
        keep ? std::filesystem::path(kept)
             : std::filesystem::temp_directory_path() / fmt::format("lueur-growth-{}", getpid());
    if (sizes.empty()) sizes = {10'000, 30'000, 100'000, 300'000, 1'000'000};
    fmt::print("Processor seconds until each is done; MiB.\n{:>9} {:>6} {:>6} {:>6} {:>8} {:>7} {:>7} {:>7} {:>7} "
               "{:>8} {:>8} {:>6}\n",
               "triangles", "loaded", "mesh", "sketch", "picture", "(wall)", "bounce", "refined", "solved", "error %",
               "planned", "peak");
    std::vector<Figures> all;
    for (const std::size_t n : sizes) {
        const std::string name = fmt::format("hall_{}", n);
        test::write_hall(folder, name, {.triangles = n});
        all.push_back(in_a_process(folder / (name + ".toml"), seconds));
        const Figures& f = all.back();
        fmt::print("{:>9.0f} {:>6.2f} {:>6.2f} {:>6.2f} {:>8.2f} {:>7.2f} {:>7.2f} {:>7.2f} {:>7.2f} {:>8.2f} {:>8.0f} "
                   "{:>6.0f}\n",
                   f[triangles], f[load], f[mesh], f[first_light], f[first_picture], f[first_wall], f[bounce],
                   f[refined], f[solved], f[error], f[planned], f[peak]);
        std::fflush(stdout);
    }
    fmt::print(
        "n^x       {:>6.2f} {:>6.2f} {:>6.2f} {:>8.2f} {:>7.2f} {:>7.2f} {:>7.2f} {:>7.2f} {:>8} {:>8.2f} {:>6.2f}\n",
        exponent(all, load), exponent(all, mesh), exponent(all, first_light), exponent(all, first_picture),
        exponent(all, first_wall), exponent(all, bounce), exponent(all, refined), exponent(all, solved), "",
        exponent(all, planned), exponent(all, peak));
    std::error_code ignored;
    if (!keep) std::filesystem::remove_all(folder, ignored);
    return 0;
}
