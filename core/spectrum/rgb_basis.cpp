#include "core/spectrum/rgb_basis.h"

#include "core/spectrum/colour.h"
#include "core/spectrum/dense_algebra.h"
#include "core/spectrum/reflectance_nodes.h"
#include "core/spectrum/rgb_spectrum.h"

namespace lueur {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_basis_rounds = 100;

// Linear RGB of each node's hat under D65, scaled so that white is exactly (1, 1, 1): 3 rows. End values go on.
MatrixXd colour_of_nodes() {
    MatrixXd rgb(3, node_count);
    const NodeWeights weights = node_weights(illuminant_d65());
    const glm::dmat3 from_xyz = rgb_from_xyz(srgb);
    for (int k = 0; k < node_count; ++k) {
        const glm::dvec3 seen = from_xyz * weights[static_cast<std::size_t>(k)];
        for (int c = 0; c < 3; ++c) rgb(c, k) = seen[c];
    }
    for (int c = 0; c < 3; ++c) rgb.row(c) /= rgb.row(c).sum();
    return rgb;
}

// min |differences of r, g and b = 1 - r - g|^2 with their colours given and none of the three below 0: a quadratic
// program, solved by guessing which samples lie on their bound and correcting the guess by the signs of the multipliers
// (Hintermüller, Ito & Kunisch 2002, primal-dual active set).
std::array<Spectrum, 3> solve_basis() {
    constexpr int n = node_count, unknowns = 2 * n, bounds = 3 * n, colours = 6;
    MatrixXd smooth = MatrixXd::Zero(n, n);
    for (int i = 0; i + 1 < n; ++i)
        smooth(i, i) += 1, smooth(i + 1, i + 1) += 1, smooth(i, i + 1) -= 1, smooth(i + 1, i) -= 1;
    MatrixXd hessian(unknowns, unknowns);
    hessian << 2 * smooth, smooth, smooth, 2 * smooth;
    MatrixXd equal = MatrixXd::Zero(colours, unknowns);
    const MatrixXd rgb = colour_of_nodes();
    equal.topLeftCorner(3, n) = rgb;
    equal.bottomRightCorner(3, n) = rgb;
    VectorXd wanted = VectorXd::Zero(colours);
    wanted[0] = wanted[4] = 1; // red of r, green of g
    // Bounds as G x >= h: r >= 0, g >= 0, -r - g >= -1.
    MatrixXd bound = MatrixXd::Zero(bounds, unknowns);
    bound.topRows(unknowns).setIdentity();
    bound.bottomLeftCorner(n, n) = -MatrixXd::Identity(n, n);
    bound.bottomRightCorner(n, n) = -MatrixXd::Identity(n, n);
    VectorXd limit = VectorXd::Zero(bounds);
    limit.tail(n).setConstant(-1);

    std::vector<bool> active(bounds, false);
    VectorXd x = VectorXd::Zero(unknowns);
    for (int round = 0; round < most_basis_rounds; ++round) {
        std::vector<int> rows;
        for (int i = 0; i < bounds; ++i)
            if (active[static_cast<std::size_t>(i)]) rows.push_back(i);
        const Eigen::Index on = static_cast<Eigen::Index>(rows.size()), size = unknowns + colours + on;
        MatrixXd matrix = MatrixXd::Zero(size, size);
        VectorXd right = VectorXd::Zero(size);
        matrix.topLeftCorner(unknowns, unknowns) = hessian;
        matrix.block(unknowns, 0, colours, unknowns) = equal;
        right.segment(unknowns, colours) = wanted;
        for (Eigen::Index k = 0; k < on; ++k) {
            matrix.row(unknowns + colours + k).head(unknowns) = bound.row(rows[static_cast<std::size_t>(k)]);
            right[unknowns + colours + k] = limit[rows[static_cast<std::size_t>(k)]];
        }
        matrix.rightCols(colours + on) = matrix.bottomRows(colours + on).transpose();
        matrix.bottomRightCorner(colours + on, colours + on).setZero();
        const VectorXd solution = solve_linear(matrix, right);
        x = solution.head(unknowns);
        const VectorXd slack = bound * x - limit;
        VectorXd push = VectorXd::Zero(bounds); // multipliers, positive where the bound holds x up
        for (Eigen::Index k = 0; k < on; ++k)
            push[rows[static_cast<std::size_t>(k)]] = -solution[unknowns + colours + k];
        bool changed = false;
        for (int i = 0; i < bounds; ++i) {
            const bool next = push[i] - slack[i] > 1e-12;
            changed = changed || next != active[static_cast<std::size_t>(i)];
            active[static_cast<std::size_t>(i)] = next;
        }
        if (!changed) break;
    }
    std::array<Spectrum, 3> basis;
    for (int i = 0; i < n; ++i) {
        const double r = std::clamp(x[i], 0.0, 1.0), g = std::clamp(x[n + i], 0.0, 1.0 - r);
        const double values[3] = {r, g, 1 - r - g};
        for (std::size_t c = 0; c < 3; ++c) {
            basis[c].nm.push_back(node_nm(i));
            basis[c].value.push_back(values[c]);
        }
    }
    return basis;
}

} // namespace

const std::array<Spectrum, 3>& rgb_reflectance_basis() {
    static const std::array<Spectrum, 3> basis = solve_basis();
    return basis;
}

Spectrum reflectance_from_texel(const Rgb& rgb) {
    const auto& basis = rgb_reflectance_basis();
    Spectrum reflectance = basis[0];
    for (std::size_t i = 0; i < reflectance.value.size(); ++i)
        reflectance.value[i] = rgb.r * basis[0].value[i] + rgb.g * basis[1].value[i] + rgb.b * basis[2].value[i];
    return reflectance;
}

std::array<std::vector<double>, 3> basis_channels(const Wavelengths& wavelengths) {
    std::array<std::vector<double>, 3> channels;
    for (std::size_t c = 0; c < 3; ++c) {
        if (wavelengths.spec.rule == WavelengthRule::rgb) {
            channels[c].assign(3, 0);
            channels[c][c] = 1;
        } else
            channels[c] = reflectance_channels(wavelengths, rgb_reflectance_basis()[c]);
    }
    return channels;
}

} // namespace lueur
