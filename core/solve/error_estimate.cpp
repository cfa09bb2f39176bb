#include "core/solve/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/parallel_sort.h>

#include "core/solve/solution_steps.h"
#include "core/solve/traced_field.h"
#include "core/transport/mesh.h"

namespace lueur {

namespace {

using State = Solution::State;

constexpr double dark_share = 0.02; // of the mean: darker, a relative error is not seen

// What the field bends by at each vertex: RMS, over the edges around it, of how far the plane of one triangle misses
// the far corner of its neighbour. A field that is linear has none.
std::vector<float> bends(std::span<const glm::uvec3> elements, const Mesh& mesh,
                         const std::vector<std::uint8_t>& left_out, std::span<const float> value) {
    struct Side {
        std::uint64_t edge;
        std::uint32_t element, apex;
    };
    std::vector<Side> sides;
    sides.reserve(3 * elements.size());
    for (std::uint32_t e = 0; e < elements.size(); ++e)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = elements[e][k], b = elements[e][(k + 1) % 3];
            sides.push_back({std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), e, elements[e][(k + 2) % 3]});
        }
    tbb::parallel_sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
        return x.edge != y.edge ? x.edge < y.edge : x.element < y.element;
    });
    std::vector<float> square(value.size(), 0), count(value.size(), 0);
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        if (sides[i].edge != sides[i + 1].edge) continue;
        const auto a = static_cast<std::uint32_t>(sides[i].edge >> 32), b = static_cast<std::uint32_t>(sides[i].edge);
        const std::uint32_t c = sides[i].apex, d = sides[i + 1].apex;
        if (left_out[a] || left_out[b] || left_out[c] || left_out[d]) continue;
        const glm::vec3 p = mesh.vertices[a].position, ab = mesh.vertices[b].position - p,
                        ac = mesh.vertices[c].position - p, ad = mesh.vertices[d].position - p;
        const float bb = glm::dot(ab, ab), bc = glm::dot(ab, ac), cc = glm::dot(ac, ac);
        const float det = bb * cc - bc * bc;
        if (!(det > 1e-6f * bb * cc)) continue;
        const float u = (cc * glm::dot(ad, ab) - bc * glm::dot(ad, ac)) / det,
                    w = (bb * glm::dot(ad, ac) - bc * glm::dot(ad, ab)) / det;
        // A far corner a long way off says more of that than of this edge.
        const float jump = (value[d] - value[a] - u * (value[b] - value[a]) - w * (value[c] - value[a])) /
                           std::max(1.0f, std::abs(u) + std::abs(w));
        for (const std::uint32_t v : {a, b, c, d}) square[v] += jump * jump, count[v] += 1;
    }
    for (std::size_t v = 0; v < square.size(); ++v) square[v] = count[v] > 0 ? std::sqrt(square[v] / count[v]) : 0;
    return square;
}

// Each vertex and its neighbours, twice over: a variance known by one difference each becomes one known by many.
void pool(std::span<const glm::uvec3> elements, const std::vector<std::uint8_t>& left_out, std::span<float> variance) {
    std::vector<float> sum(variance.size()), count(variance.size());
    for (int ring = 0; ring < 2; ++ring) {
        std::fill(sum.begin(), sum.end(), 0.0f);
        std::fill(count.begin(), count.end(), 0.0f);
        for (const glm::uvec3& e : elements)
            for (int k = 0; k < 3; ++k) {
                if (left_out[e[k]]) continue;
                for (int m = 0; m < 3; ++m) sum[e[m]] += variance[e[k]], count[e[m]] += 1;
            }
        for (std::size_t v = 0; v < variance.size(); ++v)
            if (count[v] > 0) variance[v] = sum[v] / count[v];
    }
}

// Squared mean difference to the neighbours.
std::vector<float> neighbour_differences(std::span<const glm::uvec3> elements,
                                         const std::vector<std::uint8_t>& left_out, std::span<const float> value) {
    std::vector<float> square(value.size(), 0), count(value.size(), 0);
    for (const glm::uvec3& e : elements)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = e[k], b = e[(k + 1) % 3];
            if (left_out[a] || left_out[b]) continue;
            const float d = (value[a] - value[b]) * (value[a] - value[b]);
            square[a] += d, square[b] += d, count[a] += 1, count[b] += 1;
        }
    for (std::size_t v = 0; v < square.size(); ++v)
        if (count[v] > 0) square[v] /= count[v];
    return square;
}

// What estimate_error works on: luminous, at the fine vertices.
struct Light {
    std::vector<float> total, direct, indirect, reflected, area;
    std::vector<float> direct_variance;
    std::vector<float> unlit; // direct light of luminaires that have not shot yet
    std::vector<std::uint8_t> buried;
    double mean = 0, total_area = 0; // over the surfaces that are not buried
    double caught = 1;               // of the luminaires' flux by the surfaces: 1 in a closed scene
};

// Buried vertices that share an element with one that is not: half of what is around them is seen, and what is shown
// there is made up of the neighbours.
std::vector<std::uint8_t> rim_of(const Mesh& mesh, const std::vector<std::uint8_t>& buried) {
    std::vector<std::uint8_t> rim(buried.size(), 0);
    for (const glm::uvec3& e : mesh.elements)
        if (const int inside = buried[e.x] + buried[e.y] + buried[e.z]; inside == 1 || inside == 2)
            for (int k = 0; k < 3; ++k) rim[e[k]] = buried[e[k]];
    return rim;
}

// Direct light is in what is shown, apart or through form factors; only shooting leaves out luminaires that have not
// shot yet.
bool is_shown(const State& s, std::size_t luminaire) {
    return s.solver() != SolverKind::shooting || s.luminaire_is_lit(luminaire);
}

// Of each luminaire whose light is shown, lm m^-2.
std::vector<double> luminous_exitances(const State& s) {
    std::vector<double> exitance;
    for (std::size_t l = 0; l < s.direct->emitter_count(); ++l)
        exitance.push_back(
            is_shown(s, l) ? xyz_from_channels(*s.wavelengths, std::span<const double>(s.luminaire_exitance[l])).y : 0);
    return exitance;
}

Light light_of(const State& s, const Field& field) {
    Light light;
    const std::size_t count = field.irradiance_xyz.size(), emitters = s.direct->emitter_count();
    light.area = vertex_areas(s.mesh);
    light.buried = s.all_buried();
    const std::vector<double> exitance = luminous_exitances(s);
    std::vector<double> all; // shown or not
    for (const auto& channels : s.luminaire_exitance)
        all.push_back(xyz_from_channels(*s.wavelengths, std::span<const double>(channels)).y);
    double caught = 0;
    for (std::uint32_t v = 0; v < count; ++v) {
        double d = 0, variance = 0, unlit = 0;
        for (std::size_t l = 0; l < emitters; ++l) {
            d += s.direct->at_vertex(v)[l] * exitance[l];
            const double deviation = s.direct->deviation_at_vertex(v)[l] * exitance[l];
            variance += deviation * deviation;
            if (!is_shown(s, l)) unlit += s.direct->at_vertex(v)[l] * all[l];
        }
        const float y = field.irradiance_xyz[v].y;
        light.total.push_back(y);
        light.direct.push_back(static_cast<float>(d));
        light.indirect.push_back(y - static_cast<float>(d));
        light.reflected.push_back(field.reflected_xyz[v].y * std::numbers::pi_v<float>);
        light.direct_variance.push_back(static_cast<float>(variance));
        light.unlit.push_back(static_cast<float>(unlit));
        if (light.buried[v]) continue;
        light.mean += double(light.area[v]) * y;
        light.total_area += light.area[v];
        caught += double(light.area[v]) * d;
    }
    double emitted = 0;
    for (std::size_t l = 0; l < emitters; ++l) emitted += exitance[l] * s.direct->emitters()[l].area;
    if (emitted > 0) light.caught = std::clamp(caught / emitted, 0.0, 1.0);
    if (light.total_area > 0) light.mean /= light.total_area;
    return light;
}

// Variances by cause, at the fine vertices.
struct Model {
    std::vector<float> direct, indirect; // at the vertices
    std::vector<float> between;          // added between them
};

// Of indirect light, at the coarse vertices where it is solved and at those that interpolate it.
std::vector<float> indirect_variance(const State& s, const Light& light) {
    const std::uint32_t coarse =
                            s.indirect().count < light.total.size() ? s.indirect().count : s.mesh.coarse_vertex_count,
                        count = static_cast<std::uint32_t>(light.total.size());
    std::vector<float> variance(count, 0);
    if (!s.solving) return variance;
    const std::vector<glm::uvec3> elements = elements_of_level(s.mesh, coarse);
    const std::span<const float> value(light.indirect.data(), coarse);
    const std::vector<float> near = neighbour_differences(elements, s.buried, value);
    const std::vector<float> bend = bends(elements, s.mesh, s.buried, value);
    for (std::uint32_t v = 0; v < coarse; ++v) {
        // A solver that says nothing of itself errs by what distinguishes a vertex from its neighbours.
        variance[v] =
            s.indirect_deviation.empty() ? 0.25f * near[v] : s.indirect_deviation[v] * s.indirect_deviation[v];
    }
    pool(elements, s.buried, std::span(variance.data(), coarse));
    const bool shared = s.solver() == SolverKind::gathering;
    for (std::uint32_t v = 0; v < coarse; ++v) // read from a receiver that lies elsewhere
        if (shared && s.receivers.vertex[s.receivers.of_vertex[v]] != v) variance[v] += 0.25f * near[v];
    // Halfway between two vertices their errors are half averaged away, and a bent field is missed.
    std::vector<float> bent(count, 0);
    for (std::uint32_t v = 0; v < coarse; ++v) bent[v] = bend[v] * bend[v];
    for (std::uint32_t v = coarse; v < count; ++v) {
        const auto& p = s.mesh.vertices[v].parents;
        variance[v] = 0.4f * (variance[p[0]] + variance[p[1]]);
        bent[v] = 0.5f * (bent[p[0]] + bent[p[1]]);
    }
    for (std::uint32_t v = coarse; v < count; ++v) variance[v] += 0.0625f * bent[v];
    return variance;
}

Model model_of(const State& s, const Light& light) {
    Model model{light.direct_variance, indirect_variance(s, light), {}};
    model.between = bends(s.mesh.elements, s.mesh, light.buried, light.total);
    for (float& b : model.between) b = 0.0625f * b * b; // a quarter of the bend
    return model;
}

// What the probes say: residuals and their own variance.
struct Residual {
    const ErrorProbes::Point* point;
    double direct, indirect, direct_noise, indirect_noise, illuminance; // lx, lx^2
    double model_direct, model_indirect, model_between;
    double weight; // area over illuminance squared: sums of squares become relative
};

double read(std::span<const float> values, const ErrorProbes::Point& p) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += double(p.weights[k]) * values[p.vertices[k]];
    return sum;
}

std::vector<Residual> residuals(const State& s, const Light& light, const Model& model) {
    std::vector<Residual> list;
    if (!s.probes.complete()) return list;
    const std::size_t emitters = s.direct->emitter_count();
    const std::vector<double> exitance = luminous_exitances(s);
    constexpr int sets = ErrorProbes::sets, per_set = ErrorProbes::rays / sets;
    std::vector<float> reflected = light.reflected;
    for (std::size_t i = 0; i < s.probes.points.size(); ++i) {
        const ErrorProbes::Point& p = s.probes.points[i];
        double direct[sets] = {}, indirect[sets] = {};
        for (int set = 0; set < sets; ++set) {
            for (std::size_t l = 0; l < emitters; ++l)
                direct[set] += double(s.probes.direct[(i * sets + std::size_t(set)) * emitters + l]) * exitance[l];
            for (int k = 0; k < per_set; ++k)
                if (const std::uint32_t end = s.probes.ends[i * ErrorProbes::rays + set * per_set + k]; end != no_index)
                    indirect[set] += double(reflected[end]) / per_set;
        }
        Residual r{};
        r.point = &p;
        r.illuminance = read(light.total, p);
        r.direct = (direct[0] + direct[1]) / 2 - read(light.direct, p);
        r.indirect = (indirect[0] + indirect[1]) / 2 - read(light.indirect, p);
        r.direct_noise = (direct[0] - direct[1]) * (direct[0] - direct[1]) / 4;
        r.indirect_noise = (indirect[0] - indirect[1]) * (indirect[0] - indirect[1]) / 4;
        r.model_direct = read(model.direct, p);
        r.model_indirect = read(model.indirect, p);
        r.model_between = p.between ? read(model.between, p) : 0;
        const double bright = std::max(r.illuminance, dark_share * light.mean);
        r.weight = bright > 0 ? double(p.area) / (bright * bright) : 0;
        list.push_back(r);
    }
    return list;
}

// How much larger variances are than modelled: of what was found and what was modelled, drawn to 1 as if `prior` of
// the probes had found the model right. Few large errors decide such sums, so that they are not believed beyond reason.
struct Scale {
    double found = 0, modelled = 0;
    void add(double f, double m, double weight) { found += weight * f, modelled += weight * m; }
    double factor() const {
        constexpr double prior = 0.3, most = 25;
        if (!(modelled > 0)) return 1;
        return std::clamp((std::max(0.0, found) + prior * modelled) / ((1 + prior) * modelled), 1 / most, most);
    }
};

void set_relative_error(const Light& light, Field& field) {
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
double interval_factor(const std::vector<Residual>& probes, const std::vector<float>& error) {
    constexpr double normal = 1.96, most = 4;
    std::vector<std::pair<double, double>> far; // standard deviations, area
    double all = 0;
    for (const Residual& r : probes) {
        if (r.point->between) continue;
        const double sigma = error[r.point->vertices.x];
        const double deviation = std::sqrt(sigma * sigma + r.direct_noise + r.indirect_noise);
        far.emplace_back(deviation > 0 ? std::abs(r.direct + r.indirect) / deviation : 0, r.point->area);
        all += r.point->area;
    }
    std::sort(far.begin(), far.end());
    double inside = 0;
    for (const auto& [deviations, area] : far)
        if ((inside += area) >= 0.95 * all) return std::clamp(deviations, normal, most);
    return normal;
}

// Paths know their own error; between the vertices they are interpolated as any other.
void estimate_traced_error(const State& s, const Light& light, Field& field) {
    const std::vector<float> bend = bends(s.mesh.elements, s.mesh, light.buried, light.total);
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
        std::min(1.0, relative_rms(light.total, field.error, field.interpolation_error, light.area, light.buried));
}

} // namespace

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
        square += area[v] * variance / (double(illuminance[v]) * illuminance[v]);
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
    const Light light = light_of(s, field);
    if (s.is_traced()) return estimate_traced_error(s, light, field);
    const Model model = model_of(s, light);
    const std::vector<Residual> probes = residuals(s, light, model);

    // Light that is missing everywhere: the mean residual is one reflection of it, all of it 1 / (1 - rho) times that.
    const double rho = std::min(0.999, mean_luminous_reflectance(s) * light.caught);
    double missing = 0;
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
        missing = std::sqrt(std::max(0.0, mean * mean - noise)) / (1 - rho);
    } else {
        double flux = 0;
        const std::vector<float> unshot = s.solving ? s.unshot_at_vertices() : std::vector<float>{};
        for (std::uint32_t v = 0; v < count; ++v) {
            if (light.buried[v]) continue;
            if (!s.solving)
                flux += double(light.area[v]) * light.reflected[v];
            else if (v < unshot.size())
                flux +=
                    double(unshot.size() == s.indirect_area.size() ? s.indirect_area[v] : s.coarse_area[v]) * unshot[v];
        }
        missing = light.total_area > 0 ? light.caught * flux / light.total_area / (1 - rho) : 0;
    }

    Scale direct, indirect, between;
    for (const Residual& r : probes)
        if (!r.point->between) {
            direct.add(r.direct * r.direct - r.direct_noise, r.model_direct, r.weight);
            indirect.add(r.indirect * r.indirect - r.indirect_noise - missing * missing * (1 - rho) * (1 - rho),
                         r.model_indirect, r.weight);
        }
    const double direct_factor = direct.factor(), indirect_factor = indirect.factor();
    for (const Residual& r : probes)
        if (r.point->between) {
            const double all = r.direct + r.indirect;
            const double at_vertices = direct_factor * r.model_direct + indirect_factor * r.model_indirect;
            between.add(all * all - r.direct_noise - r.indirect_noise - at_vertices, r.model_between, r.weight);
        }
    const double between_factor = between.factor();
    const WavelengthError& channels = s.choice.illuminance_error;
    for (std::size_t v = 0; v < count; ++v) {
        const double wavelengths =
            std::abs(channels.direct * light.direct[v]) + std::abs(channels.reflected * light.indirect[v]);
        const double variance = direct_factor * model.direct[v] + indirect_factor * model.indirect[v] +
                                missing * missing + wavelengths * wavelengths + double(light.unlit[v]) * light.unlit[v];
        field.error[v] = static_cast<float>(std::sqrt(variance));
        field.interpolation_error[v] = static_cast<float>(std::sqrt(between_factor * model.between[v]));
    }
    std::vector<float> area = light.area;
    std::vector<std::uint8_t> left_out = light.buried;
    const std::vector<std::uint8_t> rim = rim_of(s.mesh, light.buried);
    for (std::size_t v = 0; v < count; ++v) {
        if (!rim[v]) continue;
        field.error[v] = std::max(field.error[v], 0.5f * light.total[v]);
        area[v] *= 0.5f;
        left_out[v] = 0;
    }
    set_relative_error(light, field);
    field.interval_factor = interval_factor(probes, field.error);
    field.scene_error =
        std::min(1.0, relative_rms(light.total, field.error, field.interpolation_error, area, left_out));
}

} // namespace lueur
