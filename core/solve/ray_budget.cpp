#include "core/solve/ray_budget.h"

#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/solve/relative_error.h"

namespace lueur {

namespace {

using Range = tbb::blocked_range<std::uint32_t>;
constexpr float grey = 0.5f;
constexpr int grey_sweeps = 8;    // 0.5^8: far below what the rays can tell
constexpr double of_halves = 0.5; // variance of a single pass, of that which its halves tell (0.3 to 0.8 in the assets)

// Mean over a receiver's rays of a pass. Both fields have one more entry than vertices, 0: the outside.
double pass_mean(const GatherPass& pass, std::uint32_t receiver, const ScalarRadiosity& b) {
    double sum = 0;
    const std::size_t first = std::size_t(receiver) * rays_per_pass;
    for (int k = 0; k < rays_per_pass; ++k)
        sum += b.indirect[pass.ends[first + k]] + b.direct[pass.fine_ends[first + k]];
    return sum / rays_per_pass;
}

// Mean over every other ray.
double half_mean(const GatherPass& pass, std::uint32_t receiver, const ScalarRadiosity& b, int half) {
    double sum = 0;
    const std::size_t first = std::size_t(receiver) * rays_per_pass;
    for (int k = half; k < rays_per_pass; k += 2)
        sum += b.indirect[pass.ends[first + k]] + b.direct[pass.fine_ends[first + k]];
    return 2 * sum / rays_per_pass;
}

} // namespace

std::vector<float> SmoothedReceivers::of(const std::vector<float>& at_receivers) const {
    std::vector<float> values;
    values.reserve(of_vertex.size());
    for (const std::uint32_t r : of_vertex) values.push_back(at_receivers[r]);
    smooth(smoothing, values);
    return values;
}

std::vector<float> half_differences(std::span<const GatherPass> passes, const ScalarRadiosity& radiosity) {
    const std::uint32_t n = static_cast<std::uint32_t>(radiosity.indirect.size());
    std::vector<float> difference(n, 0);
    ScalarRadiosity b = radiosity;
    b.indirect.push_back(0);
    b.direct.push_back(0);
    const std::size_t pairs = passes.size() / independent_sets * independent_sets;
    if (passes.empty()) return difference;
    tbb::parallel_for(Range(0, n, 256), [&](const Range& range) {
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
            double sets[independent_sets] = {};
            if (pairs == 0)
                for (int half = 0; half < independent_sets; ++half) sets[half] = half_mean(passes[0], i, b, half);
            for (std::size_t p = 0; p < pairs; ++p)
                sets[p % independent_sets] += independent_sets * pass_mean(passes[p], i, b) / double(pairs);
            difference[i] = static_cast<float>((pairs == 0 ? std::sqrt(of_halves) : 1) * (sets[0] - sets[1]) / 2);
        }
    });
    return difference;
}

double relative_ray_error(std::span<const float> irradiance, std::span<const float> shown_difference,
                          std::span<const float> weight, const SmoothedReceivers& smoothed) {
    double area = 0, flux = 0;
    for (std::size_t i = 0; i < weight.size(); ++i) area += weight[i], flux += double(weight[i]) * irradiance[i];
    if (!(flux > 0)) return 0;
    const double dark = dark_share * flux / area;
    double sum = 0, counted = 0;
    for (std::size_t i = 0; i < weight.size(); ++i) {
        if (weight[i] <= 0 || irradiance[i] < dark) continue;
        const double relative = double(shown_difference[smoothed.vertex[i]]) / irradiance[i];
        sum += double(weight[i]) * relative * relative;
        counted += weight[i];
    }
    return counted > 0 ? std::sqrt(sum / counted) : 0;
}

double grey_ray_error(std::span<const GatherPass> passes, std::span<const float> fine_direct,
                      std::span<const float> weight, const SmoothedReceivers& smoothed) {
    if (passes.size() < independent_sets || passes.size() % independent_sets != 0) return 1;
    const std::uint32_t n = static_cast<std::uint32_t>(weight.size());
    ScalarRadiosity b{std::vector<float>(n + 1, 0), std::vector<float>(fine_direct.begin(), fine_direct.end())};
    for (float& direct : b.direct) direct *= grey;
    b.direct.push_back(0);
    std::vector<float> next(n + 1, 0);
    for (int sweep = 0; sweep < grey_sweeps; ++sweep) {
        tbb::parallel_for(Range(0, n, 256), [&](const Range& range) {
            for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
                double h = 0;
                for (const GatherPass& pass : passes) h += pass_mean(pass, i, b);
                next[i] = grey * static_cast<float>(h / double(passes.size()));
            }
        });
        std::swap(b.indirect, next);
    }
    b.indirect.pop_back();
    b.direct.pop_back();
    std::vector<float> irradiance(n); // of a solution, what arrives is what is reflected over grey
    for (std::uint32_t i = 0; i < n; ++i) irradiance[i] = fine_direct[smoothed.vertex[i]] + b.indirect[i] / grey;
    return relative_ray_error(irradiance, smoothed.of(half_differences(passes, b)), weight, smoothed);
}

} // namespace lueur
