#include "core/solve/error_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/solve/relative_error.h"
#include "core/solve/solution_steps.h"

namespace lueur {

namespace {

using State = Solution::State;

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

Residual residual_at(const State& s, const ErrorLight& light, const ErrorModel& model, std::size_t i) {
    constexpr std::size_t sets = ErrorProbes::sets;
    const std::size_t per_set = static_cast<std::size_t>(s.probes.rays) / sets;
    const ErrorProbes::Point& p = s.probes.points[i];
    const std::size_t emitters = light.exitance.size();
    Sets direct, indirect;
    for (std::size_t set = 0; set < sets; ++set) {
        for (std::size_t l = 0; l < emitters; ++l)
            direct.value[set] += double(s.probes.direct[(i * sets + set) * emitters + l]) * light.exitance[l];
        for (std::size_t k = 0; k < per_set; ++k)
            if (const std::uint32_t end = s.probes.ends[(i * sets + set) * per_set + k]; end != no_index)
                indirect.value[set] += double(light.reflected[end]) / double(per_set);
    }
    Residual r{};
    r.point = &p;
    const double shown = read(light.total, p);
    r.direct = direct.mean() - read(light.direct, p);
    r.indirect = indirect.mean() - read(light.indirect, p);
    r.direct_noise = direct.noise();
    r.indirect_noise = indirect.noise();
    if (!shows_direct_apart(s)) { // all of it is the solver's
        r.indirect += r.direct, r.indirect_noise += r.direct_noise;
        r.direct = r.direct_noise = 0;
    }
    r.model_direct = read(model.direct, p);
    r.model_hidden = read(model.hidden, p);
    r.model_rays = read(model.rays, p);
    r.model_bent = read(model.bent, p);
    r.model_between = p.between ? read(model.between, p) : 0;
    r.model_read_direct = read(model.read_direct, p);
    r.model_read_indirect = read(model.read_indirect, p);
    const double gathered = direct.mean() + indirect.mean();
    r.bright = std::max(shown, gathered);
    r.unsent = shown > 0 ? r.direct * read(light.reflected, p) / shown * (1 - double(p.near)) : 0;
    r.area = gathered > dark_share * light.mean ? p.area : 0;
    r.weight = r.area > 0 ? r.area / (r.bright * r.bright) : 0;
    return r;
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

} // namespace

double read(std::span<const float> values, const ErrorProbes::Point& p) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += double(p.weights[k]) * values[p.vertices[k]];
    return sum;
}

std::vector<Residual> residuals(const State& s, const ErrorLight& light, const ErrorModel& model) {
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

ErrorFactors fit_model(const State& s, const ErrorMesh& mesh, const ErrorLight& light, const ErrorModel& model,
                       const std::vector<Residual>& probes, const std::vector<float>& missing_at, double rho) {
    // What shadow rays and gather rays err by is known well, the rest is a guess.
    ErrorFactors factors;
    Scale direct, hidden, rays, bent, between, readings, rim;
    const auto indirect_found = [&](const Residual& r) {
        const double of_missing = (1 - rho) * read(missing_at, *r.point);
        return r.indirect * r.indirect - r.indirect_noise - of_missing * of_missing;
    };
    // Samples that differ do so mostly as the plane through them does: a quarter of it is believed to be error.
    for (const Residual& r : probes)
        if (!r.point->between && r.model_read_direct + r.model_read_indirect > 0) {
            readings.add(r.direct * r.direct - r.direct_noise - r.model_direct, r.model_read_direct,
                         r.model_direct + r.direct_noise, r.weight);
            readings.add(indirect_found(r) - r.model_rays, r.model_read_indirect, r.model_rays + r.indirect_noise,
                         r.weight);
        }
    factors.read = readings.factor(0.25, 1);
    const auto read_direct = [&](const Residual& r) { return factors.read * r.model_read_direct; };
    const auto read_indirect = [&](const Residual& r) { return factors.read * r.model_read_indirect; };
    // Each probe in its own terms, the wildest cut: what a few slats before a window lack must not be believed of all.
    constexpr double wildest = 25, most_at_rim = 9; // all of what is shown
    for (const Residual& r : probes)
        if (const double other = r.model_direct + read_direct(r) + r.direct_noise;
            !r.point->between && r.model_hidden > 0)
            hidden.add(std::min(r.direct * r.direct - other, wildest * (r.model_hidden + other)), r.model_hidden, other,
                       r.area / (r.model_hidden + other));
    factors.hidden = hidden.factor(0.01, 1);
    for (const Residual& r : probes)
        if (!r.point->between) {
            const double of_hidden = factors.hidden * r.model_hidden + read_direct(r);
            direct.add(r.direct * r.direct - r.direct_noise - of_hidden, r.model_direct, of_hidden + r.direct_noise,
                       r.weight);
            rays.add(indirect_found(r) - read_indirect(r), r.model_rays, r.indirect_noise + read_indirect(r), r.weight);
        }
    factors.direct = direct.factor(1, 1), factors.rays = rays.factor(1, 0.25);
    // What is wrong here is as wrong close by, in a corner or at the foot of a block: the probe reads that, and finds
    // only what is not reflected back and forth. Form factors and patches err the same way further off too, about half.
    const double reflectance = mean_luminous_reflectance(s);
    for (const Residual& r : probes)
        if (!r.point->between) {
            const double alike = model.known ? r.point->near : 0.5 + 0.5 * r.point->near;
            const double unseen = 1 / std::pow(1 - std::min(0.7, reflectance * alike), 2);
            const double others = factors.rays * r.model_rays + read_indirect(r);
            bent.add(unseen * (indirect_found(r) - others), r.model_bent, unseen * (others + r.indirect_noise),
                     r.weight);
        }
    factors.bent = model.known ? bent.factor(0.03, 0.15) : bent.factor(1, 1);
    for (const Residual& r : probes) {
        if (!r.point->between) continue;
        const double all = r.direct + r.indirect, noise = r.direct_noise + r.indirect_noise;
        double at_vertices = 0, at_rim = 0;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t v = r.point->vertices[k];
            const double weight = double(r.point->weights[k]);
            if (mesh.at_rim(v))
                at_rim += weight * double(light.at_rim(v)) * light.at_rim(v);
            else
                at_vertices += weight * factors.at(model, v);
        }
        // Beside a buried vertex, what is made up there is wrong, not the straight line.
        const double found = all * all - noise - at_vertices;
        if (at_rim > 0)
            rim.add(std::min(found, wildest * at_rim), at_rim, at_vertices + noise, r.weight);
        else
            between.add(found, r.model_between, at_vertices + noise, r.weight);
    }
    factors.rim = std::min(rim.factor(1, 1), most_at_rim);
    factors.between = between.factor(1, 2);
    return factors;
}

double interval_factor(const std::vector<Residual>& probes, const std::vector<float>& error, bool knows_its_rays) {
    // Student's t where eight differences tell a variance; patches of one radiosity err a whole patch at a time, with
    // longer tails.
    double least = knows_its_rays ? 2.3 : 2.8;
    if (probes.empty()) least = 3.5; // nobody has looked at the tails
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

} // namespace lueur
