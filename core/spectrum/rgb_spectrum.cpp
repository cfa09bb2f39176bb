#include "core/spectrum/rgb_spectrum.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/spectrum/colour.h"
#include "core/spectrum/observer.h"
#include "core/spectrum/quadrature.h"

namespace lueur {

namespace {

constexpr int first_nm = 380, last_nm = 780, step_nm = 5;
constexpr int node_count = (last_nm - first_nm) / step_nm + 1;

constexpr double d65_table[] = {
#include "core/spectrum/illuminant_d65_table.inc"
};

// What a reflectance given at the nodes shows under D65: rgb = sum_i weight[i] * reflectance[i], exact for the
// piecewise linear spectrum. Divided by the perfect reflector's, so that white is (1,1,1): the table's white point
// (0.31272, 0.32903) and the rounded one of sRGB (0.3127, 0.3290) differ in the fifth digit.
using NodeWeights = std::array<Eigen::Vector3d, node_count>;

const NodeWeights& node_weights() {
    static const NodeWeights weights = [] {
        const Spectrum& d65 = illuminant_d65();
        const glm::dmat3 rgb_from = rgb_from_xyz(srgb);
        std::vector<double> observer_grid;
        for (int nm = observer_first_nm; nm <= observer_last_nm; ++nm) observer_grid.push_back(nm);
        std::array<Rgb, node_count> raw;
        Rgb white(0);
        for (int i = 0; i < node_count; ++i) {
            // The node's hat; the end nodes hold to the end of the observer (Outside::constant).
            const double nm = first_nm + i * step_nm;
            Spectrum hat{{nm - step_nm, nm, nm + step_nm}, {0, 1, 0}};
            if (i == 0) hat = {{observer_first_nm, nm, nm + step_nm}, {1, 1, 0}};
            if (i == node_count - 1) hat = {{nm - step_nm, nm}, {0, 1}}; // D65 ends here too
            const std::vector<double> points =
                breakpoints(hat.nm.front(), hat.nm.back(), {hat.nm, d65.nm, observer_grid});
            raw[static_cast<std::size_t>(i)] =
                rgb_from * integrate<Xyz>(points, [&](double at) {
                    return value_at(hat, at, Outside::zero) * value_at(d65, at, Outside::zero) * observer_xyz(at);
                });
            white += raw[static_cast<std::size_t>(i)];
        }
        NodeWeights normalised;
        for (std::size_t i = 0; i < raw.size(); ++i) {
            const Rgb w = raw[i] / white;
            normalised[i] = {w.r, w.g, w.b};
        }
        return normalised;
    }();
    return weights;
}

// Jakob & Hanika 2019, eq. 2: S(x) = 1/2 + x / (2 sqrt(1 + x^2)), and its derivative.
double sigmoid(double x) {
    return 0.5 + 0.5 * x / std::sqrt(1 + x * x);
}
double sigmoid_derivative(double x) {
    const double h = std::sqrt(1 + x * x);
    return 0.5 / (h * h * h);
}

// Powers of the node's wavelength mapped to -1..1, so that the three coefficients are of one size.
Eigen::Vector3d basis(int node) {
    const double t = 2.0 * node / (node_count - 1) - 1;
    return {1, t, t * t};
}

struct Fit {
    Eigen::Vector3d coefficients;
    Eigen::Vector3d residual; // RGB of the spectrum minus the wanted one
    Eigen::Matrix3d jacobian; // of the residual
};

Fit evaluate(const Eigen::Vector3d& coefficients, const Eigen::Vector3d& wanted) {
    Fit fit{coefficients, -wanted, Eigen::Matrix3d::Zero()};
    for (int i = 0; i < node_count; ++i) {
        const Eigen::Vector3d powers = basis(i);
        const double x = coefficients.dot(powers);
        const Eigen::Vector3d& weight = node_weights()[static_cast<std::size_t>(i)];
        fit.residual += weight * sigmoid(x);
        fit.jacobian += sigmoid_derivative(x) * weight * powers.transpose();
    }
    return fit;
}

constexpr double small_residual = 1e-10; // of linear RGB

// Gauss-Newton with Levenberg and Marquardt's damping: near the corners of the RGB cube the sigmoid saturates and an
// undamped step would run away.
Fit fit_colour(const Eigen::Vector3d& coefficients, const Eigen::Vector3d& wanted, int iterations) {
    Fit best = evaluate(coefficients, wanted);
    double damping = 1e-6;
    for (int i = 0; i < iterations && best.residual.norm() > small_residual; ++i) {
        const Eigen::Matrix3d normal = best.jacobian.transpose() * best.jacobian;
        // Marquardt's scaling by the diagonal, in relative terms: the damped steps follow the sigmoid however flat it
        // has become.
        const Eigen::Vector3d diagonal = normal.diagonal().cwiseMax(1e-30);
        const Eigen::Matrix3d damped = normal + damping * Eigen::Matrix3d(diagonal.asDiagonal());
        const Eigen::Vector3d step = damped.ldlt().solve(best.jacobian.transpose() * best.residual);
        const Eigen::Vector3d next = best.coefficients - step;
        if (!next.allFinite()) {
            damping = std::max(damping * 10, 1e-6);
            continue;
        }
        Fit candidate = evaluate(next, wanted);
        if (candidate.residual.norm() < best.residual.norm()) {
            best = candidate;
            damping = std::max(damping / 10, 1e-14);
        } else {
            damping *= 10;
            if (damping > 1e12) break;
        }
    }
    return best;
}

double flat_coefficient(double grey) {
    return (grey - 0.5) / std::sqrt(grey * (1 - grey));
} // S(x) = grey

} // namespace

Spectrum reflectance_from_rgb(const Rgb& rgb) {
    Rgb bounded;
    for (int c = 0; c < 3; ++c) bounded[c] = rgb[c] > 0 ? std::min(rgb[c], 1.0) : 0.0; // NaN to 0
    Spectrum spectrum;
    for (int nm = first_nm; nm <= last_nm; nm += step_nm) spectrum.nm.push_back(nm);
    if (bounded.r == bounded.g &&
        bounded.g == bounded.b) { // grey is flat, exactly: the sigmoid reaches 0 and 1 at infinity only
        spectrum.value.assign(spectrum.nm.size(), bounded.r);
        return spectrum;
    }
    const Eigen::Vector3d wanted(bounded.r, bounded.g, bounded.b);
    const Eigen::Vector3d grey = Eigen::Vector3d::Constant(std::clamp(wanted.mean(), 0.05, 0.95));
    const Eigen::Vector3d flat(flat_coefficient(grey[0]), 0, 0);
    Fit fit = fit_colour(flat, wanted, 30);
    if (fit.residual.norm() > small_residual) {
        // A saturated colour: walk to it from the grey, each fit starting from the one before (as in the authors' own
        // code).
        fit.coefficients = flat;
        constexpr int stations = 10;
        for (int i = 1; i <= stations; ++i) {
            const double way = static_cast<double>(i) / stations;
            fit = fit_colour(fit.coefficients, grey + way * (wanted - grey), i == stations ? 200 : 20);
        }
    }
    for (int i = 0; i < node_count; ++i)
        spectrum.value.push_back(std::clamp(sigmoid(fit.coefficients.dot(basis(i))), 0.0, 1.0));
    return spectrum;
}

const Spectrum& illuminant_d65() {
    static const Spectrum d65 = [] {
        Spectrum spectrum;
        for (const double power : d65_table) {
            spectrum.nm.push_back(300.0 + 5.0 * static_cast<double>(spectrum.nm.size()));
            spectrum.value.push_back(power);
        }
        return spectrum;
    }();
    return d65;
}

} // namespace lueur
