#include "core/display/false_colour.h"

#include <algorithm>
#include <cmath>

#include "core/display/display_fields.h"

namespace lueur {

namespace {

double decade(double value) { // the power of ten at or below it
    return std::pow(10.0, std::floor(std::log10(value) + 1e-9));
}

double round_down(double value) {
    const double base = decade(value), digits = value / base * (1 + 1e-9);
    return base * (digits >= 5 ? 5 : digits >= 2 ? 2 : 1);
}

double round_up(double value) {
    const double base = decade(value), digits = value / base * (1 - 1e-9);
    return base * (digits <= 1 ? 1 : digits <= 2 ? 2 : digits <= 5 ? 5 : 10);
}

// Logarithmic, of a quantity whose scale is the same for all scenes.
FalseColourSettings fixed_scale(double low, double high) {
    FalseColourSettings scale;
    scale.automatic = false;
    scale.low = low;
    scale.high = high;
    scale.levels = {1, 2, 5, 10};
    return scale;
}

double luma(const glm::vec3& encoded) {
    return glm::dot(glm::dvec3(encoded), glm::dvec3(0.2126, 0.7152, 0.0722));
}

} // namespace

glm::vec3 false_colour(double t) {
    const glm::vec3 c0(0.2777f, 0.0054f, 0.3341f), c1(0.1051f, 1.4046f, 1.3846f), c2(-0.3309f, 0.2148f, 0.0951f),
        c3(-4.6342f, -5.7991f, -19.3324f), c4(6.2283f, 14.1799f, 56.6906f), c5(4.7764f, -13.7451f, -65.3530f),
        c6(-5.4355f, 4.6459f, 26.3124f);
    const auto x = static_cast<float>(t >= 0 ? std::min(t, 1.0) : 0.0); // NaN is 0
    return glm::clamp(c0 + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * (c5 + x * c6))))), 0.0f, 1.0f);
}

double place_on_scale(const FalseColourSettings& scale, double value) {
    if (!(value > 0)) return 0;
    const double place = scale.logarithmic
                             ? (std::log(value) - std::log(scale.low)) / (std::log(scale.high) - std::log(scale.low))
                             : (value - scale.low) / (scale.high - scale.low);
    return std::clamp(place, 0.0, 1.0);
}

std::vector<double> scale_ticks(const FalseColourSettings& scale, std::size_t most) {
    std::vector<double> ticks;
    const double low = scale.low * (1 - 1e-6), high = scale.high * (1 + 1e-6);
    if (!(scale.low > 0 && scale.low < scale.high) || !std::isfinite(scale.high)) return ticks;
    if (scale.logarithmic) {
        const int first = static_cast<int>(std::floor(std::log10(low))), last = static_cast<int>(std::log10(high)) + 1;
        const auto decades = [&](std::initializer_list<int> digits, int step) {
            ticks.clear();
            for (int power = first; power <= last; power += step)
                for (const int digit : digits) {
                    const double tick = power >= 0 ? digit * std::pow(10.0, power) : digit / std::pow(10.0, -power);
                    if (tick >= low && tick <= high) ticks.push_back(tick);
                }
            return ticks.size() <= most;
        };
        if (decades({1, 2, 5}, 1)) {
            if (ticks.size() >= 3) return ticks;
        } else {
            for (int step = 1; !decades({1}, step); ++step) {
            }
            if (ticks.size() >= 2) return ticks;
        }
    }
    // Even steps of 1, 2 or 5 times a power of ten: a linear scale, or less than a decade.
    ticks.clear();
    double step = round_up((scale.high - scale.low) / static_cast<double>(most));
    while (std::floor(high / step) - std::ceil(low / step) + 1 > static_cast<double>(most))
        step = round_up(step * 1.01);
    const double from = std::ceil(low / step);
    for (std::size_t i = 0; i <= most; ++i) {
        const double tick = (from + static_cast<double>(i)) * step;
        if (tick > high) break;
        if (tick > 0 || !scale.logarithmic) ticks.push_back(tick);
    }
    return ticks;
}

FalseColourSettings fitted(FalseColourSettings scale, std::span<const float> values, std::span<const float> weights) {
    if (!scale.automatic) return scale;
    // A histogram over the logarithm, 40 bins a doubling: exact enough for ends that are rounded to 1, 2 and 5.
    constexpr int bins_a_doubling = 40, lowest = -40, doublings = 90;
    std::vector<double> histogram(bins_a_doubling * doublings);
    double total = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(std::isfinite(values[i]) && values[i] > 0)) continue;
        const double weight = i < weights.size() ? static_cast<double>(weights[i]) : 1.0;
        if (!(weight > 0)) continue;
        const int bin = static_cast<int>(std::floor((std::log2(values[i]) - lowest) * bins_a_doubling));
        histogram[static_cast<std::size_t>(std::clamp(bin, 0, bins_a_doubling * doublings - 1))] += weight;
        total += weight;
    }
    if (total == 0) return scale;
    const auto at_share = [&](double share) {
        double below = 0;
        std::size_t bin = 0;
        while (bin + 1 < histogram.size() && below + histogram[bin] < share * total) below += histogram[bin++];
        return std::exp2(lowest + (static_cast<double>(bin) + 0.5) / bins_a_doubling);
    };
    constexpr double least = allowed_scale_end.low, widest = 1e3; // of a logarithmic scale, high / low
    const double top = std::clamp(at_share(0.99), 10 * least, 0.1 * allowed_scale_end.high);
    scale.high = round_up(top);
    if (scale.logarithmic)
        scale.low = round_down(std::clamp(at_share(0.02), std::max(least, scale.high / widest), 0.5 * scale.high));
    else
        scale.low = std::max(least, 1e-4 * scale.high);
    return scale;
}

std::vector<double> isoline_levels(const FalseColourSettings& scale) {
    if (!scale.isolines) return {};
    return scale.levels.empty() ? scale_ticks(scale) : scale.levels;
}

const FalseColourSettings& colour_difference_scale() {
    static const FalseColourSettings scale = fixed_scale(0.2, 20);
    return scale;
}

const FalseColourSettings& error_scale() {
    static const FalseColourSettings scale = fixed_scale(0.1, 100);
    return scale;
}

double isoline_strength(std::span<const double> levels, double value, const Neighbours& near, double width) {
    if (!(value > 0)) return 0;
    const auto slope = [&](double before, double after) { // of one axis, a pixel
        const bool first = before > 0, second = after > 0;
        const double a = std::abs(value - before), b = std::abs(after - value);
        return first && second ? std::min(a, b) : first ? a : second ? b : 0.0;
    };
    const double gradient = std::hypot(slope(near.left, near.right), slope(near.above, near.below));
    double strength = 0;
    for (const double level : levels) {
        const double pixels = std::abs(value - level) / std::max(gradient, 1e-5 * level);
        strength = std::max(strength, std::clamp(0.5 * width + 0.5 - pixels, 0.0, 1.0));
    }
    return strength;
}

glm::vec3 with_isoline(const glm::vec3& colour, double strength) {
    const glm::vec3 line = luma(colour) > 0.5 ? glm::vec3(0) : glm::vec3(1);
    return glm::mix(colour, line, static_cast<float>(strength));
}

} // namespace lueur
