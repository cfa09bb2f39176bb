// Exact integrals of products of piecewise linear functions: cut at every breakpoint, Gauss's rule of two points in
// between (exact to cubics). It looks only inside the intervals, so a function may jump at a breakpoint.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <span>
#include <vector>

namespace lueur {

// from, to, and all grid points strictly between them, increasing. Empty when to <= from.
inline std::vector<double> breakpoints(double from, double to, std::initializer_list<std::span<const double>> grids) {
    if (!(from < to)) return {};
    std::vector<double> points{from, to};
    for (const std::span<const double> grid : grids) {
        const auto first = std::upper_bound(grid.begin(), grid.end(), from);
        const auto last = std::lower_bound(first, grid.end(), to);
        points.insert(points.end(), first, last);
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

// Integral of f over [points.front(), points.back()], exact when f is a polynomial of degree 3 or less between
// neighbours. Value is double or a vector of doubles.
template <typename Value, typename Function>
Value integrate(std::span<const double> points, Function f) {
    Value sum{0};
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double a = points[i - 1], b = points[i];
        const double middle = a + (b - a) / 2, aside = (b - a) * 0.28867513459481288225; // 1 / (2 sqrt 3)
        sum += (b - a) / 2 * (f(middle - aside) + f(middle + aside));
    }
    return sum;
}

} // namespace lueur
