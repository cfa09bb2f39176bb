#include "core/spectrum/point_samples.h"

#include <algorithm>

#include "core/spectrum/dense_algebra.h"
#include "core/spectrum/visible_grid.h"

namespace lueur {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Wavelengths as -1..1, where powers of them are tame.
double scaled(double nm) {
    return (nm - 0.5 * (observer_first_nm + observer_last_nm)) / (0.5 * (observer_last_nm - observer_first_nm));
}

// A weight function summed at whole nanometres, 380..780 nm: the range that gives Meyer's four wavelengths.
template <typename Function>
VectorXd weight_function(Function f) {
    VectorXd weight = VectorXd::Zero(visible_count);
    for (int nm = visible_first_nm; nm <= visible_last_nm; ++nm) weight[nm - observer_first_nm] = f(observer_xyz(nm));
    return weight;
}

// Monic polynomials orthogonal under a weight that may change its sign (Stieltjes' recurrence), at all wavelengths.
struct Orthogonal {
    std::vector<double> alpha, beta;
    double value(int degree, double x) const {
        double before = 0, now = 1;
        for (int i = 0; i < degree; ++i) {
            const double next =
                (x - alpha[static_cast<std::size_t>(i)]) * now - beta[static_cast<std::size_t>(i)] * before;
            before = now, now = next;
        }
        return now;
    }
};
Orthogonal orthogonal_polynomials(const VectorXd& weight, int degree) {
    VectorXd x(visible_count);
    for (int j = 0; j < visible_count; ++j) x[j] = scaled(observer_first_nm + j);
    Orthogonal result;
    VectorXd before = VectorXd::Zero(visible_count), now = VectorXd::Ones(visible_count);
    double norm_before = 1;
    for (int i = 0; i < degree; ++i) {
        const double norm = (weight.array() * now.array().square()).sum();
        result.alpha.push_back((weight.array() * x.array() * now.array().square()).sum() / norm);
        result.beta.push_back(i == 0 ? 0 : norm / norm_before);
        const VectorXd next = ((x.array() - result.alpha.back()) * now.array() - result.beta.back() * before.array());
        before = now, now = next, norm_before = norm;
    }
    return result;
}

// Zeros of the polynomial of the highest degree, nm, increasing: all are real and apart by more than a nanometre. Not
// eigenvalues of the tridiagonal matrix (Golub & Welsch 1969): beta may be negative, and it is then not symmetric.
std::vector<double> gauss_nodes(const Orthogonal& polynomials) {
    constexpr double apart = 0.5; // nm
    const auto value = [&](double nm) {
        return polynomials.value(static_cast<int>(polynomials.alpha.size()), scaled(nm));
    };
    std::vector<double> zeros;
    for (double nm = observer_first_nm; nm < observer_last_nm; nm += apart) {
        double low = nm, high = nm + apart;
        const bool rises = value(low) < 0;
        if (rises == (value(high) < 0)) continue;
        for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
            (rises == (value(middle) < 0) ? low : high) = middle;
        zeros.push_back(low);
    }
    return zeros;
}

// Weights that integrate the polynomials up to nm.size() - 1 exactly under `weight`. `polynomials`: any orthogonal
// ones, as a basis that is well conditioned.
VectorXd interpolatory_weights(const std::vector<double>& nm, const VectorXd& weight, const Orthogonal& polynomials) {
    const int n = static_cast<int>(nm.size());
    MatrixXd values(n, n);
    VectorXd integrals(n);
    for (int degree = 0; degree < n; ++degree) {
        double norm = 0, sum = 0;
        for (int j = 0; j < visible_count; ++j) {
            const double p = polynomials.value(degree, scaled(observer_first_nm + j));
            norm = std::max(norm, std::abs(p));
            sum += weight[j] * p;
        }
        for (int k = 0; k < n; ++k)
            values(degree, k) = polynomials.value(degree, scaled(nm[static_cast<std::size_t>(k)])) / norm;
        integrals[degree] = sum / norm;
    }
    return solve_linear(values, integrals);
}

// Cells of 380..780 nm between the middles of neighbours.
std::vector<double> cell_widths(const std::vector<double>& nm) {
    std::vector<double> width;
    for (std::size_t k = 0; k < nm.size(); ++k) {
        const double from = k == 0 ? visible_first_nm : 0.5 * (nm[k - 1] + nm[k]);
        const double to = k + 1 == nm.size() ? visible_last_nm : 0.5 * (nm[k] + nm[k + 1]);
        width.push_back(to - from);
    }
    return width;
}

// XYZ -> AC1C2: A is achromatic, C1 and C2 the axes along which colours are densest (Meyer 1988).
const glm::dmat3 ac1c2_from_xyz =
    glm::transpose(glm::dmat3(-0.0177, 1.009, 0.0073, -1.537, 1.0821, 0.3209, 0.1946, -0.2045, 0.5264));

struct AxisRule {
    std::vector<double> nm;
    VectorXd weight;
};

} // namespace

PointSamples meyer_samples(int count) {
    const int orders[3] = {count == 10 ? 4 : 3, count == 10 ? 4 : 2, count == 10 ? 2 : 1}; // of A, C1, C2
    AxisRule rules[3];
    for (int axis = 0; axis < 3; ++axis) {
        const VectorXd weight = weight_function([&](const Xyz& xyz) { return (ac1c2_from_xyz * xyz)[axis]; });
        const Orthogonal polynomials = orthogonal_polynomials(weight, orders[axis]);
        rules[axis].nm = gauss_nodes(polynomials);
        rules[axis].weight = interpolatory_weights(rules[axis].nm, weight, polynomials);
    }
    if (count == 4) { // one achromatic evaluation is saved at each of C1's nodes
        rules[0].nm = {rules[1].nm[0], rules[0].nm[1], rules[1].nm[1]};
        const VectorXd achromatic = weight_function([&](const Xyz& xyz) { return (ac1c2_from_xyz * xyz)[0]; });
        rules[0].weight = interpolatory_weights(rules[0].nm, achromatic, orthogonal_polynomials(achromatic, 3));
    }
    PointSamples samples;
    for (const AxisRule& rule : rules) samples.nm.insert(samples.nm.end(), rule.nm.begin(), rule.nm.end());
    std::sort(samples.nm.begin(), samples.nm.end());
    samples.nm.erase(std::unique(samples.nm.begin(), samples.nm.end()), samples.nm.end());
    const glm::dmat3 xyz_from_ac1c2 = glm::inverse(ac1c2_from_xyz);
    for (const double nm : samples.nm) {
        glm::dvec3 ac1c2(0);
        for (int axis = 0; axis < 3; ++axis)
            for (std::size_t k = 0; k < rules[axis].nm.size(); ++k)
                if (rules[axis].nm[k] == nm) ac1c2[axis] += rules[axis].weight[static_cast<Eigen::Index>(k)];
        samples.weight.push_back(xyz_from_ac1c2 * ac1c2);
    }
    samples.width = cell_widths(samples.nm);
    return samples;
}

PointSamples gauss_samples(int count) {
    const Orthogonal polynomials =
        orthogonal_polynomials(weight_function([](const Xyz& xyz) { return xyz.x + xyz.y + xyz.z; }), count);
    PointSamples samples;
    samples.nm = gauss_nodes(polynomials);
    samples.weight.assign(samples.nm.size(), Xyz(0));
    for (int component = 0; component < 3; ++component) {
        const VectorXd weight = interpolatory_weights(
            samples.nm, weight_function([&](const Xyz& xyz) { return xyz[component]; }), polynomials);
        for (std::size_t k = 0; k < samples.nm.size(); ++k)
            samples.weight[k][component] = weight[static_cast<Eigen::Index>(k)];
    }
    samples.width = cell_widths(samples.nm);
    return samples;
}

} // namespace lueur
