// Linear algebra on small dense matrices, apart from its users because each file that has these written out anew takes
// the compiler seconds.
#pragma once

#include <Eigen/Core>

namespace lueur {

// matrix * x = right, a column each; the matrix is square and can be inverted (Gaussian elimination, partial pivoting).
Eigen::MatrixXd solve_linear(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

// a^T b
Eigen::MatrixXd transposed_times(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

} // namespace lueur
