// What the solvers of the full matrix spend their time on: rows and columns of F times all channels of a field.
#pragma once

#include <cstdint>
#include <vector>

#include "core/solve/form_factor_matrix.h"

namespace lueur {

// A value a patch and channel; channels padded with zeros to whole vector registers.
struct PatchField {
    std::uint32_t count = 0;
    int stride = 8;
    std::vector<double> values;

    PatchField() = default;
    PatchField(std::uint32_t n, int channels)
        : count(n)
        , stride((channels + 7) / 8 * 8)
        , values(std::size_t(n) * ((channels + 7) / 8 * 8), 0.0) {}
    double* operator[](std::uint32_t i) { return values.data() + std::size_t(i) * stride; }
    const double* operator[](std::uint32_t i) const { return values.data() + std::size_t(i) * stride; }
};

inline constexpr std::uint32_t rows_at_once = 4; // share what is read of x

// out_i += sum_j F_ij x_j for rows [begin, end).
void multiply_rows(const FormFactorMatrix& f, std::uint32_t begin, std::uint32_t end, const PatchField& x,
                   PatchField& out);

// Of rows [begin, end), which lie in [block, block_end), the columns before and after that block; row i's sums are
// added at left and right + (i - block) * stride.
void multiply_outside(const FormFactorMatrix& f, std::uint32_t begin, std::uint32_t end, std::uint32_t block,
                      std::uint32_t block_end, const PatchField& x, double* left, double* right);

// Columns [first, last) of one row, added to sum.
void multiply_part(const FormFactorMatrix& f, std::uint32_t i, std::uint32_t first, std::uint32_t last,
                   const PatchField& x, double* sum);

// A shot: `amount` of patch j arrives at all patches, dh_i = F_ij amount, dr_i = rho_i dh_i. flux[i] is kept at
// A_i sum_c weight_c |r_ic|; gives what that changed in sum. Added to l1_change: what sum_i A_i |r_i| changed, to
// sent_on: sum_i A_i rho_i F_ij.
double send_column(const FormFactorMatrix& f, std::uint32_t j, const double* amount, const float* weight,
                   const PatchField& rho, PatchField& h, PatchField& r, std::vector<double>& flux, double* l1_change,
                   double* sent_on);

} // namespace lueur
