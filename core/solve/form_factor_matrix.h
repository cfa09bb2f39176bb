// The full matrix of form factors between the patches of a scene: what Jacobi, Gauss-Seidel and overshooting solve on.
//
// n patches take n^2 numbers whether they see each other or not: its memory is stated before it is taken, and refused
// over a limit. Rows are made by any method of core/transport/form_factor.h and depend on the geometry only, so that
// edits of paints and lamps keep them.
#pragma once

#include <atomic>
#include <cstdint>
#include <expected>
#include <string>
#include <vector>

#include "core/transport/form_factor.h"

namespace lueur {

struct FormFactorMatrix {
    std::uint32_t n = 0;
    std::vector<float> values; // F_ij at i * n + j: of what leaves i, the share that reaches j
    std::vector<float> area;   // m^2

    // Shots read columns: number by number they would cost a cache line each. Transposed, column j is where row j was.
    bool transposed = false;

    float* row(std::uint32_t i) { return values.data() + std::size_t(i) * n; } // not transposed
    const float* row(std::uint32_t i) const { return values.data() + std::size_t(i) * n; }
    float at(std::uint32_t i, std::uint32_t j) const { return transposed ? row(j)[i] : row(i)[j]; }
};
void transpose(FormFactorMatrix& matrix); // in its place

std::uint64_t matrix_bytes(std::uint64_t patches);
std::string bytes_text(std::uint64_t bytes); // "49.9 MiB"

// All zero. The error says what it would take, what is allowed and what to do.
std::expected<FormFactorMatrix, std::string> make_form_factor_matrix(std::vector<float> area, std::uint64_t most_bytes);

// Rows from `cursor` on by `method`, in parallel, until the last, about `step_seconds` are over or `cancel` is set; a
// row begun is finished. True at the end.
bool fill_rows(FormFactorMatrix& matrix, const PatchScene& patches, FormFactorMethod method,
               const FormFactorSettings& settings, std::uint32_t& cursor, FormFactorCost& cost,
               const std::atomic<bool>& cancel);

// A row sum is the share of i's flux that stays in the scene, so none is above 1; a coarse hemicube, or point-to-disk
// beside a shared edge, gives more, and with a reflectance near 1 no sweep would converge. Such rows are scaled down to
// 1; others are left alone, for their light may leave the scene.
struct RowSums {
    std::vector<double> sum;  // of each row, as it is now
    std::uint32_t above = 0;  // rows that were scaled
    double largest = 0;       // as the method gave them
    std::uint32_t broken = 0; // rows with a number that is negative or not finite: those numbers are set to 0
};
RowSums limit_row_sums(FormFactorMatrix& matrix);

} // namespace lueur
