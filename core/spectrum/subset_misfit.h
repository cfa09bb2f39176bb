// How well a few columns of a matrix explain a vector, for many choices of columns.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace lueur {

// min over w of |A_S w - t|^2 with sum w = total held, S a choice of columns of A.
class SubsetMisfit {
public:
    // `ridge`: of the mean diagonal of A^T A, added to the diagonal.
    SubsetMisfit(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target, double total, double ridge);

    // Adds to `sums`, one a column of low..high, the misfit of `others` with that column beside them; infinity where it
    // is among them or says nothing that they do not.
    void add_with_one_more(const std::vector<int>& others, int low, int high, Eigen::VectorXd& sums) const;

private:
    Eigen::MatrixXd gram_;
    Eigen::VectorXd right_;
    double square_;
};

} // namespace lueur
