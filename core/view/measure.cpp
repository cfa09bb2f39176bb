#include "core/view/measure.h"

#include <array>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "core/solve/path_tracer.h"
#include "core/solve/solution_state.h"
#include "core/transport/direct_light.h"
#include "core/transport/sampling.h"

namespace lueur {

namespace {

constexpr int batches = 8;         // independent ray sets, whose spread is the standard error
constexpr int direct_samples = 64; // shadow rays a luminaire and batch

Irradiance from_channels(const Wavelengths& wavelengths, std::vector<double> channels) {
    Irradiance result;
    result.illuminance_lx = xyz_from_channels(wavelengths, channels).y;
    result.irradiance_w_m2 = watts_from_channels(wavelengths, channels);
    result.channels = std::move(channels);
    return result;
}

void set_standard_error(Irradiance& result, double standard_error) {
    result.standard_error_percent = result.illuminance_lx > 0 ? 100 * standard_error / result.illuminance_lx : 0;
}

Irradiance gather(const Solution::State& s, glm::vec3 origin, glm::vec3 normal, int rays, std::uint32_t seed) {
    const int channels = s.wavelengths->size();
    const auto& emitters = s.direct->emitters();
    std::vector<double> total(channels, 0);
    std::array<double, batches> luminous{};
    const Frame frame(normal);
    const int per_batch = std::max(1, rays / batches);
    for (int b = 0; b < batches; ++b) {
        std::vector<double> h(channels, 0);
        for (std::size_t l = 0; l < emitters.size(); ++l) {
            const double d =
                direct_form_factor_sampled(*s.world, emitters[l], origin, normal, direct_samples,
                                           random_offset(seed + 17 * std::uint32_t(l) + 1, std::uint32_t(b)));
            for (int c = 0; c < channels; ++c) h[c] += d * s.luminaire_exitance[l][c];
        }
        const glm::vec2 offset = random_offset(seed, std::uint32_t(b));
        for (int k = 0; k < per_batch; ++k) {
            const Hit hit = s.world->closest(
                {origin, frame.world(cosine_direction(r2_point(static_cast<std::uint32_t>(k), offset)))});
            if (hit.element != no_index) add_reflected_radiosity(s, hit.element, hit.b1, hit.b2, 1.0 / per_batch, h);
        }
        for (int c = 0; c < channels; ++c) {
            total[c] += h[c] / batches;
            luminous[b] += s.wavelengths->xyz_weight[c].y * h[c];
        }
    }
    Irradiance result = from_channels(*s.wavelengths, std::move(total));
    set_standard_error(result, standard_error_of_batches(luminous));
    return result;
}

// The lit side nearest to the point, within a thousandth of the scene's size below or above it. Looked for ever further
// off, and through backs: a point in a gap lies closer to the bottom of the book above than that.
Hit surface_at(const World& world, glm::vec3 position, glm::vec3 normal) {
    for (const float away : {2.0f, 20.0f, 500.0f}) {
        const float reach = away * world.epsilon();
        const glm::vec3 origin = position + reach * normal;
        for (float from = 0; from < 2 * reach;) {
            const Hit hit = world.closest({origin, -normal, from, 2 * reach});
            if (!hit.any()) break;
            if (hit.element != no_index) return hit;
            from = std::max(hit.t, from) + 0.1f * world.epsilon();
        }
    }
    return {};
}

// Without a field: no standard error.
Irradiance read_field(const Solution::State& s, const Field* field, glm::vec3 position, glm::vec3 normal) {
    const Hit hit = surface_at(*s.world, position, normal);
    Irradiance result;
    if (hit.element == no_index) {
        result.channels.assign(s.wavelengths->size(), std::numeric_limits<double>::quiet_NaN());
        result.illuminance_lx = result.irradiance_w_m2 = result.standard_error_percent =
            std::numeric_limits<double>::quiet_NaN();
        return result;
    }
    result = from_channels(*s.wavelengths, irradiance_at(s, hit.element, hit.b1, hit.b2));
    if (!field) return result;
    const Located at_point = locate(s.mesh, hit.element, hit.b1, hit.b2);
    double variance = 0;
    for (int k = 0; k < 3; ++k) {
        const double at_vertex = field->error[at_point.vertices[k]],
                     between = field->interpolation_error[at_point.vertices[k]];
        variance += double(at_point.weights[k]) * (at_vertex * at_vertex + between * between);
    }
    set_standard_error(result, std::sqrt(variance));
    return result;
}

Irradiance reference(const Solution::State& s, const PathLights& lights, glm::vec3 origin, glm::vec3 normal, int paths,
                     std::uint32_t seed, const std::atomic<bool>& cancel) {
    PathEstimate traced = trace_irradiance(s, lights, origin, normal, paths, seed, cancel);
    Irradiance result = from_channels(*s.wavelengths, std::move(traced.channels));
    set_standard_error(result, traced.standard_error);
    return result;
}

} // namespace

std::vector<Irradiance> measure_points(const Solution& solution, std::span<const MeasurePoint> points,
                                       const MeasureParams& params, const std::atomic<bool>& cancel,
                                       const std::function<void(double)>& progress) {
    const Solution::State& s = solution.state();
    std::vector<Irradiance> results(points.size());
    if (!s.world) return results;
    const PathLights lights = params.at == MeasureAt::reference ? make_path_lights(s) : PathLights{};
    const auto field = params.at == MeasureAt::field && params.standard_errors ? solution.field() : nullptr;
    const std::size_t block = params.at == MeasureAt::reference ? 16 : 128;
    for (std::size_t first = 0; first < points.size(); first += block) {
        if (cancel.load(std::memory_order_relaxed)) return {};
        tbb::parallel_for(first, std::min(points.size(), first + block), [&](std::size_t i) {
            const glm::vec3 normal(glm::normalize(points[i].normal)), position(points[i].position);
            const glm::vec3 origin = position + s.world->epsilon() * normal;
            const std::uint32_t seed = hash(params.seed, static_cast<std::uint32_t>(i));
            switch (params.at) {
            case MeasureAt::gather:
                results[i] = gather(s, origin, normal, params.rays, seed);
                break;
            case MeasureAt::field:
                results[i] = read_field(s, field.get(), position, normal);
                break;
            case MeasureAt::reference:
                results[i] = reference(s, lights, origin, normal, params.rays, seed, cancel);
                break;
            }
        });
        if (cancel.load(std::memory_order_relaxed)) return {};
        if (progress) progress(double(std::min(points.size(), first + block)) / double(points.size()));
    }
    return results;
}

} // namespace lueur
