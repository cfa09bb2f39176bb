#include "core/spectrum/operations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/spectrum/quadrature.h"

namespace lueur {

namespace {

// A spectrum's straight line over an interval: its values at the two ends, seen from inside.
struct Ends {
    double from = 0, to = 0;
};

// Over [from, to], which must hold no point of its grid but at its ends.
Ends ends_over(const Spectrum& spectrum, double from, double to, Outside outside) {
    if (from < first_nm(spectrum) || from >= last_nm(spectrum)) {
        const double value = value_at(spectrum, from < first_nm(spectrum) ? from : to, outside);
        return {value, value};
    }
    if (spectrum.interpolation == Interpolation::bin) {
        const double value = value_at(spectrum, from, outside);
        return {value, value};
    }
    const auto above = std::upper_bound(spectrum.nm.begin(), spectrum.nm.end(), from);
    const auto i = static_cast<std::size_t>(above - spectrum.nm.begin()); // first <= from < last: 1 or more
    const double x0 = spectrum.nm[i - 1], width = spectrum.nm[i] - x0;
    const double y0 = spectrum.value[i - 1], y1 = spectrum.value[i];
    return {std::lerp(y0, y1, (from - x0) / width), std::lerp(y0, y1, (to - x0) / width)};
}

// Collects samples; one at the wavelength of the last but with another value is a jump.
struct Samples {
    Spectrum spectrum;

    void add(double nm, double value) {
        if (!spectrum.nm.empty() && nm <= spectrum.nm.back()) {
            if (value == spectrum.value.back()) return;
            nm = std::nextafter(spectrum.nm.back(), std::numeric_limits<double>::infinity());
        }
        spectrum.nm.push_back(nm);
        spectrum.value.push_back(value);
    }
};

std::vector<double> union_grid(const Spectrum& a, const Spectrum& b, double from, double to) {
    return breakpoints(from, to, {grid(a), grid(b)});
}

} // namespace

Spectrum scaled(const Spectrum& spectrum, double factor) {
    Spectrum result = spectrum;
    for (double& value : result.value) value *= factor;
    return result;
}

Spectrum piecewise_linear(const Spectrum& spectrum) {
    if (spectrum.interpolation == Interpolation::linear) return spectrum;
    Samples samples;
    const std::vector<double> edges = grid(spectrum);
    for (std::size_t i = 0; i < spectrum.value.size(); ++i) {
        samples.add(edges[i], spectrum.value[i]);
        samples.add(edges[i + 1], spectrum.value[i]);
    }
    return std::move(samples.spectrum);
}

Spectrum sum(const Spectrum& a, const Spectrum& b, Outside outside) {
    if (a.nm.empty()) return b;
    if (b.nm.empty()) return a;
    if (a.nm == b.nm && a.interpolation == b.interpolation) {
        Spectrum result = a;
        for (std::size_t i = 0; i < b.value.size(); ++i) result.value[i] += b.value[i];
        return result;
    }
    const double from = std::min(first_nm(a), first_nm(b)), to = std::max(last_nm(a), last_nm(b));
    const std::vector<double> points = union_grid(a, b, from, to);
    Samples samples;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Ends of_a = ends_over(a, points[i - 1], points[i], outside);
        const Ends of_b = ends_over(b, points[i - 1], points[i], outside);
        samples.add(points[i - 1], of_a.from + of_b.from);
        samples.add(points[i], of_a.to + of_b.to);
    }
    return std::move(samples.spectrum);
}

Spectrum product(const Spectrum& a, const Spectrum& b, Outside a_outside, Outside b_outside) {
    if (a.nm.empty() || b.nm.empty()) return {};
    double from = std::min(first_nm(a), first_nm(b)), to = std::max(last_nm(a), last_nm(b));
    if (a_outside == Outside::zero) {
        from = std::max(from, first_nm(a));
        to = std::min(to, last_nm(a));
    }
    if (b_outside == Outside::zero) {
        from = std::max(from, first_nm(b));
        to = std::min(to, last_nm(b));
    }
    const std::vector<double> points = union_grid(a, b, from, to);
    if (points.empty()) return {}; // they do not overlap
    double largest = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Ends of_a = ends_over(a, points[i - 1], points[i], a_outside);
        const Ends of_b = ends_over(b, points[i - 1], points[i], b_outside);
        largest = std::max({largest, std::abs(of_a.from * of_b.from), std::abs(of_a.to * of_b.to)});
    }
    Samples samples;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const Ends of_a = ends_over(a, points[i - 1], points[i], a_outside);
        const Ends of_b = ends_over(b, points[i - 1], points[i], b_outside);
        // A parabola c x^2 is c h^2 / 4 away from its chord over a width of h.
        const double bend = std::abs((of_a.to - of_a.from) * (of_b.to - of_b.from)) / 4;
        const double pieces = largest > 0 ? std::ceil(std::sqrt(std::min(bend / (1e-5 * largest), 1e5))) : 1;
        const int count = std::max(1, static_cast<int>(pieces));
        for (int k = 0; k <= count; ++k) {
            const double t = static_cast<double>(k) / count;
            samples.add(std::lerp(points[i - 1], points[i], t),
                        std::lerp(of_a.from, of_a.to, t) * std::lerp(of_b.from, of_b.to, t));
        }
    }
    return std::move(samples.spectrum);
}

} // namespace lueur
