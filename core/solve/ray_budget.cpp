#include "core/solve/ray_budget.h"

#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lueur {

namespace {

using Range = tbb::blocked_range<std::uint32_t>;
constexpr float grey = 0.5f;
constexpr int grey_sweeps = 8; // 0.5^8: far below what the rays can tell

// `radiosity` has one more entry than receivers, 0: the outside.
double pass_mean(const GatherPass& pass, std::uint32_t receiver, const std::vector<float>& radiosity) {
    double sum = 0;
    const std::uint32_t* ends = pass.ends.data() + std::size_t(receiver) * rays_per_pass;
    for (int k = 0; k < rays_per_pass; ++k) sum += radiosity[ends[k]];
    return sum / rays_per_pass;
}

} // namespace

double ray_error(std::span<const GatherPass> passes, std::span<const float> radiosity, std::span<const float> direct,
                 std::span<const float> weight) {
    if (passes.size() < independent_sets || passes.size() % independent_sets != 0) return 1;
    const std::uint32_t n = static_cast<std::uint32_t>(radiosity.size());
    std::vector<float> b(radiosity.begin(), radiosity.end());
    b.push_back(0);
    std::vector<float> total(n), variance(n);
    tbb::parallel_for(Range(0, n, 256), [&](const Range& range) {
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
            double sets[independent_sets] = {};
            for (std::size_t p = 0; p < passes.size(); ++p)
                sets[p % independent_sets] += independent_sets * pass_mean(passes[p], i, b) / double(passes.size());
            total[i] = static_cast<float>(direct[i] + (sets[0] + sets[1]) / 2);
            variance[i] = static_cast<float>((sets[0] - sets[1]) * (sets[0] - sets[1]) / 4);
        }
    });
    double area = 0, flux = 0;
    for (std::uint32_t i = 0; i < n; ++i) area += weight[i], flux += double(weight[i]) * total[i];
    if (!(flux > 0)) return 0;
    const double dark = 0.02 * flux / area;
    double sum = 0, counted = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        if (weight[i] <= 0 || total[i] < dark) continue;
        sum += double(weight[i]) * variance[i] / (double(total[i]) * total[i]);
        counted += weight[i];
    }
    return counted > 0 ? std::sqrt(sum / counted) : 0;
}

double grey_ray_error(std::span<const GatherPass> passes, std::span<const float> direct, std::span<const float> weight) {
    const std::uint32_t n = static_cast<std::uint32_t>(direct.size());
    std::vector<float> b(n + 1, 0), next(n + 1, 0);
    for (std::uint32_t i = 0; i < n; ++i) b[i] = grey * direct[i];
    for (int sweep = 0; sweep < grey_sweeps; ++sweep) {
        tbb::parallel_for(Range(0, n, 256), [&](const Range& range) {
            for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
                double h = 0;
                for (const GatherPass& pass : passes) h += pass_mean(pass, i, b);
                next[i] = grey * (direct[i] + static_cast<float>(h / double(passes.size())));
            }
        });
        std::swap(b, next);
    }
    return ray_error(passes, std::span(b).first(n), direct, weight);
}

} // namespace lueur
