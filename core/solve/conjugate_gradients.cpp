#include "core/solve/conjugate_gradients.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/spectrum/wavelengths.h"

namespace lueur {

namespace {

using Sums = std::array<double, max_channels>;
constexpr double most_asymmetry = 1e-5; // of float form factors that are exact but for rounding

template <typename F>
Sums sums_of(std::uint32_t n, int channels, const F& f) {
    Sums sums{};
    for (std::uint32_t i = 0; i < n; ++i)
        for (int c = 0; c < channels; ++c) sums[c] += f(i, c);
    return sums;
}

} // namespace

double reciprocity_error(const FormFactorMatrix& matrix) {
    double worst = 0;
    for (std::uint32_t i = 0; i < matrix.n; ++i)
        for (std::uint32_t j = 0; j < i; ++j) {
            const double a = double(matrix.area[i]) * matrix.row(i)[j], b = double(matrix.area[j]) * matrix.row(j)[i];
            worst = std::max(worst, std::abs(a - b) / std::min(matrix.area[i], matrix.area[j]));
        }
    return worst;
}

std::expected<ConjugateGradients, std::string> conjugate_gradients(const FormFactorMatrix& matrix,
                                                                   const PatchField& rho, const PatchField& exitance,
                                                                   int channels, double tolerance, int most_sweeps,
                                                                   const std::atomic<bool>& cancel) {
    const std::uint32_t n = matrix.n;
    if (const double error = reciprocity_error(matrix); error > most_asymmetry)
        return std::unexpected(fmt::format(
            "conjugate gradients need reciprocal form factors, and A_i F_ij differs from A_j F_ji by {:.2g}", error));
    ConjugateGradients result{exitance, 0, 1};
    PatchField& b = result.radiosity;
    PatchField product(n, channels), r(n, channels), z(n, channels), p(n, channels);
    // F p; false when cancelled.
    const auto apply = [&](const PatchField& x) {
        std::ranges::fill(product.values, 0.0);
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, n, 4 * rows_at_once),
                          [&](const tbb::blocked_range<std::uint32_t>& range) {
                              if (!cancel.load(std::memory_order_relaxed))
                                  multiply_rows(matrix, range.begin(), range.end(), x, product);
                          });
        ++result.sweeps;
        return !cancel.load(std::memory_order_relaxed);
    };
    // B = E at the start, so r = A F E: patches that reflect nothing take no part from here on. Preconditioned by the
    // diagonal A / rho: z = rho / A r is the residual of B = E + rho F B.
    if (!apply(b)) return std::unexpected("cancelled");
    for (std::uint32_t i = 0; i < n; ++i)
        for (int c = 0; c < channels; ++c) {
            r[i][c] = rho[i][c] > 0 ? matrix.area[i] * product[i][c] : 0;
            p[i][c] = z[i][c] = rho[i][c] / matrix.area[i] * r[i][c];
        }
    const Sums source =
        sums_of(n, channels, [&](std::uint32_t i, int c) { return matrix.area[i] * exitance[i][c] * exitance[i][c]; });
    Sums rz = sums_of(n, channels, [&](std::uint32_t i, int c) { return r[i][c] * z[i][c]; });
    while (true) {
        result.residual = 0;
        for (int c = 0; c < channels; ++c)
            if (source[c] > 0) result.residual = std::max(result.residual, std::sqrt(rz[c] / source[c]));
        if (!std::isfinite(result.residual)) return std::unexpected("conjugate gradients lost their way");
        if (result.residual <= tolerance) return result;
        if (result.sweeps >= most_sweeps)
            return std::unexpected(fmt::format("conjugate gradients do not converge within {} sweeps", most_sweeps));
        if (!apply(p)) return std::unexpected("cancelled");
        const auto ap = [&](std::uint32_t i, int c) {
            return rho[i][c] > 0 ? matrix.area[i] * (p[i][c] / rho[i][c] - product[i][c]) : 0.0;
        };
        const Sums pap = sums_of(n, channels, [&](std::uint32_t i, int c) { return p[i][c] * ap(i, c); });
        Sums alpha{};
        for (int c = 0; c < channels; ++c) alpha[c] = pap[c] > 0 ? rz[c] / pap[c] : 0;
        for (std::uint32_t i = 0; i < n; ++i)
            for (int c = 0; c < channels; ++c) {
                b[i][c] += alpha[c] * p[i][c];
                r[i][c] -= alpha[c] * ap(i, c);
                z[i][c] = rho[i][c] / matrix.area[i] * r[i][c];
            }
        const Sums rz_before = rz;
        rz = sums_of(n, channels, [&](std::uint32_t i, int c) { return r[i][c] * z[i][c]; });
        for (std::uint32_t i = 0; i < n; ++i)
            for (int c = 0; c < channels; ++c)
                p[i][c] = z[i][c] + (rz_before[c] > 0 ? rz[c] / rz_before[c] : 0) * p[i][c];
    }
}

} // namespace lueur
