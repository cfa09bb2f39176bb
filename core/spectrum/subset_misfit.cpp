#include "core/spectrum/subset_misfit.h"

#include <algorithm>
#include <limits>

#include <Eigen/Cholesky>

#include "core/spectrum/dense_algebra.h"

namespace lueur {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The condition on the sum as one more row of A, so heavy that what is left of its misfit does not count.
constexpr double condition_weight = 1e5; // of the mean diagonal

} // namespace

SubsetMisfit::SubsetMisfit(const MatrixXd& columns, const VectorXd& target, double total, double ridge)
    : gram_(transposed_times(columns, columns))
    , right_(transposed_times(columns, target))
    , square_(target.squaredNorm()) {
    const double mean = gram_.diagonal().mean(), heavy = condition_weight * mean;
    gram_.diagonal().array() += ridge * mean;
    gram_.array() += heavy;
    right_.array() += heavy * total;
    square_ += heavy * total * total;
}

// Cholesky of the others' normal equations; one more column then costs one triangular solve.
void SubsetMisfit::add_with_one_more(const std::vector<int>& others, int low, int high, VectorXd& sums) const {
    const Index n = static_cast<Index>(others.size()), wanted = high - low + 1;
    const MatrixXd cholesky = gram_(others, others).llt().matrixL();
    const auto lower = cholesky.triangularView<Eigen::Lower>();
    VectorXd explained = right_(others);
    lower.solveInPlace(explained);
    MatrixXd shared = gram_(others, Eigen::seqN(low, wanted));
    if (n > 0) lower.solveInPlace(shared);
    const double base = square_ - explained.squaredNorm();
    for (Index c = 0; c < wanted; ++c) {
        const double own = gram_(low + c, low + c), left = own - shared.col(c).squaredNorm();
        const double gain = right_[low + c] - shared.col(c).dot(explained);
        const bool independent =
            left > 1e-13 * own && !std::binary_search(others.begin(), others.end(), static_cast<int>(low + c));
        sums[c] += independent ? base - gain * gain / left : std::numeric_limits<double>::infinity();
    }
}

} // namespace lueur
