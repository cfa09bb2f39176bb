#include "core/solve/error_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

#include "core/solve/relative_error.h"
#include "core/solve/solution_steps.h"

namespace lueur {

namespace {

using State = Solution::State;

// Each vertex and its neighbours, twice over: a variance known by one difference each becomes one known by many.
// Relative to `value`, so that a bright vertex tells a dark neighbour nothing of its own noise.
void pool(std::span<const glm::uvec3> elements, const std::vector<std::uint8_t>& left_out, std::span<const float> value,
          double least, std::span<float> variance) {
    const auto square = [&](std::size_t v) {
        const float bright = std::max(value[v], static_cast<float>(least));
        return bright * bright;
    };
    if (!(least > 0)) return;
    for (std::size_t v = 0; v < variance.size(); ++v) variance[v] /= square(v);
    std::vector<float> sum(variance.size()), count(variance.size());
    for (int ring = 0; ring < 2; ++ring) {
        std::fill(sum.begin(), sum.end(), 0.0f);
        std::fill(count.begin(), count.end(), 0.0f);
        for (const glm::uvec3& e : elements) {
            float all = 0, counted = 0;
            for (int k = 0; k < 3; ++k)
                if (!left_out[e[k]]) all += variance[e[k]], counted += 1;
            for (int k = 0; k < 3; ++k) sum[e[k]] += all, count[e[k]] += counted;
        }
        for (std::size_t v = 0; v < variance.size(); ++v)
            if (count[v] > 0) variance[v] = sum[v] / count[v];
    }
    for (std::size_t v = 0; v < variance.size(); ++v) variance[v] *= square(v);
}

// How near what a vertex looks at is, for straight lines between vertices as far apart as here: 0 far away, 1 in a gap
// between books, where rays end within an element of where they start.
float closeness(const State& s, std::uint32_t v) {
    return std::min(1.0f, 0.5f * std::sqrt(s.indirect_area[v]) / std::max(1e-20f, s.indirect_distance[v]));
}

// RMS error of indirect light of one pass of rays, some of it solved for a guess of direct light (office: 11 %).
constexpr float share_of_guess = 0.1f;

// Indirect light is solved at the vertices of one level; others interpolate it. Halfway between two vertices their
// errors are half averaged away, and a bent field is missed.
void model_indirect(const State& s, const ErrorMesh& mesh, const ErrorLight& light, ErrorModel& model) {
    const std::uint32_t coarse = mesh.level, count = static_cast<std::uint32_t>(light.total.size());
    model.rays.assign(count, 0);
    model.bent.assign(count, 0);
    if (!s.solving) return;
    const std::span<const float> value(light.indirect.data(), coarse);
    std::vector<float> near = mesh.coarse.neighbour_differences(value);
    const std::vector<float> bend = mesh.coarse.at_vertices(value);
    const double least = dark_share * light.mean;
    for (std::uint32_t v = 0; v < coarse; ++v) { // in a crack the light outside is no measure of the error
        const float bright = 2 * std::max(value[v], static_cast<float>(least));
        near[v] = std::min(near[v], bright * bright);
    }
    // After the mesh has changed what was known of the level before is of no use.
    model.known = s.indirect_deviation.size() >= coarse;
    if (model.known) {
        for (std::uint32_t v = 0; v < coarse; ++v) model.rays[v] = s.indirect_deviation[v] * s.indirect_deviation[v];
        pool(mesh.coarse_elements, s.buried, value, least, std::span(model.rays.data(), coarse));
    }
    const bool shared = s.solver() == SolverKind::gathering && s.direct->samples().count() == 0; // else see below
    for (std::uint32_t v = 0; v < coarse; ++v) {
        model.bent[v] = 0.25f * near[v];
        // There no ray tells what lies between the vertices: of `bent` a thirtieth is error elsewhere, there a quarter
        // (paths at 59 such vertices of the office, 17 of the Cornell box).
        if (model.known) model.bent[v] *= 1 + 7 * closeness(s, v);
        if (!model.known && s.solver() == SolverKind::gathering) {
            const float guessed = share_of_guess * value[v];
            model.rays[v] = guessed * guessed;
        }
        // Read from a receiver that lies elsewhere.
        if (shared && s.receivers.vertex[s.receivers.of_vertex[v]] != v) model.rays[v] += 0.25f * near[v];
    }
    std::vector<float> missed(count, 0);
    for (std::uint32_t v = 0; v < coarse; ++v) missed[v] = bend[v] * bend[v];
    for (std::uint32_t v = coarse; v < count; ++v) { // parents come first
        const auto& p = s.mesh.vertices[v].parents;
        model.rays[v] = 0.4f * (model.rays[p[0]] + model.rays[p[1]]);
        model.bent[v] = 0.5f * (model.bent[p[0]] + model.bent[p[1]]);
        missed[v] = 0.5f * (missed[p[0]] + missed[p[1]]);
    }
    std::vector<float>& missing = model.known ? model.rays : model.bent;
    for (std::uint32_t v = coarse; v < count; ++v) missing[v] += 0.0625f * missed[v];
}

// Variance of what a vertex reads: as if it had any one of the samples, as likely as it counts; and what a sample does
// not know of places so far away, compared with what is around it (Ward, Rubinstein & Clear 1988, eq. 5).
float spread_of_readings(const State& s, std::uint32_t v, std::span<const float> light) {
    const LightSamples& samples = s.direct->samples();
    double mean = 0, square = 0, away = 0;
    for (const LightSamples::Reading& r : samples.readings_of(v)) {
        const std::uint32_t at = samples.vertex[r.sample];
        mean += r.weight * light[at], square += r.weight * light[at] * light[at];
        away += r.weight * glm::distance(s.mesh.vertices[v].position, s.mesh.vertices[at].position) /
                std::max(1e-20f, s.around.distance[at]);
    }
    const double unknown = std::min(1.0, away) * mean;
    return static_cast<float>(std::max(0.0, square - mean * mean) + unknown * unknown);
}

void model_readings(const State& s, const ErrorLight& light, ErrorModel& model) {
    const LightSamples& samples = s.direct->samples();
    const auto count = static_cast<std::uint32_t>(light.total.size());
    model.read_direct.assign(count, 0);
    model.read_indirect.assign(count, 0);
    if (samples.count() == 0) return;
    for (std::uint32_t v = 0; v < s.mesh.coarse_vertex_count; ++v) {
        if (samples.is_sample(v)) continue;
        model.read_direct[v] = spread_of_readings(s, v, light.direct);
        model.read_indirect[v] = spread_of_readings(s, v, light.indirect);
    }
    for (std::uint32_t v = s.mesh.coarse_vertex_count; v < count; ++v) { // direct light there is its own
        const auto& p = s.mesh.vertices[v].parents;
        model.read_indirect[v] = 0.5f * (model.read_indirect[p[0]] + model.read_indirect[p[1]]);
    }
}

} // namespace

std::uint32_t solved_vertices(const State& s) {
    const std::uint32_t count = s.solving ? s.indirect().count : 0;
    return count > 0 && count < s.mesh.vertices.size() ? count : s.mesh.coarse_vertex_count;
}

bool shows_direct_apart(const State& s) {
    if (s.is_traced()) return false;
    for (std::size_t l = 0; l < s.luminaire_exitance.size(); ++l)
        if (s.luminaire_is_lit(l)) return true;
    return s.luminaire_exitance.empty();
}

ErrorModel error_model(const State& s, const ErrorMesh& mesh, const ErrorLight& light) {
    constexpr double hidden_share = 0.1;
    ErrorModel model{light.direct_variance,
                     std::vector<float>(light.total.size(), 0),
                     {},
                     {},
                     mesh.fine.at_vertices(light.total),
                     {},
                     {},
                     false};
    const double usual = usual_light(light, mesh, static_cast<std::uint32_t>(light.total.size()));
    if (shows_direct_apart(s)) // where it is dark there may be as much as elsewhere, but for what luminaires fill
        tbb::parallel_for(std::size_t(0), model.hidden.size(), [&](std::size_t v) {
            double filled = 0; // form factors
            s.direct->each_share(static_cast<std::uint32_t>(v),
                                 [&](const DirectShare& share, float part) { filled += double(part) * share.factor; });
            const double unfilled = std::max(0.0, 1 - filled);
            const double bright = unfilled * hidden_share * 0.5 * (double(light.total[v]) + usual);
            model.hidden[v] = static_cast<float>(bright * bright);
        });
    else
        std::ranges::fill(model.direct, 0.0f);
    model_indirect(s, mesh, light, model);
    model_readings(s, light, model);
    for (float& b : model.between) b = 0.0625f * b * b; // a quarter of the bend
    return model;
}

} // namespace lueur
