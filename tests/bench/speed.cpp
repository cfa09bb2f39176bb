// How fast is it? For each scene: from nothing to the first picture and to 5, 2 and 1 % error, edits, rays against
// Embree's own rate, sweeps against the machine's bandwidth and arithmetic, peak memory.
//
//     speed SCENE... [--points N] [--seconds N] [--markdown FILE] [--csv FILE]
//
// Ratios are of figures measured in the same run, one after the other. --seconds: for the runs and the reference of
// a scene's chart. Each scene is run in a process of its own, so that its peak memory is its own.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <functional>
#include <numeric>
#include <optional>

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include "core/solve/gather_system.h"
#include "core/solve/solution_state.h"
#include "core/transport/direct_light.h"
#include "core/transport/sampling.h"
#include "editor/chart/edit_times.h"
#include "editor/chart/run_chart.h"
#include "tests/bench/program.h"

using namespace lueur;

namespace {

const std::atomic<bool> never{false};
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Shortest of several runs: what else the machine does only ever lengthens one.
double shortest(int runs, const std::function<void()>& run) {
    double best = 1e300;
    for (int k = 0; k < runs; ++k) {
        const auto start = Clock::now();
        run();
        best = std::min(best, seconds_since(start));
    }
    return best;
}

template <typename F>
void in_parallel(std::size_t count, std::size_t grain, const F& f) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) { f(range.begin(), range.end()); });
}

// Bytes read and written a second by copying what no cache holds.
double copy_bandwidth() {
    std::vector<std::uint64_t> from(32u << 20, 1), to(32u << 20);
    const double seconds = shortest(5, [&] {
        in_parallel(from.size(), from.size() / 64, [&](std::size_t first, std::size_t last) {
            std::memcpy(to.data() + first, from.data() + first, (last - first) * sizeof(from[0]));
        });
    });
    return 2.0 * static_cast<double>(from.size() * sizeof(from[0])) / seconds;
}

// The scene's own triangles in an Embree scene without anything around it.
class PlainEmbree {
public:
    explicit PlainEmbree(const Geometry& geometry)
        : device_(rtcNewDevice(nullptr))
        , scene_(rtcNewScene(device_)) {
        RTCGeometry triangles = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), geometry.vertices.size()));
        for (std::size_t v = 0; v < geometry.vertices.size(); ++v) vertices[v] = geometry.vertices[v].position;
        auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
            triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), geometry.triangles.size()));
        for (std::size_t t = 0; t < geometry.triangles.size(); ++t) indices[t] = geometry.triangles[t];
        rtcCommitGeometry(triangles);
        rtcAttachGeometry(scene_, triangles);
        rtcReleaseGeometry(triangles);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        rtcCommitScene(scene_);
    }
    ~PlainEmbree() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    PlainEmbree(const PlainEmbree&) = delete;
    PlainEmbree& operator=(const PlainEmbree&) = delete;

    // Seconds for all of them, one call a ray.
    double closest(const std::vector<Ray>& rays) const {
        return seconds_of(rays, [this](RTCIntersectContext& context, const RTCRay& ray) {
            RTCRayHit query{};
            query.ray = ray;
            query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene_, &context, &query);
        });
    }
    double occluded(const std::vector<Ray>& rays) const {
        return seconds_of(rays,
                          [this](RTCIntersectContext& context, RTCRay ray) { rtcOccluded1(scene_, &context, &ray); });
    }

private:
    template <typename F>
    static double seconds_of(const std::vector<Ray>& rays, const F& trace) {
        return shortest(3, [&] {
            in_parallel(rays.size(), 4096, [&](std::size_t first, std::size_t last) {
                RTCIntersectContext context;
                rtcInitIntersectContext(&context);
                for (std::size_t r = first; r < last; ++r) trace(context, plain(rays[r]));
            });
        });
    }
    static RTCRay plain(const Ray& ray) {
        RTCRay query{};
        query.org_x = ray.origin.x, query.org_y = ray.origin.y, query.org_z = ray.origin.z;
        query.dir_x = ray.direction.x, query.dir_y = ray.direction.y, query.dir_z = ray.direction.z;
        query.tnear = ray.t_min, query.tfar = ray.t_max, query.mask = ~0u;
        return query;
    }
    RTCDevice device_;
    RTCScene scene_;
};

struct Rates { // a second, all threads
    double stage = 0, embree = 0;
    double share() const { return embree > 0 ? stage / embree : 0; }
};

// A pass of gather rays as the solver traces it, and the same rays through Embree alone.
Rates gather_rates(const Solution& solution, const PlainEmbree& embree) {
    const Solution::State& s = solution.state();
    constexpr std::uint32_t pass = 0;
    GatherPass out = make_gather_pass(s.mesh, s.receivers);
    const std::uint32_t count = static_cast<std::uint32_t>(s.receivers.vertex.size());
    const double stage = shortest(3, [&] {
        in_parallel(count, 64, [&](std::size_t first, std::size_t last) {
            trace_gather_rays(*s.world, s.mesh, s.origins, s.receivers, s.buried, s.scene->solve.seed, pass,
                              static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last), out);
        });
    });
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (s.receivers.buried[i]) continue;
        const std::uint32_t vertex = s.receivers.vertex[i];
        const Frame frame(s.mesh.vertices[vertex].normal);
        const glm::vec2 offset = random_offset(hash(s.scene->solve.seed, pass), i);
        for (std::uint32_t k = 0; k < rays_per_pass; ++k)
            rays.push_back({s.origins[vertex], frame.world(cosine_direction(r2_point(k, offset)))});
    }
    const double number = static_cast<double>(rays.size());
    return {number / stage, number / embree.closest(rays)};
}

// Direct light while the mesh is refined, and shadow rays between the same vertices and points on the luminaires.
Rates shadow_rates(double stage_rate, const Solution& solution, const PlainEmbree& embree) {
    const Solution::State& s = solution.state();
    const std::vector<glm::vec3> origins = ray_origins(s.mesh, s.world->epsilon());
    const auto& emitters = s.direct->emitters();
    std::vector<Ray> rays;
    std::uint32_t number = 0;
    const std::size_t each = std::max<std::size_t>(1, (1u << 20) / std::max<std::size_t>(1, origins.size()));
    for (std::size_t v = 0; v < origins.size() && !emitters.empty(); ++v)
        for (std::size_t k = 0; k < each; ++k, ++number) {
            const EmitterPoint point = emitter_point(emitters[number % emitters.size()], r2_point(number, {0, 0}));
            const glm::vec3 to = point.position - origins[v];
            if (glm::dot(to, s.mesh.vertices[v].normal) <= 0 || glm::dot(to, point.normal) >= 0) continue;
            rays.push_back({origins[v], to, 0, shadow_ray_end});
        }
    return {stage_rate, rays.empty() ? 0 : static_cast<double>(rays.size()) / embree.occluded(rays)};
}

struct SweepRates { // a second, all threads
    double rays = 0, bytes = 0, additions = 0;
    double peak_additions = 0; // of rows that the first cache holds
};

// Additions a second where every row read lies in the first cache: what arithmetic and loads allow.
double peak_additions(int channels) {
    constexpr std::uint32_t rows = 64, receivers = 4096;
    ChannelField field(rows + 1, channels), out(receivers, channels);
    GatherPass pass;
    pass.ends.resize(std::size_t(receivers) * rays_per_pass);
    for (std::size_t k = 0; k < pass.ends.size(); ++k) pass.ends[k] = static_cast<std::uint32_t>(k % rows);
    const std::vector<GatherPass> passes(4, pass);
    const double seconds = shortest(9, [&] { apply_rows(passes, RayEnds::coarse, field, out, never); });
    return static_cast<double>(passes.size() * pass.ends.size()) * field.stride / seconds;
}

SweepRates sweep_rates(const Solution& solution) {
    const Solution::State& s = solution.state();
    const std::uint32_t count = s.system.count();
    if (s.passes.empty() || count == 0) return {};
    ChannelField field(count + 1, s.channels()), out(count, s.channels());
    std::iota(field.values.begin(), field.values.end(), 0.0f);
    const double seconds = shortest(9, [&] { apply_rows(s.passes, RayEnds::coarse, field, out, never); });
    const double rays = static_cast<double>(s.passes.size()) * rays_per_pass * count;
    const double bytes =
        rays * sizeof(std::uint32_t) + static_cast<double>((field.values.size() + out.values.size()) * sizeof(float));
    return {rays / seconds, bytes / seconds, rays * field.stride / seconds, peak_additions(s.channels())};
}

struct Times {
    double first_picture = 0, first_bounce = 0; // s of solving and of composing that picture
    double settled = 0;
    double shadow_rate = 0;
    std::uint64_t rays = 0;
};

Times solve_cold(Solution& solution) {
    Times times;
    std::uint64_t direct_rays = 0;
    double direct_seconds = 0;
    while (true) {
        const SolvePhase before = solution.state().phase;
        const std::uint64_t rays = solution.status().rays;
        const double seconds = solution.status().seconds;
        if (!solution.step(never)) break;
        if (before == SolvePhase::light || before == SolvePhase::sketch) {
            direct_rays += solution.status().rays - rays;
            direct_seconds += solution.status().seconds - seconds;
        }
        const bool lit = solution.state().direct && solution.state().phase != SolvePhase::sketch &&
                         solution.state().phase != SolvePhase::mesh;
        for (auto [time, there] :
             {std::pair{&times.first_picture, lit}, {&times.first_bounce, solution.status().sweeps > 0}})
            if (*time == 0 && there) {
                const auto start = Clock::now();
                const auto field = solution.field();
                *time = solution.status().seconds + seconds_since(start);
            }
    }
    times.settled = solution.status().seconds;
    times.rays = solution.status().rays;
    times.shadow_rate = direct_seconds > 0 ? static_cast<double>(direct_rays) / direct_seconds : 0;
    return times;
}

struct Options {
    int points = 1000;
    double seconds = 120;
    std::FILE* markdown = stdout;
    std::FILE* csv = nullptr;
};

// The time from which on some run of the method is below an error.
std::string time_to(const MethodChart& chart, double target, double ErrorStatistics::*figure) {
    double best = 1e300, least = 1e300;
    for (const ChartRun& run : chart.runs)
        for (const ChartPoint& point : run.points) {
            least = std::min(least, point.error.*figure);
            if (point.error.*figure <= target) best = std::min(best, point.seconds);
        }
    return best < 1e300 ? fmt::format("{:.3g} s", best) : fmt::format("not reached ({:.1f} %)", 100 * least);
}

int measure(const std::string& file, const Options& options) {
    auto loaded = bench::scene_of(file);
    if (!loaded) return bench::exit_mistake;
    Scene scene = std::move(*loaded);
    scene.solve.solver = SolverKind::gathering;
    if (scene.name.empty()) scene.name = std::filesystem::path(file).stem().string();

    const auto line = [&](const std::string& what, const std::string& figure) {
        fmt::print(options.markdown, "| {} | {} |\n", what, figure);
        if (options.csv) fmt::print(options.csv, "\"{}\",\"{}\",\"{}\"\n", scene.name, what, figure);
        std::fflush(options.markdown);
    };
    fmt::print(options.markdown, "\n| {} | {} triangles |\n| --- | --- |\n", scene.name,
               scene.geometry->triangles.size());
    Solution solution(std::make_shared<const Scene>(scene));
    const Times times = solve_cold(solution);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    line("first picture (direct light)", fmt::format("{:.3g} s", times.first_picture));
    line("first picture with interreflection", fmt::format("{:.3g} s", times.first_bounce));
    line(fmt::format("settled at the scene's own target ({:g} %)", 100 * scene.solve.target_error),
         fmt::format("{:.3g} s, {:.3g} million rays, estimated error {:.1f} %", times.settled,
                     1e-6 * static_cast<double>(times.rays), 100 * solution.status().estimated_error));
    line("peak memory", fmt::format("{:.0f} MiB", static_cast<double>(usage.ru_maxrss) / 1024));

    const PlainEmbree embree(*scene.geometry);
    const auto rates = [&](const std::string& what, const Rates& r) {
        line(what, fmt::format("{:.2f} million a second, {:.0f} % of Embree's {:.2f}", 1e-6 * r.stage, 100 * r.share(),
                               1e-6 * r.embree));
    };
    rates("gather rays", gather_rates(solution, embree));
    rates("shadow rays, the whole of direct light", shadow_rates(times.shadow_rate, solution, embree));
    const double bandwidth = copy_bandwidth();
    const SweepRates sweep = sweep_rates(solution);
    line("sweep",
         fmt::format("{:.0f} million ray ends a second; {:.0f} % of the copy bandwidth ({:.1f} GB/s), {:.0f} % of "
                     "the additions that rows in the first cache allow ({:.1f} thousand million a second)",
                     1e-6 * sweep.rays, 100 * sweep.bytes / bandwidth, 1e-9 * bandwidth,
                     100 * sweep.additions / std::max(1.0, sweep.peak_additions), 1e-9 * sweep.peak_additions));
    if (const auto edits = edit_times(scene, 60, never))
        line("settled after an edit (median of 5)",
             fmt::format("reflectance {:.1f} ms, dimmer {:.1f} ms, spectrum {:.1f} ms", 1e3 * edits->reflectance,
                         1e3 * edits->dimmer, 1e3 * edits->spectrum));

    ChartParams params;
    params.points = options.points;
    params.methods = {ChartMethod{}};
    params.time_limit = options.seconds;
    params.run_limit = options.seconds / 3;
    const MethodChart chart = run_chart(scene, params, never);
    for (const double target : {0.05, 0.02, 0.01})
        line(fmt::format("to {:.0f} % error: RMS (of the truth alone, as found); 95th percentile", 100 * target),
             time_to(chart, target, &ErrorStatistics::rms_without_noise) + " (" +
                 time_to(chart, target, &ErrorStatistics::rms_of_truth) + "); " +
                 time_to(chart, target, &ErrorStatistics::percentile95));
    line("reference", fmt::format("{} paths at {} points, {:.2g} % standard error", chart.reference_paths, chart.points,
                                  100 * chart.reference_error));
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    Options options;
    std::vector<std::string> scenes;
    std::string markdown, csv;
    CLI::App program("How fast is it?");
    program.add_option("scenes", scenes)->required();
    program.add_option("--points", options.points)->check(CLI::PositiveNumber);
    program.add_option("--seconds", options.seconds, "for the runs and the reference of a scene's chart");
    program.add_option("--markdown", markdown);
    program.add_option("--csv", csv);
    if (const auto status = bench::parse(program, argc, argv)) return *status;
    if (!markdown.empty()) options.markdown = std::fopen(markdown.c_str(), "a");
    if (!csv.empty()) options.csv = std::fopen(csv.c_str(), "a");
    if (!options.markdown || (!csv.empty() && !options.csv)) {
        fmt::print(stderr, "the files of --markdown and --csv cannot be written\n");
        return bench::exit_mistake;
    }
    int worst = 0;
    for (const std::string& file : scenes) {
        std::fflush(nullptr);
        const pid_t child = fork(); // before any thread is started
        if (child == 0) {
            const int result = measure(file, options);
            std::fflush(nullptr);
            _exit(result);
        }
        int status = 0;
        if (child < 0 || waitpid(child, &status, 0) < 0) return 1;
        worst = std::max(worst, WIFEXITED(status) ? WEXITSTATUS(status) : 1);
    }
    return worst;
}
