#include "core/spectrum/rgb_spectrum.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/spectrum/chromatic_adaptation.h"
#include "core/spectrum/colour.h"
#include "core/spectrum/reflectance_nodes.h"

namespace lueur {

namespace {

constexpr double d65_table[] = {
#include "core/spectrum/illuminant_d65_table.inc"
};

// What a reflectance given at the nodes shows under the illuminant to an eye adapted to it: rgb = sum_i weight[i] *
// reflectance[i]. The illuminant's white goes to that of sRGB by Bradford's transform, so that white is (1,1,1).
using RgbWeights = std::array<Eigen::Vector3d, node_count>;

// None where the illuminant has no white to adapt to: no light, or one so pure that a cone's response is not above 0.
std::optional<RgbWeights> rgb_weights(const Spectrum& illuminant) {
    const NodeWeights xyz = node_weights(illuminant);
    Xyz white(0);
    for (const Xyz& weight : xyz) white += weight;
    if (!(white.x > 0 && white.y > 0 && white.z > 0)) return {};
    const glm::dmat3 adapted = bradford_adaptation(white, xyz_from_rgb(srgb) * Rgb(1));
    const glm::dmat3 rgb_from = rgb_from_xyz(srgb) * adapted;
    RgbWeights weights;
    for (std::size_t i = 0; i < xyz.size(); ++i) {
        const Rgb weight = rgb_from * xyz[i];
        weights[i] = {weight.r, weight.g, weight.b};
        if (!weights[i].allFinite()) return {};
    }
    return weights;
}

const RgbWeights& d65_weights() {
    static const RgbWeights weights = *rgb_weights(illuminant_d65());
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

Fit evaluate(const RgbWeights& weights, const Eigen::Vector3d& coefficients, const Eigen::Vector3d& wanted) {
    Fit fit{coefficients, -wanted, Eigen::Matrix3d::Zero()};
    for (int i = 0; i < node_count; ++i) {
        const Eigen::Vector3d powers = basis(i);
        const double x = coefficients.dot(powers);
        const Eigen::Vector3d& weight = weights[static_cast<std::size_t>(i)];
        fit.residual += weight * sigmoid(x);
        fit.jacobian += sigmoid_derivative(x) * weight * powers.transpose();
    }
    return fit;
}

constexpr double small_residual = 1e-10; // of linear RGB

// Gauss-Newton with Levenberg and Marquardt's damping: near the corners of the RGB cube the sigmoid saturates and an
// undamped step would run away.
Fit fit_colour(const RgbWeights& weights, const Eigen::Vector3d& coefficients, const Eigen::Vector3d& wanted,
               int iterations) {
    Fit best = evaluate(weights, coefficients, wanted);
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
        Fit candidate = evaluate(weights, next, wanted);
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

Spectrum fitted_reflectance(const Rgb& rgb, const RgbWeights& weights) {
    Rgb bounded;
    for (int c = 0; c < 3; ++c) bounded[c] = rgb[c] > 0 ? std::min(rgb[c], 1.0) : 0.0; // NaN to 0
    Spectrum spectrum;
    for (int i = 0; i < node_count; ++i) spectrum.nm.push_back(node_nm(i));
    if (bounded.r == bounded.g &&
        bounded.g == bounded.b) { // grey is flat, exactly: the sigmoid reaches 0 and 1 at infinity only
        spectrum.value.assign(spectrum.nm.size(), bounded.r);
        return spectrum;
    }
    const Eigen::Vector3d wanted(bounded.r, bounded.g, bounded.b);
    const Eigen::Vector3d grey = Eigen::Vector3d::Constant(std::clamp(wanted.mean(), 0.05, 0.95));
    const Eigen::Vector3d flat(flat_coefficient(grey[0]), 0, 0);
    Fit fit = fit_colour(weights, flat, wanted, 30);
    if (fit.residual.norm() > small_residual) {
        // A saturated colour: walk to it from the grey, each fit starting from the one before (as in the authors' own
        // code). Where the light cannot show the colour the direct way may have ended nearer to it.
        Fit walked{flat, {}, {}};
        constexpr int stations = 10;
        for (int i = 1; i <= stations; ++i) {
            const double way = static_cast<double>(i) / stations;
            walked = fit_colour(weights, walked.coefficients, grey + way * (wanted - grey), i == stations ? 200 : 20);
        }
        if (walked.residual.norm() > small_residual) fit = fit_colour(weights, fit.coefficients, wanted, 200);
        if (walked.residual.norm() < fit.residual.norm()) fit = walked;
    }
    for (int i = 0; i < node_count; ++i)
        spectrum.value.push_back(std::clamp(sigmoid(fit.coefficients.dot(basis(i))), 0.0, 1.0));
    return spectrum;
}

} // namespace

Spectrum reflectance_from_rgb(const Rgb& rgb) {
    return fitted_reflectance(rgb, d65_weights());
}

Spectrum reflectance_from_rgb(const Rgb& rgb, const Spectrum& illuminant) {
    return fitted_reflectance(rgb, rgb_weights(illuminant).value_or(d65_weights()));
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
