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
    double square = 0, variance = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double truth = reference[i].illuminance_lx;
        if (!(truth > dark_share * mean)) continue;
        if (!std::isfinite(values[i].illuminance_lx)) {
            ++result.missing;
            continue;
        }
        const double error = std::abs(values[i].illuminance_lx / truth - 1);
        errors.push_back(error);
        square += error * error;
        variance += 1e-4 * reference[i].standard_error_percent * reference[i].standard_error_percent;
    }
    result.counted = static_cast<int>(errors.size());
    if (errors.empty()) {
        result.rms = result.median = result.percentile95 = result.rms_without_noise = 1;
        return result;
    }
    const double n = static_cast<double>(errors.size());
    square /= n;
    variance /= n;
    std::ranges::sort(errors);
    const auto quantile = [&](double share) {
        return errors[std::min(errors.size() - 1, static_cast<std::size_t>(share * n))];
    };
    result.rms = std::sqrt(square);
    result.median = quantile(0.5);
    result.percentile95 = quantile(0.95);
    result.reference_error = std::sqrt(variance);
    result.resolution = resolution_of(result.reference_error, result.counted);
    result.rms_without_noise = std::max(result.resolution, std::sqrt(std::max(0.0, square - variance)));
    return result;
}

} // namespace lueur
