#include "core/spectrum/dense_algebra.h"

#include <Eigen/LU>

namespace lueur {

Eigen::MatrixXd solve_linear(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
    return matrix.partialPivLu().solve(right);
}

Eigen::MatrixXd transposed_times(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return a.transpose() * b;
}

} // namespace lueur
