#include "core/solve/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "core/solve/error_fit.h"
#include "core/solve/error_missing.h"
#include "core/solve/relative_error.h"
#include "core/solve/solution_steps.h"
#include "core/solve/traced_field.h"
#include "core/transport/mesh.h"

namespace lueur {

namespace {

using State = Solution::State;

constexpr double interval_of_guesses = 8; // standard deviations: what is reflected on is not there yet
constexpr float guessed_share = 0.5f;     // of usual light, where there may be less: drawers, the backs of shelves
constexpr double interval_of_solved_guesses = 5; // it is there, but for what one shadow ray a lamp got wrong

void set_relative_error(const ErrorLight& light, Field& field) {
    field.relative_error.assign(field.error.size(), 0);
    for (std::size_t v = 0; v < field.error.size(); ++v) {
        const double bright = std::max(double(light.total[v]), dark_share * light.mean);
        if (bright > 0)
            field.relative_error[v] = static_cast<float>(
                100 * std::hypot(double(field.error[v]), double(field.interpolation_error[v])) / bright);
    }
}

// Paths know their own error; between the vertices they are interpolated as any other.
void estimate_traced_error(const State& s, const ErrorMesh& mesh, const ErrorLight& light, Field& field) {
    const std::vector<float> bend = mesh.fine.at_vertices(light.total);
    const WavelengthError& channels = s.choice.illuminance_error;
    for (std::uint32_t v = 0; v < field.error.size(); ++v) {
        const double paths = s.traced->standard_error(v);
        const double wavelengths =
            channels.direct * std::abs(light.direct[v]) + channels.reflected * std::abs(light.indirect[v]);
        field.error[v] = static_cast<float>(std::hypot(paths, wavelengths));
        // A bend is made of four vertices, whose noise is no bend.
        const double bent = 0.0625 * (double(bend[v]) * bend[v] - 4 * paths * paths);
        field.interpolation_error[v] = static_cast<float>(std::sqrt(std::max(0.0, bent)));
    }
    set_relative_error(light, field);
    field.interval_factor = 1.96 * batch_interval_factor;
    field.scene_error =
        std::min(1.0, relative_rms(light.total, field.error, field.interpolation_error, mesh.area, mesh.buried));
}

// One shadow ray for a lamp is a guess: nothing is known of its error before the real ones are traced, but that light
// is seldom brighter than it is where it was looked at.
void know_nothing(const State& s, const ErrorMesh& mesh, const ErrorLight& light, Field& field) {
    if (!(light.mean > 0)) return;
    const std::uint32_t looked_at = s.direct->sketched_vertices();
    const auto usual = static_cast<float>(usual_light(light, mesh, looked_at));
    for (std::size_t v = 0; v < field.error.size(); ++v)
        field.error[v] =
            v < looked_at ? light.total[v] + guessed_share * usual : 2 * usual; // direct light and its reflections
    set_relative_error(light, field);
    field.interval_factor = interval_of_guesses;
    field.scene_error = 1;
}

// Indirect light is solved for that guess: what is wrong is the guess (office: 24 % RMS, of which 18 % remain with the
// real direct light), and what is not solved yet.
void know_of_guess(const State& s, const ErrorMesh& mesh, const ErrorLight& light, Field& field) {
    constexpr double of_direct = 0.3, of_usual = 0.1;
    const double rho = std::min(0.999, mean_luminous_reflectance(s) * light.caught);
    const std::vector<float> missing = missing_light(s, mesh, light, {}, rho);
    const double hidden = of_usual * usual_light(light, mesh, s.direct->sketched_vertices());
    for (std::size_t v = 0; v < field.error.size(); ++v)
        field.error[v] = static_cast<float>(std::hypot(double(missing[v]), of_direct * light.direct[v], hidden));
    set_relative_error(light, field);
    field.interval_factor = interval_of_solved_guesses;
    field.scene_error = relative_rms(light.total, field.error, {}, mesh.area, mesh.buried);
}

} // namespace

const ErrorMesh& error_mesh_of(const State& s) {
    std::vector<std::uint8_t> buried = s.all_buried();
    const std::uint32_t level = solved_vertices(s);
    if (!s.error_mesh.is_of(s.mesh, level, buried))
        s.error_mesh = make_error_mesh(s.mesh, level, std::move(buried), s.buried);
    return s.error_mesh;
}

double relative_rms(const std::vector<float>& illuminance, const std::vector<float>& deviation,
                    const std::vector<float>& between, const std::vector<float>& area,
                    const std::vector<std::uint8_t>& left_out) {
    double mean = 0, all = 0, square = 0, counted = 0;
    for (std::size_t v = 0; v < illuminance.size(); ++v)
        if (!left_out[v]) mean += double(area[v]) * illuminance[v], all += area[v];
    if (!(mean > 0)) return 0;
    mean /= all;
    for (std::size_t v = 0; v < illuminance.size(); ++v) {
        if (left_out[v] || illuminance[v] < dark_share * mean) continue;
        double variance = double(deviation[v]) * deviation[v];
        if (!between.empty()) variance += double(between[v]) * between[v];
        square += area[v] * variance / (double(illuminance[v]) * illuminance[v] + variance);
        counted += area[v];
    }
    return counted > 0 ? std::sqrt(square / counted) : 0;
}

void estimate_error(const State& s, Field& field) {
    const std::size_t count = field.irradiance_xyz.size();
    field.error.assign(count, 0);
    field.interpolation_error.assign(count, 0);
    field.relative_error.assign(count, 0);
    if (count == 0 || !s.direct || s.phase == SolvePhase::mesh) return;
    if (!s.direct->is_lit() && !s.is_traced()) {
        const ErrorMesh mesh = make_error_mesh(s.mesh, solved_vertices(s), s.all_buried(), s.buried, false);
        const ErrorLight light = error_light(s, mesh, field);
        return s.solving ? know_of_guess(s, mesh, light, field) : know_nothing(s, mesh, light, field);
    }
    const ErrorMesh& mesh = error_mesh_of(s);
    const ErrorLight light = error_light(s, mesh, field);
    if (s.is_traced()) return estimate_traced_error(s, mesh, light, field);
    const ErrorModel model = error_model(s, mesh, light);
    const std::vector<Residual> probes = residuals(s, light, model);

    const double rho = std::min(0.999, mean_luminous_reflectance(s) * light.caught);
    const std::vector<float> missing = missing_light(s, mesh, light, probes, rho);
    const ErrorFactors factors = fit_model(s, mesh, light, model, probes, missing, rho);

    const WavelengthError& channels = s.choice.illuminance_error;
    for (std::size_t v = 0; v < count; ++v) {
        const double wavelengths =
            std::abs(channels.direct * light.direct[v]) + std::abs(channels.reflected * light.indirect[v]);
        const double variance = factors.at(model, v) + double(missing[v]) * missing[v] + wavelengths * wavelengths +
                                double(light.unlit[v]) * light.unlit[v];
        field.error[v] = static_cast<float>(std::sqrt(variance));
        field.interpolation_error[v] = static_cast<float>(std::sqrt(factors.between * model.between[v]));
    }
    std::vector<float> area = mesh.area;
    std::vector<std::uint8_t> left_out = mesh.buried;
    for (std::size_t v = 0; v < count; ++v) {
        if (!mesh.at_rim(v)) continue;
        field.error[v] = std::max(field.error[v], static_cast<float>(std::sqrt(factors.rim)) * light.at_rim(v));
        area[v] = mesh.rim_area[v];
        left_out[v] = 0;
    }
    set_relative_error(light, field);
    field.interval_factor = interval_factor(probes, field.error, !s.indirect_deviation.empty());
    field.scene_error =
        std::min(1.0, relative_rms(light.total, field.error, field.interpolation_error, area, left_out));
}

} // namespace lueur