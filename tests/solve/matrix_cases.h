// Matrices with known solutions, for tests of the solvers on them.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/solve/form_factor_matrix.h"
#include "core/solve/matrix_system.h"

namespace lueur::test {

inline FormFactorMatrix matrix_of(std::vector<float> area, const std::vector<std::vector<double>>& rows) {
    FormFactorMatrix matrix = *make_form_factor_matrix(std::move(area), 1u << 30);
    for (std::uint32_t i = 0; i < matrix.n; ++i)
        for (std::uint32_t j = 0; j < matrix.n; ++j) matrix.row(i)[j] = static_cast<float>(rows[i][j]);
    return matrix;
}

// Unit cube, one patch a face: floor, ceiling, left, right, front, back. Form factors of directly opposed and of
// adjacent unit squares (Howell, catalogue of configuration factors, C-11 and C-14), 1 = F_opposite + 4 F_adjacent.
inline FormFactorMatrix cube() {
    constexpr double opposite = 0.19982489569838738, adjacent = 0.20004377607540316;
    std::vector<std::vector<double>> rows(6, std::vector<double>(6, adjacent));
    for (int i = 0; i < 6; ++i) rows[i][i] = 0, rows[i][i ^ 1] = opposite;
    return matrix_of(std::vector<float>(6, 1.0f), rows);
}

// Patches of very different areas in a closed, reciprocal enclosure, as on a sphere: F_ij = A_j / A, but with half of
// the pairs that do not see each other, and balanced again (Sinkhorn) so that every row sums to 1.
inline FormFactorMatrix enclosure(std::uint32_t n, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<float> area(n);
    for (float& a : area) a = static_cast<float>(std::exp(std::uniform_real_distribution<double>(-1, 1)(random)));
    std::vector<std::vector<double>> s(n, std::vector<double>(n, 0.0)); // A_i F_ij
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < i; ++j)
            if (std::uniform_int_distribution<int>(0, 1)(random)) s[i][j] = s[j][i] = double(area[i]) * area[j];
    for (int round = 0; round < 400; ++round) {
        std::vector<double> factor(n);
        for (std::uint32_t i = 0; i < n; ++i) {
            double sum = 0;
            for (const double f : s[i]) sum += f;
            factor[i] = std::sqrt(area[i] / sum);
        }
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = 0; j < n; ++j) s[i][j] *= factor[i] * factor[j];
    }
    for (std::uint32_t i = 0; i < n; ++i)
        for (double& f : s[i]) f /= area[i];
    return matrix_of(area, s);
}

inline PatchField field_of(const std::vector<std::vector<double>>& channels) { // [channel][patch]
    PatchField field(static_cast<std::uint32_t>(channels[0].size()), static_cast<int>(channels.size()));
    for (std::size_t c = 0; c < channels.size(); ++c)
        for (std::uint32_t i = 0; i < field.count; ++i) field[i][c] = channels[c][i];
    return field;
}

enum class Method { jacobi, gauss_seidel, shooting, overshooting };
inline constexpr Method all_methods[] = {Method::jacobi, Method::gauss_seidel, Method::shooting, Method::overshooting};
inline std::string name(Method method) {
    switch (method) {
    case Method::jacobi:
        return "Jacobi";
    case Method::gauss_seidel:
        return "Gauss-Seidel";
    case Method::shooting:
        return "shooting";
    case Method::overshooting:
        return "overshooting";
    }
    return {};
}

inline bool one_step(MatrixSystem& system, Method method) {
    const std::atomic<bool> never{false};
    switch (method) {
    case Method::jacobi:
        while (!system.jacobi_sweep(never)) {
        }
        return true;
    case Method::gauss_seidel:
        while (!system.gauss_seidel_sweep(never)) {
        }
        return true;
    case Method::shooting:
        return system.shoot(false);
    case Method::overshooting:
        return system.shoot(true);
    }
    return false;
}

inline MatrixSystem system_of(const FormFactorMatrix& matrix, PatchField rho, PatchField exitance, int channels) {
    MatrixSystem system(matrix, channels, std::vector<float>(static_cast<std::size_t>(channels), 1.0f));
    system.set_sources(std::move(rho), std::move(exitance));
    return system;
}

// Steps that it took; -1: more than `most`.
inline int converge(MatrixSystem& system, Method method, double unshot_share, int most) {
    for (int steps = 1; steps <= most; ++steps) {
        const bool more = one_step(system, method);
        if (!more ||
            ((method != Method::gauss_seidel || system.residual_known()) && system.unshot_share() <= unshot_share)) {
            system.refresh();
            return steps;
        }
    }
    return -1;
}

// B - E - rho F B, largest of all patches, in double, against the largest E.
inline double residual_of(const FormFactorMatrix& f, const PatchField& b, const PatchField& rho, const PatchField& e,
                          int channels) {
    double worst = 0, source = 0;
    for (std::uint32_t i = 0; i < f.n; ++i)
        for (int c = 0; c < channels; ++c) {
            double h = 0;
            for (std::uint32_t j = 0; j < f.n; ++j) h += double(f.row(i)[j]) * b[j][c];
            worst = std::max(worst, std::abs(b[i][c] - e[i][c] - rho[i][c] * h));
            source = std::max(source, e[i][c]);
        }
    return worst / source;
}

// B of (I - rho F) B = E by elimination: rows are dominated by their diagonal where rho row_sum < 1, so that no pivot
// is looked for (Golub & Van Loan, Matrix computations, 3.4.10).
inline PatchField eliminated(const FormFactorMatrix& f, const PatchField& rho, const PatchField& e, int channels) {
    PatchField b = e;
    for (int c = 0; c < channels; ++c) {
        std::vector<std::vector<double>> a(f.n, std::vector<double>(f.n + 1));
        for (std::uint32_t i = 0; i < f.n; ++i) {
            for (std::uint32_t j = 0; j < f.n; ++j) a[i][j] = (i == j) - rho[i][c] * double(f.row(i)[j]);
            a[i][f.n] = e[i][c];
        }
        for (std::uint32_t k = 0; k < f.n; ++k)
            for (std::uint32_t i = k + 1; i < f.n; ++i) {
                const double times = a[i][k] / a[k][k];
                for (std::uint32_t j = k; j <= f.n; ++j) a[i][j] -= times * a[k][j];
            }
        for (std::uint32_t i = f.n; i-- > 0;) {
            for (std::uint32_t j = i + 1; j < f.n; ++j) a[i][f.n] -= a[i][j] * b[j][c];
            b[i][c] = a[i][f.n] / a[i][i];
        }
    }
    return b;
}

} // namespace lueur::test
