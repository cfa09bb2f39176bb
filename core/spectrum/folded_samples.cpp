#include "core/spectrum/folded_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <limits>

#include "core/spectrum/colour_difference.h"
#include "core/spectrum/dense_algebra.h"
#include "core/spectrum/subset_misfit.h"
#include "core/spectrum/visible_grid.h"

namespace lueur {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int grid_first = 380, grid_last = 780, grid_step = 5;
constexpr int candidates = (grid_last - grid_first) / grid_step + 1;
constexpr std::size_t most_fitted_products = 400;
constexpr double edge_weight = 0.8;             // of the smooth edges together, among the paints' own products
constexpr double cie_threshold = 216.0 / 24389; // below it L* is linear (CIE 15:2018)
constexpr int exchange_reach = 4;               // candidates either side
constexpr int most_fit_rounds = 6;
constexpr double even_first = 400, even_last = 690; // nm: where nearly all of XYZ is
constexpr int most_even = 32;                       // samples that are then still apart from each other
constexpr int lawson_rounds = 12, polish_rounds = 4;
constexpr double negligible = 0.02; // dE2000
// Of a normal matrix's mean diagonal: keeps neighbours from cancelling each other in large weights.
constexpr double ridge = 1e-9;

// Smooth edges up and down through the visible range: what paints look like (long-pass, short-pass, band).
std::vector<VisibleGrid> edge_family() {
    std::vector<VisibleGrid> family;
    for (const double width : {12.0, 30.0})
        for (double centre = 410; centre <= 690; centre += 20)
            for (const double sign : {1.0, -1.0}) {
                VisibleGrid grid;
                for (int j = 0; j < visible_count; ++j)
                    grid[static_cast<std::size_t>(j)] =
                        0.05 + 0.85 / (1 + std::exp(-sign * (observer_first_nm + j - centre) / width));
                family.push_back(grid);
            }
    return family;
}

// d L* a* b* / d XYZ, rows of L*, a*, b*.
Eigen::Matrix3d lab_slopes(const Xyz& xyz, const Xyz& white) {
    Eigen::Vector3d slope;
    for (int c = 0; c < 3; ++c)
        slope[c] = std::pow(std::max(xyz[c] / white[c], cie_threshold), -2.0 / 3) / (3 * white[c]);
    Eigen::Matrix3d lab;
    lab << 0, 116 * slope[1], 0, 500 * slope[0], -500 * slope[1], 0, 0, 200 * slope[1], -200 * slope[2];
    return lab;
}

// M of d^T M d = CIEDE2000^2 for a small difference d of Lab (it is symmetric, so the middle of the two counts).
Eigen::Matrix3d difference_metric(const Lab& lab) {
    constexpr double step = 0.05;
    const auto square = [&](double L, double a, double b) {
        const Lab low{lab.L - step * L, lab.a - step * a, lab.b - step * b},
            high{lab.L + step * L, lab.a + step * a, lab.b + step * b};
        const double difference = delta_e_2000(low, high) / (2 * step);
        return difference * difference;
    };
    const double ll = square(1, 0, 0), aa = square(0, 1, 0), bb = square(0, 0, 1), ab = square(0, 1, 1);
    Eigen::Matrix3d metric = Eigen::Matrix3d::Zero(); // lightness is independent of a and b
    metric(0, 0) = ll, metric(1, 1) = aa, metric(2, 2) = bb;
    metric(1, 2) = metric(2, 1) = (ab - aa - bb) / 2;
    return metric;
}

int candidate_of(double nm) {
    return std::clamp(static_cast<int>(std::lround((nm - grid_first) / grid_step)), 0, candidates - 1);
}

// Indices into the upper triangle of a symmetric 3x3.
constexpr int triangle[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

// What is fitted of one light, in units in which the largest of its X, Y, Z is 1.
struct LightFit {
    double unit = 0; // 0: nobody sees it
    Eigen::RowVector3d white;
    MatrixXd xyz;                  // rows x 3
    std::array<ArrayXd, 6> metric; // CIEDE2000^2 of a difference of XYZ, one a row
    double watt_white = 0;         // in the light's own unit
    VectorXd watts;
};

// Least squares of sum_k w_k = total, columns of `right` and `total` at once.
MatrixXd constrained(const MatrixXd& gram, const MatrixXd& right, const Eigen::RowVectorXd& total, Index sums) {
    const Index n = gram.rows(), each = n / sums;
    const double scale = gram.trace() / static_cast<double>(n); // of the conditions' rows, for a good pivot
    MatrixXd matrix = MatrixXd::Zero(n + sums, n + sums), sides(n + sums, right.cols());
    matrix.topLeftCorner(n, n) = gram;
    for (Index s = 0; s < sums; ++s) {
        matrix.row(n + s).segment(s * each, each).setConstant(scale);
        matrix.col(n + s).segment(s * each, each).setConstant(scale);
        sides.row(n + s).setConstant(scale * total[s]);
    }
    sides.topRows(n) = right;
    return solve_linear(matrix, sides).topRows(n);
}

} // namespace

struct FoldedFit::State {
    MatrixXd sampled; // products, then edges, as rows; at the candidates
    VectorXd importance;
    Index products = 0; // the rows before the edges
    std::vector<LightFit> lights;
    std::vector<SubsetMisfit> misfits;    // one each of X, Y, Z of each light
    std::vector<std::vector<int>> chosen; // candidates of the sets of 1, 2, 3... samples found so far

    MatrixXd columns(const std::vector<double>& nm) const {
        MatrixXd matrix(sampled.rows(), static_cast<Index>(nm.size()));
        for (std::size_t k = 0; k < nm.size(); ++k)
            matrix.col(static_cast<Index>(k)) = sampled.col(candidate_of(nm[k]));
        return matrix;
    }

    struct Fitted {
        MatrixXd weights; // n x 3
        double worst = 0; // linearised CIEDE2000 of the products
    };
    Fitted fit(const LightFit& light, const MatrixXd& p, int rounds) const;
    double worst(const std::vector<double>& nm, int rounds) const {
        const MatrixXd p = columns(nm);
        double result = 0;
        for (const LightFit& light : lights)
            if (light.unit > 0) result = std::max(result, fit(light, p, rounds).worst);
        return result;
    }
};

// Least squares makes the mean small; then the products that are furthest off count more, round by round (Lawson 1961);
// the round with the smallest worst difference is kept.
FoldedFit::State::Fitted FoldedFit::State::fit(const LightFit& light, const MatrixXd& p, int rounds) const {
    const Index n = p.cols(), rows = p.rows();
    Fitted best{MatrixXd::Zero(n, 3), std::numeric_limits<double>::infinity()};
    ArrayXd emphasis = importance.array().square();
    MatrixXd gram(3 * n, 3 * n), weighted(rows, 6 * n);
    VectorXd right(3 * n);
    for (int round = 0; round < rounds; ++round) {
        right.setZero();
        for (int i = 0; i < 6; ++i)
            weighted.middleCols(i * n, n).noalias() =
                (emphasis * light.metric[static_cast<std::size_t>(i)]).matrix().asDiagonal() * p;
        const MatrixXd shared = transposed_times(p, weighted);
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) {
                gram.block(a * n, b * n, n, n) = shared.middleCols(triangle[a][b] * n, n);
                right.segment(a * n, n).noalias() +=
                    weighted.middleCols(triangle[a][b] * n, n).transpose() * light.xyz.col(b);
            }
        for (int a = 0; a < 3; ++a) {
            auto diagonal = gram.diagonal().segment(a * n, n);
            diagonal.array() += ridge * diagonal.mean();
        }
        const MatrixXd solution = constrained(gram, right, light.white, 3);
        const Eigen::Map<const MatrixXd> w(solution.data(), n, 3);
        const Eigen::ArrayXXd off = (p.topRows(products) * w - light.xyz.topRows(products)).array();
        ArrayXd square = ArrayXd::Zero(products);
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
                square +=
                    off.col(a) * off.col(b) * light.metric[static_cast<std::size_t>(triangle[a][b])].head(products);
        const ArrayXd differences = square.max(0.0).sqrt();
        const double worst = products > 0 ? differences.maxCoeff() : 0, mean = products > 0 ? differences.mean() : 0;
        if (worst < best.worst) best = {w, worst};
        if (!(mean > 0) || worst < negligible) break;
        emphasis.head(products) *= 0.5 + 0.5 * differences / mean;
    }
    return best;
}

FoldedFit::FoldedFit(const SpectralContent& content)
    : state_(std::make_unique<State>()) {
    State& s = *state_;
    std::vector<VisibleGrid> reflectances;
    for (const Spectrum& reflectance : with_interreflection(content.reflectances))
        reflectances.push_back(on_visible_grid(reflectance, Outside::constant));
    const std::vector<ReflectanceProduct> products =
        reflectance_products(static_cast<int>(reflectances.size()), most_fitted_products);
    static const std::vector<VisibleGrid> edges = edge_family();

    const Index rows = static_cast<Index>(products.size() + edges.size());
    MatrixXd full = MatrixXd::Ones(visible_count, rows); // columns here, for they are whole spectra
    s.products = static_cast<Index>(products.size());
    s.importance = VectorXd::Ones(rows);
    const auto column = [](const VisibleGrid& grid) { return Eigen::Map<const ArrayXd>(grid.data(), visible_count); };
    for (std::size_t i = 0; i < products.size(); ++i)
        for (const int index : products[i])
            if (index >= 0)
                full.col(static_cast<Index>(i)).array() *= column(reflectances[static_cast<std::size_t>(index)]);
    // The family as a whole counts a share of what the products do, however many of those there are.
    const double edge_importance = std::sqrt(edge_weight * std::max<double>(1, static_cast<double>(products.size())) /
                                             static_cast<double>(edges.size()));
    for (std::size_t i = 0; i < edges.size(); ++i) {
        full.col(s.products + static_cast<Index>(i)) = column(edges[i]);
        s.importance[s.products + static_cast<Index>(i)] = edge_importance;
    }
    s.sampled.resize(rows, candidates);
    for (int c = 0; c < candidates; ++c) s.sampled.col(c) = full.row(grid_first + c * grid_step - observer_first_nm);

    for (const Spectrum& spectrum : content.lights) {
        const VisibleGrid moments = moments_on_visible_grid(spectrum),
                          watts = moments_on_visible_grid(spectrum, grid_first, grid_last);
        MatrixXd functionals = MatrixXd::Zero(visible_count, 4); // X, Y, Z, watts
        for (int j = 0; j < visible_count; ++j) {
            const double moment = moments[static_cast<std::size_t>(j)];
            const Xyz xyz = observer_xyz(observer_first_nm + j);
            functionals.row(j) << moment * xyz.x, moment * xyz.y, moment * xyz.z, watts[static_cast<std::size_t>(j)];
        }
        LightFit light;
        const MatrixXd targets = transposed_times(full, functionals);
        light.watts = targets.col(3);
        light.watt_white = functionals.col(3).sum();
        light.white = functionals.leftCols(3).colwise().sum();
        light.unit = light.white.maxCoeff();
        if (!(light.unit > 0)) {
            light.unit = 0;
            s.lights.push_back(std::move(light));
            continue;
        }
        light.white /= light.unit;
        light.xyz = targets.leftCols(3) / light.unit;
        // A light of one line may have no Z: its Lab is taken against a white that has a little of everything.
        const Xyz white = glm::max(Xyz(light.white[0], light.white[1], light.white[2]), Xyz(1e-3));
        for (ArrayXd& metric : light.metric) metric.resize(rows);
        MatrixXd diagonal(rows, 3);
        for (Index i = 0; i < rows; ++i) {
            const Xyz xyz(light.xyz(i, 0), light.xyz(i, 1), light.xyz(i, 2));
            const Eigen::Matrix3d slopes = lab_slopes(xyz, white);
            const Eigen::Matrix3d metric = slopes.transpose() * difference_metric(lab_from_xyz(xyz, white)) * slopes;
            for (int a = 0; a < 3; ++a) {
                for (int b = a; b < 3; ++b) light.metric[static_cast<std::size_t>(triangle[a][b])][i] = metric(a, b);
                // The wavelengths are chosen for X, Y and Z apart, in CIELAB, whose three axes are then as good as
                // independent.
                diagonal(i, a) = s.importance[i] * slopes.col(a).norm();
            }
        }
        for (int a = 0; a < 3; ++a)
            if (light.white[a] > 0)
                s.misfits.emplace_back(diagonal.col(a).asDiagonal() * s.sampled,
                                       diagonal.col(a).cwiseProduct(light.xyz.col(a)), light.white[a], ridge);
        s.lights.push_back(std::move(light));
    }
}

FoldedFit::~FoldedFit() = default;
FoldedFit::FoldedFit(FoldedFit&&) noexcept = default;
FoldedFit& FoldedFit::operator=(FoldedFit&&) noexcept = default;

std::vector<double> FoldedFit::choose(int count) const {
    if (state_->misfits.empty()) return {555}; // nothing can be seen: any wavelength will do
    const auto exchange = [&](std::vector<int>& others, int low, int high) { // the best one to stand beside them
        VectorXd sums = VectorXd::Zero(high - low + 1);
        for (const SubsetMisfit& misfit : state_->misfits) misfit.add_with_one_more(others, low, high, sums);
        Index best = 0;
        const double lowest = sums.minCoeff(&best);
        others.insert(std::lower_bound(others.begin(), others.end(), low + static_cast<int>(best)),
                      low + static_cast<int>(best));
        return lowest;
    };
    // Each in turn is moved within its reach while that helps.
    const auto improve = [&](std::vector<int>& set, double lowest) {
        for (int round = 0; round < most_fit_rounds; ++round) {
            const double before = lowest;
            for (std::size_t k = 0; k < set.size(); ++k) {
                const int from = set[k];
                std::vector<int> others = set;
                others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
                const double after = exchange(others, std::max(0, from - exchange_reach),
                                              std::min(candidates - 1, from + exchange_reach));
                if (after < lowest) lowest = after, set = std::move(others);
            }
            if (!(lowest < before * (1 - 1e-6))) break;
        }
        return lowest;
    };
    while (static_cast<int>(state_->chosen.size()) < std::min(count, candidates)) {
        std::vector<int> grown = state_->chosen.empty() ? std::vector<int>{} : state_->chosen.back();
        const int wanted = static_cast<int>(grown.size()) + 1;
        std::vector<int> even; // another start, for a grown set may be caught in a valley of its own
        for (int k = 0; k < wanted && wanted <= most_even; ++k)
            even.push_back(candidate_of(even_first + (even_last - even_first) * (k + 0.5) / wanted));
        // The first picture of a scene waits for its wavelengths.
        std::future<double> lowest_from_even = std::async(std::launch::async, [&] {
            return even.empty() ? std::numeric_limits<double>::infinity()
                                : improve(even, std::numeric_limits<double>::infinity());
        });
        const double lowest = improve(grown, exchange(grown, 0, candidates - 1));
        if (lowest_from_even.get() < lowest) grown = std::move(even);
        state_->chosen.push_back(std::move(grown));
    }
    std::vector<double> nm;
    for (const int c : state_->chosen[std::min(static_cast<std::size_t>(count), state_->chosen.size()) - 1])
        nm.push_back(grid_first + c * grid_step);
    return nm;
}

std::vector<double> FoldedFit::polish(std::vector<double> nm, double enough) const {
    double lowest = state_->worst(nm, polish_rounds), before = 2 * lowest;
    while (lowest < 0.95 * before) {
        before = lowest;
        for (std::size_t k = 0; k < nm.size(); ++k)
            for (const int step : {-grid_step, grid_step}) {
                if (lowest <= enough) return nm;
                std::vector<double> set = nm;
                set[k] += step;
                const bool alone = set[k] >= grid_first && set[k] <= grid_last && std::ranges::count(nm, set[k]) == 0;
                if (!alone) continue;
                if (const double worst = state_->worst(set, polish_rounds); worst < lowest)
                    lowest = worst, nm = std::move(set);
            }
    }
    return nm;
}

double FoldedFit::least_squares_worst(const std::vector<double>& nm) const {
    return state_->worst(nm, 1);
}

FoldedWeights FoldedFit::weights(std::size_t index, const std::vector<double>& nm) const {
    const LightFit& light = state_->lights.at(index);
    const MatrixXd p = state_->columns(nm);
    FoldedWeights weights{std::vector<Xyz>(nm.size(), Xyz(0)), std::vector<double>(nm.size(), 0.0)};
    if (light.unit > 0) {
        const MatrixXd w = light.unit * state_->fit(light, p, lawson_rounds).weights;
        for (std::size_t k = 0; k < nm.size(); ++k)
            for (int c = 0; c < 3; ++c) weights.xyz[k][c] = w(static_cast<Index>(k), c);
    }
    if (light.watt_white > 0) {
        const VectorXd importance = state_->importance / light.watt_white;
        const MatrixXd weighted = importance.asDiagonal() * p;
        MatrixXd gram = transposed_times(weighted, weighted);
        gram.diagonal().array() += ridge * gram.diagonal().mean();
        const VectorXd w = constrained(gram, transposed_times(weighted, importance.cwiseProduct(light.watts)),
                                       Eigen::RowVectorXd::Constant(1, light.watt_white), 1);
        std::copy(w.begin(), w.end(), weights.watt.begin());
    }
    return weights;
}

} // namespace lueur
