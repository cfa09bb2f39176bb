#include "core/view/error_statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lueur {

double resolution_of(double reference_error, int points) {
    return points > 0 ? reference_error * std::sqrt(2 * std::sqrt(2.0 / points)) : 1;
}

ErrorStatistics error_statistics(std::span<const Irradiance> values, std::span<const Irradiance> reference) {
    const std::size_t count = std::min(values.size(), reference.size());
    double mean = 0;
    for (std::size_t i = 0; i < count; ++i) mean += reference[i].illuminance_lx / static_cast<double>(count);
    ErrorStatistics result;
    std::vector<double> errors;
    double square = 0, square_of_truth = 0, variance = 0, noise = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double truth = reference[i].illuminance_lx;
        if (!(truth > dark_share * mean)) continue;
        if (!std::isfinite(values[i].illuminance_lx)) {
            ++result.missing;
            continue;
        }
        const double error = relative_error(values[i].illuminance_lx, truth);
        const double of_truth = values[i].illuminance_lx / truth - 1;
        errors.push_back(error);
        square += error * error;
        square_of_truth += of_truth * of_truth;
        const double own = 0.01 * reference[i].standard_error_percent,
                     in_error = own * truth / std::max(truth, values[i].illuminance_lx);
        variance += own * own;
        noise += in_error * in_error;
    }
    result.counted = static_cast<int>(errors.size());
    if (errors.empty()) {
        result.rms = result.rms_of_truth = result.median = result.percentile95 = result.rms_without_noise = 1;
        return result;
    }
    const double n = static_cast<double>(errors.size());
    square /= n;
    variance /= n, noise /= n;
    std::ranges::sort(errors);
    const auto quantile = [&](double share) {
        return errors[std::min(errors.size() - 1, static_cast<std::size_t>(share * n))];
    };
    result.rms = std::sqrt(square);
    result.rms_of_truth = std::sqrt(square_of_truth / n);
    result.median = quantile(0.5);
    result.percentile95 = quantile(0.95);
    result.reference_error = std::sqrt(variance);
    result.resolution = resolution_of(result.reference_error, result.counted);
    result.rms_without_noise = std::max(result.resolution, std::sqrt(std::max(0.0, square - noise)));
    return result;
}

} // namespace lueur
