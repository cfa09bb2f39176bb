#include "core/solve/matrix_products.h"

#include <cmath>
#include <cstring>

#include "core/solve/best_vectors.h"

namespace lueur {

namespace {

// Four channels as one register; written out, for the compiler would sum channel by channel in memory. Copied in and
// out, for the numbers in memory are aligned as doubles only.
using FourDoubles [[gnu::vector_size(32)]] = double;

// out[k] += sum over [first, last) of F_(i+k)j x_j, eight channels from `channel`.
template <int Rows>
[[gnu::always_inline]] inline void add_products(const FormFactorMatrix& f, std::uint32_t i, std::uint32_t first,
                                                std::uint32_t last, const PatchField& x, int channel,
                                                double* const (&out)[Rows]) {
    const float* row[Rows];
    FourDoubles low[Rows] = {}, high[Rows] = {};
    for (int k = 0; k < Rows; ++k) row[k] = f.row(i + static_cast<std::uint32_t>(k));
    const std::size_t stride = static_cast<std::size_t>(x.stride);
    const double* values = x.values.data() + channel;
    for (std::uint32_t j = first; j < last; ++j) {
        FourDoubles a, b;
        std::memcpy(&a, values + j * stride, sizeof a);
        std::memcpy(&b, values + j * stride + 4, sizeof b);
        for (int k = 0; k < Rows; ++k) {
            const double factor = row[k][j];
            low[k] += factor * a;
            high[k] += factor * b;
        }
    }
    for (int k = 0; k < Rows; ++k) {
        double* to = out[k] + channel;
        for (int c = 0; c < 4; ++c) to[c] += low[k][c], to[c + 4] += high[k][c];
    }
}

// out_i += sum over columns [first, last) for rows [begin, end); row i's sums at out(i).
template <typename Out>
[[gnu::always_inline]] inline void add_rows(const FormFactorMatrix& f, std::uint32_t begin, std::uint32_t end,
                                            std::uint32_t first, std::uint32_t last, const PatchField& x,
                                            const Out& out) {
    std::uint32_t i = begin;
    for (; i + rows_at_once <= end; i += rows_at_once) {
        double* const to[rows_at_once] = {out(i), out(i + 1), out(i + 2), out(i + 3)};
        for (int c = 0; c < x.stride; c += 8) add_products<rows_at_once>(f, i, first, last, x, c, to);
    }
    for (; i < end; ++i) {
        double* const to[1] = {out(i)};
        for (int c = 0; c < x.stride; c += 8) add_products<1>(f, i, first, last, x, c, to);
    }
}

} // namespace

LUEUR_BEST_VECTORS void multiply_rows(const FormFactorMatrix& f, std::uint32_t begin, std::uint32_t end,
                                      const PatchField& x, PatchField& out) {
    add_rows(f, begin, end, 0, f.n, x, [&](std::uint32_t i) { return out[i]; });
}

LUEUR_BEST_VECTORS void multiply_outside(const FormFactorMatrix& f, std::uint32_t begin, std::uint32_t end,
                                         std::uint32_t block, std::uint32_t block_end, const PatchField& x,
                                         double* left, double* right) {
    const std::size_t stride = static_cast<std::size_t>(x.stride);
    add_rows(f, begin, end, 0, block, x, [&](std::uint32_t i) { return left + (i - block) * stride; });
    add_rows(f, begin, end, block_end, f.n, x, [&](std::uint32_t i) { return right + (i - block) * stride; });
}

LUEUR_BEST_VECTORS void multiply_part(const FormFactorMatrix& f, std::uint32_t i, std::uint32_t first,
                                      std::uint32_t last, const PatchField& x, double* sum) {
    add_rows(f, i, i + 1, first, last, x, [&](std::uint32_t) { return sum; });
}

LUEUR_BEST_VECTORS double send_column(const FormFactorMatrix& f, std::uint32_t j, const double* amount,
                                      const float* weight, const PatchField& rho, PatchField& h, PatchField& r,
                                      std::vector<double>& flux, double* l1_change, double* sent_on) {
    const int stride = rho.stride;
    const float* column = f.transposed ? f.row(j) : f.values.data() + j;
    const std::size_t step = f.transposed ? 1 : f.n;
    double flux_change = 0;
    for (std::uint32_t i = 0; i < f.n; ++i) {
        const double factor = column[i * step];
        if (factor == 0) continue;
        const double area = f.area[i];
        const double* rho_i = rho[i];
        double *h_i = h[i], *r_i = r[i];
        double new_flux = 0;
        for (int c = 0; c < stride; ++c) {
            const double before = r_i[c], reflected = rho_i[c] * factor;
            h_i[c] += factor * amount[c];
            r_i[c] = before + reflected * amount[c];
            l1_change[c] += area * (std::abs(r_i[c]) - std::abs(before));
            sent_on[c] += area * reflected;
            new_flux += weight[c] * std::abs(r_i[c]);
        }
        flux_change += area * new_flux - flux[i];
        flux[i] = area * new_flux;
    }
    return flux_change;
}

} // namespace lueur
