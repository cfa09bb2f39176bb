#include "core/spectrum/colour_temperature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/spectrum/observer.h"

namespace lueur {

namespace {

Uv1960 planckian_uv(double mired) {
    return uv1960_from_xyz(planckian_xyz(1e6 / mired));
}

double squared_distance(const Uv1960& a, const Uv1960& b) {
    return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v);
}

// The locus is nearly evenly spaced in mired (1e6 / K). The ends reach a step beyond 1000 and 25000 K, so that a colour
// nearest to a point outside is seen as such.
constexpr double mired_step = 4;
constexpr int locus_points = 244;
constexpr double mired_at(int i) {
    return 36 + mired_step * i;
}
static_assert(mired_at(0) < 1e6 / most_colour_temperature &&
              mired_at(locus_points - 1) > 1e6 / least_colour_temperature);

const std::array<Uv1960, locus_points>& locus() {
    static const auto points = [] {
        std::array<Uv1960, locus_points> uv;
        for (int i = 0; i < locus_points; ++i) uv[static_cast<std::size_t>(i)] = planckian_uv(mired_at(i));
        return uv;
    }();
    return points;
}

struct DaylightRow {
    double s0, s1, s2;
};
constexpr DaylightRow daylight_basis[] = {
#include "core/spectrum/daylight_basis_table.inc"
};

} // namespace

Xyz planckian_xyz(double kelvin) {
    static const auto weights = [] { // lambda^-5 times the observer
        std::array<Xyz, observer_last_nm - observer_first_nm + 1> each;
        for (int nm = observer_first_nm; nm <= observer_last_nm; ++nm)
            each[static_cast<std::size_t>(nm - observer_first_nm)] = std::pow(500.0 / nm, 5) * observer_xyz(nm);
        return each;
    }();
    // Relative to the exponential at its largest, so that no cold body underflows to black.
    const double x_last = second_radiation_constant / (observer_last_nm * kelvin);
    Xyz sum(0);
    for (int nm = observer_first_nm; nm <= observer_last_nm; ++nm) {
        const double x = second_radiation_constant / (nm * kelvin);
        sum += std::exp(x_last - x) / -std::expm1(-x) * weights[static_cast<std::size_t>(nm - observer_first_nm)];
    }
    return sum / sum.y;
}

std::optional<ColourTemperature> colour_temperature(const Xyz& xyz) {
    if (!(xyz.x + 15 * xyz.y + 3 * xyz.z > 0)) return {};
    const Uv1960 uv = uv1960_from_xyz(xyz);
    const auto distance = [&](const Uv1960& point) { return squared_distance(uv, point); };
    const auto nearest = std::ranges::min_element(locus(), {}, distance) - locus().begin();
    if (distance(locus()[static_cast<std::size_t>(nearest)]) > 1.1 * most_duv * most_duv) return {};
    if (nearest == 0 || nearest == locus_points - 1) return {};

    // Golden section between the neighbours, on the exact locus.
    double low = mired_at(static_cast<int>(nearest) - 1), high = mired_at(static_cast<int>(nearest) + 1);
    constexpr double section = 1 / std::numbers::phi;
    double a = high - section * (high - low), b = low + section * (high - low);
    double at_a = distance(planckian_uv(a)), at_b = distance(planckian_uv(b));
    while (high - low > 1e-5) {
        if (at_a < at_b) {
            high = b, b = a, at_b = at_a;
            a = high - section * (high - low), at_a = distance(planckian_uv(a));
        } else {
            low = a, a = b, at_a = at_b;
            b = low + section * (high - low), at_b = distance(planckian_uv(b));
        }
    }
    const double mired = (low + high) / 2;
    const ColourTemperature found{1e6 / mired, 0};
    if (found.kelvin < least_colour_temperature || found.kelvin > most_colour_temperature) return {};

    // Which side: the locus runs to redder light with growing mired, the green side is to its left.
    const Uv1960 from = planckian_uv(mired - 0.5), to = planckian_uv(mired + 0.5), here = planckian_uv(mired);
    const double side = (to.u - from.u) * (uv.v - here.v) - (to.v - from.v) * (uv.u - here.u);
    const double duv = std::copysign(std::sqrt(distance(here)), side);
    if (std::abs(duv) > most_duv) return {};
    return ColourTemperature{found.kelvin, duv};
}

Chromaticity daylight_chromaticity(double kelvin) {
    const double T = std::clamp(kelvin, least_daylight_temperature, most_daylight_temperature);
    const double t = 1e3 / T;
    const double x = T <= 7000 ? ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
                               : ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040;
    return {x, (-3.000 * x + 2.870) * x - 0.275};
}

Spectrum daylight(double kelvin) {
    const auto [x, y] = daylight_chromaticity(kelvin);
    // CIE 15:2018 rounds the two factors to three decimals before use, and the published illuminants are made so.
    const auto rounded = [](double value) { return std::round(value * 1000) / 1000; };
    const double M = 0.0241 + 0.2562 * x - 0.7341 * y;
    const double M1 = rounded((-1.3515 - 1.7703 * x + 5.9114 * y) / M);
    const double M2 = rounded((0.0300 - 31.4424 * x + 30.0717 * y) / M);
    Spectrum spectrum;
    for (const auto& [s0, s1, s2] : daylight_basis) {
        spectrum.nm.push_back(300 + 5 * static_cast<double>(spectrum.nm.size()));
        spectrum.value.push_back(std::max(s0 + M1 * s1 + M2 * s2, 0.0));
    }
    return spectrum;
}

} // namespace lueur
