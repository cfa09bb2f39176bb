// What the estimate of an error is worth: against traced paths at vertices and points of a solution's mesh.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <tbb/parallel_for.h>

#include "core/solve/path_tracer.h"
#include "core/solve/relative_error.h"
#include "core/solve/solution_state.h"
#include "core/transport/sampling.h"
#include "core/view/surface_points.h"
#include "tests/support/scenes.h"

namespace lueur::test {

struct TruePoint {
    std::uint32_t vertex = no_index; // or a point between vertices:
    glm::vec3 position{0}, normal{0};
    double illuminance = 0, standard_error = 0; // lx, of paths
};

// `count` vertices of the first `vertices` of a mesh, chosen by area, and as many paths at each; buried ones never.
inline std::vector<TruePoint> true_vertices(const Solution& solution, bool coarse, int count, int paths,
                                            std::uint32_t seed) {
    const Solution::State& s = solution.state();
    const std::vector<std::uint8_t> buried = s.all_buried();
    std::vector<float> area = coarse ? s.coarse_area : vertex_areas(s.mesh);
    for (std::size_t v = 0; v < area.size(); ++v)
        if (buried[v]) area[v] = 0;
    std::mt19937 random(seed);
    std::discrete_distribution<std::uint32_t> choose(area.begin(), area.end());
    const std::vector<glm::vec3> origins = ray_origins(s.mesh, s.world->epsilon());
    const PathLights lights = make_path_lights(s);
    std::vector<TruePoint> points(static_cast<std::size_t>(count));
    for (TruePoint& p : points) p.vertex = choose(random);
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        const glm::vec3 normal = s.mesh.vertices[points[i].vertex].normal;
        const PathEstimate e = trace_irradiance(s, lights, origins[points[i].vertex], normal, paths,
                                                hash(seed, static_cast<std::uint32_t>(i)), never);
        points[i].illuminance = e.illuminance, points[i].standard_error = e.standard_error;
    });
    return points;
}

inline std::vector<TruePoint> true_surface_points(const Solution& solution, int count, int paths, std::uint32_t seed) {
    const Solution::State& s = solution.state();
    const std::vector<MeasurePoint> chosen = surface_points(solution, count, seed);
    const PathLights lights = make_path_lights(s);
    std::vector<TruePoint> points(chosen.size());
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        points[i].position = chosen[i].position, points[i].normal = chosen[i].normal;
        const PathEstimate e =
            trace_irradiance(s, lights, points[i].position + s.world->epsilon() * points[i].normal, points[i].normal,
                             paths, hash(seed, static_cast<std::uint32_t>(i)), never);
        points[i].illuminance = e.illuminance, points[i].standard_error = e.standard_error;
    });
    return points;
}

// A point whose truth is known, and what a field says there, lx.
struct JudgedPoint {
    glm::vec3 position;
    double truth, noise; // of paths, and their standard error
    double value, sigma; // of the field, and the standard deviation it states
};

struct ErrorVerdict {
    double truth = 0;           // relative RMS error, the variance of the paths subtracted
    double least = 0, most = 0; // what it may be as far as the paths know
    double estimate = 0;        // relative RMS of what the field says
    double covered = 0;         // share of true values within the stated 95 % interval
    double reference = 0;       // relative RMS standard error of the paths
    int counted = 0;
    std::vector<JudgedPoint> points; // those that count
    double ratio() const { return estimate > 0 ? truth / estimate : (truth > 0 ? 1e9 : 1); }
    bool right() const { return most >= 0.5 * estimate && least <= 2 * estimate; }
};

// Errors are relative as everywhere (relative_error.h), and so are the standard deviations stated. Points whose truth
// is darker than 2 % of the mean do not count: the insides of closed furniture.
inline ErrorVerdict judge(const std::vector<JudgedPoint>& points, double mean, double interval_factor) {
    ErrorVerdict verdict;
    int covered = 0;
    double truth = 0, estimate = 0, reference = 0, spread = 0;
    for (const JudgedPoint& p : points) {
        if (!(p.truth > dark_share * mean)) continue;
        const double larger = std::max(p.truth, p.value), square = larger * larger;
        const double error = p.value - p.truth, noise = p.noise * p.noise / square;
        truth += error * error / square - noise;
        estimate += p.sigma * p.sigma / square;
        reference += noise;
        // Of an error's square by the paths' noise, and of the variance that 16 batches tell of it.
        spread += 4 * error * error / square * noise + (2 + 2.0 / 15) * noise * noise;
        covered += std::abs(error) <= std::hypot(interval_factor * p.sigma, 2.13 * p.noise);
        verdict.points.push_back(p);
    }
    verdict.counted = static_cast<int>(verdict.points.size());
    const double n = std::max(1, verdict.counted);
    verdict.truth = std::sqrt(std::max(0.0, truth / n));
    verdict.least = std::sqrt(std::max(0.0, (truth - 2 * std::sqrt(spread)) / n));
    verdict.most = std::sqrt(std::max(0.0, (truth + 2 * std::sqrt(spread)) / n));
    verdict.estimate = std::sqrt(estimate / n);
    verdict.reference = std::sqrt(reference / n);
    verdict.covered = covered / n;
    return verdict;
}

inline double mean_illuminance(const std::vector<TruePoint>& points) {
    double mean = 0;
    for (const TruePoint& p : points) mean += p.illuminance / double(points.size());
    return mean;
}

// Vertices that the field does not have yet are left out.
inline ErrorVerdict judge_vertices(const Solution& solution, const Field& field, const std::vector<TruePoint>& points) {
    std::vector<JudgedPoint> judged;
    for (const TruePoint& p : points)
        if (p.vertex < field.irradiance_xyz.size())
            judged.push_back({solution.state().mesh.vertices[p.vertex].position, p.illuminance, p.standard_error,
                              field.irradiance_xyz[p.vertex].y, field.error[p.vertex]});
    return judge(judged, mean_illuminance(points), field.interval_factor);
}

// The scene's one number against points anywhere on its surfaces, interpolation included.
inline ErrorVerdict judge_scene(const Solution& solution, const Field& field, const std::vector<TruePoint>& points) {
    const Solution::State& s = solution.state();
    const float reach = 500 * s.world->epsilon();
    std::vector<JudgedPoint> judged;
    for (const TruePoint& p : points) {
        const Hit hit = s.world->closest({p.position + reach * p.normal, -p.normal, 0, 2 * reach});
        if (hit.element == no_index) continue;
        const Located at = locate(s.mesh, hit.element, hit.b1, hit.b2);
        double value = 0, variance = 0;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t v = at.vertices[k];
            value += double(at.weights[k]) * field.irradiance_xyz[v].y;
            variance += double(at.weights[k]) * (double(field.error[v]) * field.error[v] +
                                                 double(field.interpolation_error[v]) * field.interpolation_error[v]);
        }
        judged.push_back({p.position, p.illuminance, p.standard_error, value, std::sqrt(variance)});
    }
    ErrorVerdict verdict = judge(judged, mean_illuminance(points), field.interval_factor);
    verdict.estimate = field.scene_error;
    return verdict;
}

} // namespace lueur::test
