// Gauss-Legendre points and weights on [0, 1].
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace lueur {

inline constexpr int most_gauss_points = 20;

struct GaussPoint {
    long double at, weight;
};

// 1 to most_gauss_points of them, exact for polynomials of degree 2 count - 1. Zeros of the Legendre polynomial by
// Newton's method from Tricomi's estimate.
inline const std::vector<GaussPoint>& gauss_points(int count) {
    static const auto all = [] {
        std::array<std::vector<GaussPoint>, most_gauss_points + 1> tables;
        for (int n = 1; n <= most_gauss_points; ++n)
            for (int k = 0; k < n; ++k) {
                long double x = std::cos(std::numbers::pi_v<long double> * (k + 0.75L) / (n + 0.5L)), slope = 1;
                for (int step = 0; step < 8; ++step) {
                    long double before = 1, value = x;
                    for (int m = 2; m <= n; ++m) {
                        const long double next = ((2 * m - 1) * x * value - (m - 1) * before) / m;
                        before = value;
                        value = next;
                    }
                    slope = n * (x * value - before) / (x * x - 1);
                    x -= value / slope;
                }
                tables[static_cast<std::size_t>(n)].push_back({(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)});
            }
        return tables;
    }();
    return all[static_cast<std::size_t>(count)];
}

} // namespace lueur
