// Conjugate gradients on the full matrix, for form factors that are reciprocal.
//
// With A_i F_ij = A_j F_ji the system D(A / rho) B - A F B = D(A / rho) E is symmetric, and positive definite for
// rho row_sum < 1 (Hestenes & Stiefel 1952). Patches that reflect nothing have B = E and stand on the right side. Exact
// form factors are reciprocal; rows that were made patch by patch with rays, as the lecture makes them, are not, and
// are refused: for those the gathering solver's conjugate residuals need no symmetry.
#pragma once

#include <atomic>
#include <expected>
#include <string>

#include "core/solve/matrix_products.h"

namespace lueur {

// Largest |A_i F_ij - A_j F_ji| of all pairs, of the smaller of A_i and A_j.
double reciprocity_error(const FormFactorMatrix& matrix);

struct ConjugateGradients {
    PatchField radiosity;
    int sweeps = 0;      // applications of F
    double residual = 1; // |r| / |E| in the norm of A / rho, worst channel
};
// Until the residual is at most `tolerance`. The error says why not: not reciprocal, no convergence, cancelled.
std::expected<ConjugateGradients, std::string> conjugate_gradients(const FormFactorMatrix& matrix,
                                                                   const PatchField& rho, const PatchField& exitance,
                                                                   int channels, double tolerance, int most_sweeps,
                                                                   const std::atomic<bool>& cancel);

} // namespace lueur
