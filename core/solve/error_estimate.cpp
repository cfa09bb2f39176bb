#include "core/solve/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/solve/error_light.h"
#include "core/solve/solution_steps.h"
#include "core/solve/traced_field.h"
#include "core/transport/mesh.h"

namespace lueur {

namespace {

using State = Solution::State;

constexpr double dark_share = 0.02; // of the mean: darker, a relative error is not seen

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

// At how many vertices, the first ones, indirect light is solved; the others interpolate it.
std::uint32_t solved_vertices(const State& s) {
    const std::uint32_t count = s.solving ? s.indirect().count : 0;
    return count > 0 && count < s.mesh.vertices.size() ? count : s.mesh.coarse_vertex_count;
}

// Variances by cause, at the fine vertices.
struct Model {
    std::vector<float> direct;  // of the shadow rays
    std::vector<float> rays;    // of what a solver knows of its own indirect light
    std::vector<float> bent;    // of indirect light, as far as it differs from vertex to vertex
    std::vector<float> between; // added between the vertices
    bool known = false;         // the solver says something of its own error
};

// Indirect light is solved at the vertices of one level; others interpolate it. Halfway between two vertices their
// errors are half averaged away, and a bent field is missed.
void model_indirect(const State& s, const ErrorMesh& mesh, const ErrorLight& light, Model& model) {
    const std::uint32_t coarse = mesh.level, count = static_cast<std::uint32_t>(light.total.size());
    model.rays.assign(count, 0);
    model.bent.assign(count, 0);
    if (!s.solving) return;
    const std::span<const float> value(light.indirect.data(), coarse);
    const std::vector<float> near = mesh.coarse.neighbour_differences(value), bend = mesh.coarse.at_vertices(value);
    const double least = dark_share * light.mean;
    // After the mesh has changed what was known of the level before is of no use.
    model.known = s.indirect_deviation.size() >= coarse;
    if (model.known) {
        for (std::uint32_t v = 0; v < coarse; ++v) model.rays[v] = s.indirect_deviation[v] * s.indirect_deviation[v];
        pool(mesh.coarse_elements, s.buried, value, least, std::span(model.rays.data(), coarse));
    }
    const bool shared = s.solver() == SolverKind::gathering;
    for (std::uint32_t v = 0; v < coarse; ++v) {
        model.bent[v] = 0.25f * near[v];
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

Model model_of(const State& s, const ErrorMesh& mesh, const ErrorLight& light) {
    Model model{light.direct_variance, {}, {}, mesh.fine.at_vertices(light.total), false};
    model_indirect(s, mesh, light, model);
    for (float& b : model.between) b = 0.0625f * b * b; // a quarter of the bend
    return model;
}

// What the probes say: residuals and their own variance.
struct Residual {
    const ErrorProbes::Point* point;
    double direct, indirect, direct_noise, indirect_noise; // lx, lx^2
    double model_direct, model_rays, model_bent, model_between;
    double bright; // lx, what an error here is relative to: the larger of what is shown and what was gathered
    double area;   // m^2 that counts: none where it is dark
    // Area over bright squared: sums of squares become relative, and no point counts for more than itself.
    double weight;
};

double read(std::span<const float> values, const ErrorProbes::Point& p) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += double(p.weights[k]) * values[p.vertices[k]];
    return sum;
}

struct Sets {
    std::array<double, ErrorProbes::sets> value{};
    double mean() const { return std::accumulate(value.begin(), value.end(), 0.0) / ErrorProbes::sets; }
    double noise() const { // of the mean
        const double m = mean();
        double sum = 0;
        for (const double v : value) sum += (v - m) * (v - m);
        return sum / (ErrorProbes::sets * (ErrorProbes::sets - 1));
    }
};

Residual residual_at(const State& s, const ErrorLight& light, const Model& model, std::size_t i) {
    constexpr int sets = ErrorProbes::sets, per_set = ErrorProbes::rays / sets;
    const ErrorProbes::Point& p = s.probes.points[i];
    const std::size_t emitters = light.exitance.size();
    Sets direct, indirect;
    for (std::size_t set = 0; set < sets; ++set) {
        for (std::size_t l = 0; l < emitters; ++l)
            direct.value[set] += double(s.probes.direct[(i * sets + set) * emitters + l]) * light.exitance[l];
        for (std::size_t k = 0; k < per_set; ++k)
            if (const std::uint32_t end = s.probes.ends[i * ErrorProbes::rays + set * per_set + k]; end != no_index)
                indirect.value[set] += double(light.reflected[end]) / per_set;
    }
    Residual r{};
    r.point = &p;
    const double shown = read(light.total, p);
    r.direct = direct.mean() - read(light.direct, p);
    r.indirect = indirect.mean() - read(light.indirect, p);
    r.direct_noise = direct.noise();
    r.indirect_noise = indirect.noise();
    r.model_direct = read(model.direct, p);
    r.model_rays = read(model.rays, p);
    r.model_bent = read(model.bent, p);
    r.model_between = p.between ? read(model.between, p) : 0;
    const double gathered = direct.mean() + indirect.mean();
    r.bright = std::max(shown, gathered);
    r.area = gathered > dark_share * light.mean ? p.area : 0;
    r.weight = r.area > 0 ? r.area / (r.bright * r.bright) : 0;
    return r;
}

std::vector<Residual> residuals(const State& s, const ErrorLight& light, const Model& model) {
    if (!s.probes.complete()) return {};
    std::vector<Residual> list(s.probes.points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, list.size(), 32),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i)
                              list[i] = residual_at(s, light, model, i);
                      });
    // Few sets know their own spread badly: each half by itself, half by what is usual.
    double direct = 0, indirect = 0, area = 0;
    for (const Residual& r : list) {
        direct += r.weight * r.direct_noise, indirect += r.weight * r.indirect_noise;
        area += r.area;
    }
    for (Residual& r : list) {
        if (!(area > 0)) break;
        const double square = r.bright * r.bright / area;
        if (r.direct_noise > 0) r.direct_noise = 0.5 * (r.direct_noise + direct * square);
        r.indirect_noise = 0.5 * (r.indirect_noise + indirect * square);
    }
    return list;
}

// How much larger variances are than modelled: what the probes found over what was modelled there, drawn to what is
// believed beforehand as far as the probes do not know it better. Squares of errors are spread widely: a variance of
// 2 sigma^4 each where they are normal.
class Scale {
public:
    void add(double found, double modelled, double noise, double weight) {
        found_ += weight * found, modelled_ += weight * modelled;
        const double spread = std::max(std::abs(found), 1.4 * (modelled + noise));
        square_ += weight * weight * spread * spread;
    }
    double factor(double believed, double deviation) const {
        constexpr double most = 25;
        if (!(modelled_ > 0)) return believed;
        const double known = modelled_ * deviation * deviation;
        return std::clamp((found_ * known + believed * square_) / (modelled_ * known + square_), 0.2 * believed, most);
    }

private:
    double found_ = 0, modelled_ = 0, square_ = 0;
};

// Light that is missing everywhere, lx: the mean residual is one reflection of it, all of it 1 / (1 - rho) times that.
double missing_light(const State& s, const ErrorMesh& mesh, const ErrorLight& light,
                     const std::vector<Residual>& probes, double rho) {
    if (!probes.empty()) {
        double mean = 0, area = 0, noise = 0;
        for (const Residual& r : probes) {
            mean += r.point->area * r.indirect;
            area += r.point->area;
        }
        mean /= area;
        for (const Residual& r : probes) {
            const double w = r.point->area / area;
            noise += w * w * (r.indirect - mean) * (r.indirect - mean);
        }
        // What a mean of as many probes may be by chance is no sign of anything missing.
        return std::sqrt(std::max(0.0, mean * mean - noise)) / (1 - rho);
    }
    double flux = 0;
    const std::vector<float> unshot = s.solving ? s.unshot_at_vertices() : std::vector<float>{};
    for (std::uint32_t v = 0; v < light.total.size(); ++v) {
        if (mesh.buried[v]) continue;
        if (!s.solving)
            flux += double(mesh.area[v]) * light.reflected[v];
        else if (v < unshot.size())
            flux += double(unshot.size() == s.indirect_area.size() ? s.indirect_area[v] : s.coarse_area[v]) * unshot[v];
    }
    return mesh.seen_area > 0 ? light.caught * flux / mesh.seen_area / (1 - rho) : 0;
}

// What variances of the model are to be multiplied with.
struct Factors {
    double direct = 1, rays = 1, bent = 1, between = 1;
};

Factors fit_model(const State& s, const Model& model, const std::vector<Residual>& probes,
                  const std::vector<float>& missing_at, double rho) {
    // What shadow rays and gather rays err by is known well, the rest is a guess.
    Scale direct, rays, bent, between;
    const auto indirect_found = [&](const Residual& r) {
        const double of_missing = (1 - rho) * read(missing_at, *r.point);
        return r.indirect * r.indirect - r.indirect_noise - of_missing * of_missing;
    };
    for (const Residual& r : probes)
        if (!r.point->between) {
            direct.add(r.direct * r.direct - r.direct_noise, r.model_direct, r.direct_noise, r.weight);
            rays.add(indirect_found(r), r.model_rays, r.indirect_noise, r.weight);
        }
    Factors factors;
    factors.direct = direct.factor(1, 1), factors.rays = rays.factor(1, 0.25);
    // What is wrong here is as wrong close by, in a corner or at the foot of a block: the probe reads that, and finds
    // only what is not reflected back and forth. Form factors and patches err the same way further off too, about half.
    const double reflectance = mean_luminous_reflectance(s);
    for (const Residual& r : probes)
        if (!r.point->between) {
            const double alike = model.known ? r.point->near : 0.5 + 0.5 * r.point->near;
            const double unseen = 1 / std::pow(1 - std::min(0.7, reflectance * alike), 2);
            bent.add(unseen * (indirect_found(r) - factors.rays * r.model_rays), r.model_bent,
                     unseen * (factors.rays * r.model_rays + r.indirect_noise), r.weight);
        }
    factors.bent = model.known ? bent.factor(0.03, 0.15) : bent.factor(1, 1);
    for (const Residual& r : probes)
        if (r.point->between) {
            const double all = r.direct + r.indirect;
            const double at_vertices =
                factors.direct * r.model_direct + factors.rays * r.model_rays + factors.bent * r.model_bent;
            const double noise = r.direct_noise + r.indirect_noise;
            between.add(all * all - noise - at_vertices, r.model_between, at_vertices + noise, r.weight);
        }
    factors.between = between.factor(1, 2);
    return factors;
}

void set_relative_error(const ErrorLight& light, Field& field) {
    field.relative_error.assign(field.error.size(), 0);
    for (std::size_t v = 0; v < field.error.size(); ++v) {
        const double bright = std::max(double(light.total[v]), dark_share * light.mean);
        if (bright > 0)
            field.relative_error[v] = static_cast<float>(
                100 * std::hypot(double(field.error[v]), double(field.interpolation_error[v])) / bright);
    }
}

// Errors have longer tails than the normal distribution: so many standard deviations hold 95 % of the residuals at the
// probed vertices, the probes' own noise counted in both.
double interval_factor(const std::vector<Residual>& probes, const std::vector<float>& error, bool knows_its_rays) {
    // Student's t where eight differences tell a variance; patches of one radiosity err a whole patch at a time, with
    // longer tails.
    const double least = knows_its_rays ? 2.3 : 2.8;
    constexpr double normal = 1.96, most = 5;
    std::vector<std::pair<double, double>> far; // standard deviations, area
    double all = 0, noise = 0, stated = 0;
    for (const Residual& r : probes) {
        if (r.point->between) continue;
        const double sigma = error[r.point->vertices.x];
        const double deviation = std::sqrt(sigma * sigma + r.direct_noise + r.indirect_noise);
        noise += r.weight * (r.direct_noise + r.indirect_noise), stated += r.weight * sigma * sigma;
        far.emplace_back(deviation > 0 ? std::abs(r.direct + r.indirect) / deviation : 0, r.area);
        all += r.area;
    }
    std::sort(far.begin(), far.end());
    double inside = 0;
    for (const auto& [deviations, area] : far)
        if ((inside += area) >= 0.95 * all) {
            // The noise of the probes is normal, and hides as much of the tail as it has of the variance.
            const double seen = std::max(0.3, stated / (stated + noise));
            return std::clamp(normal + (deviations - normal) / seen, least, most);
        }
    return least;
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

// One shadow ray for a lamp is a guess: nothing is known of its error before the real ones are traced.
void know_nothing(const ErrorLight& light, Field& field) {
    if (!(light.mean > 0)) return;
    for (std::size_t v = 0; v < field.error.size(); ++v)
        field.error[v] = std::max(light.total[v], static_cast<float>(light.mean));
    set_relative_error(light, field);
    field.scene_error = 1;
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
    const bool sketched = s.phase == SolvePhase::sketch || s.phase == SolvePhase::light;
    if (sketched && !s.is_traced())
        return know_nothing(
            error_light(s, make_error_mesh(s.mesh, solved_vertices(s), s.all_buried(), s.buried, false), field), field);
    const ErrorMesh& mesh = error_mesh_of(s);
    const ErrorLight light = error_light(s, mesh, field);
    if (s.is_traced()) return estimate_traced_error(s, mesh, light, field);
    const Model model = model_of(s, mesh, light);
    const std::vector<Residual> probes = residuals(s, light, model);

    const double rho = std::min(0.999, mean_luminous_reflectance(s) * light.caught);
    const double missing = missing_light(s, mesh, light, probes, rho);
    // It is missing in proportion to what is there already, as far as anything is.
    std::vector<float> missing_at(count);
    const double mean_indirect = std::max(0.0, light.mean_indirect);
    for (std::size_t v = 0; v < count && missing > 0; ++v)
        missing_at[v] = static_cast<float>(missing * (std::max(0.0, double(light.indirect[v])) + missing) /
                                           (mean_indirect + missing));
    const Factors factors = fit_model(s, model, probes, missing_at, rho);

    const WavelengthError& channels = s.choice.illuminance_error;
    for (std::size_t v = 0; v < count; ++v) {
        const double wavelengths =
            std::abs(channels.direct * light.direct[v]) + std::abs(channels.reflected * light.indirect[v]);
        const double variance = factors.direct * model.direct[v] + factors.rays * model.rays[v] +
                                factors.bent * model.bent[v] + double(missing_at[v]) * missing_at[v] +
                                wavelengths * wavelengths + double(light.unlit[v]) * light.unlit[v];
        field.error[v] = static_cast<float>(std::sqrt(variance));
        field.interpolation_error[v] = static_cast<float>(std::sqrt(factors.between * model.between[v]));
    }
    std::vector<float> area = mesh.area;
    std::vector<std::uint8_t> left_out = mesh.buried;
    for (std::size_t v = 0; v < count; ++v) {
        if (!mesh.rim[v]) continue;
        field.error[v] = std::max(field.error[v], 0.5f * light.total[v]);
        area[v] *= 0.5f;
        left_out[v] = 0;
    }
    set_relative_error(light, field);
    field.interval_factor = interval_factor(probes, field.error, !s.indirect_deviation.empty());
    field.scene_error =
        std::min(1.0, relative_rms(light.total, field.error, field.interpolation_error, area, left_out));
}

} // namespace lueur
