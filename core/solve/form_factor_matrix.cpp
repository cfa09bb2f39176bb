#include "core/solve/form_factor_matrix.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/transport/time_slice.h"

namespace lueur {

std::uint64_t matrix_bytes(std::uint64_t patches) {
    return patches * patches * sizeof(float);
}

std::string bytes_text(std::uint64_t bytes) {
    const double mib = double(bytes) / (1 << 20);
    return mib < 1024 ? fmt::format("{:.3g} MiB", mib) : fmt::format("{:.3g} GiB", mib / 1024);
}

std::expected<FormFactorMatrix, std::string> make_form_factor_matrix(std::vector<float> area,
                                                                     std::uint64_t most_bytes) {
    const std::uint64_t bytes = matrix_bytes(area.size());
    const std::string needs = fmt::format("the form factors of {} patches take {}", area.size(), bytes_text(bytes));
    if (bytes > most_bytes)
        return std::unexpected(fmt::format("{}, and {} are allowed: larger elements, more memory for the matrix, or a "
                                           "solver without one",
                                           needs, bytes_text(most_bytes)));
    FormFactorMatrix matrix;
    matrix.n = static_cast<std::uint32_t>(area.size());
    matrix.area = std::move(area);
    try {
        matrix.values.assign(std::size_t(matrix.n) * matrix.n, 0.0f);
    } catch (const std::bad_alloc&) {
        return std::unexpected(fmt::format("{}, more than this machine has left", needs));
    }
    return matrix;
}

bool fill_rows(FormFactorMatrix& matrix, const PatchScene& patches, FormFactorMethod method,
               const FormFactorSettings& settings, std::uint32_t& cursor, FormFactorCost& cost,
               const std::atomic<bool>& cancel) {
    const auto start = std::chrono::steady_clock::now();
    const auto threads = static_cast<std::uint32_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
    std::uint32_t block = threads; // rows at a time: grows as long as they are cheap
    while (cursor < matrix.n && !cancel.load(std::memory_order_relaxed)) {
        const auto block_start = std::chrono::steady_clock::now();
        const std::uint32_t last = std::min(matrix.n, cursor + block);
        std::vector<FormFactorCost> costs(last - cursor);
        tbb::parallel_for(cursor, last, [&](std::uint32_t i) {
            form_factor_row(patches, i, method, settings, {matrix.row(i), matrix.n}, costs[i - cursor]);
        });
        for (const FormFactorCost& one : costs) {
            cost.cost += one.cost, cost.seconds += one.seconds;
            cost.pairs += one.pairs, cost.warned += one.warned, cost.missed += one.missed;
        }
        cursor = last;
        const auto now = std::chrono::steady_clock::now();
        if (std::chrono::duration<double>(now - start).count() > step_seconds) break;
        if (std::chrono::duration<double>(now - block_start).count() < 0.2 * step_seconds) block *= 2;
    }
    return cursor >= matrix.n;
}

void transpose(FormFactorMatrix& matrix) {
    constexpr std::uint32_t tile = 32;
    const std::uint32_t tiles = (matrix.n + tile - 1) / tile;
    tbb::parallel_for(std::uint32_t(0), tiles, [&](std::uint32_t ti) {
        for (std::uint32_t tj = 0; tj <= ti; ++tj)
            for (std::uint32_t i = ti * tile; i < std::min(matrix.n, (ti + 1) * tile); ++i)
                for (std::uint32_t j = tj * tile; j < std::min(i, (tj + 1) * tile); ++j)
                    std::swap(matrix.row(i)[j], matrix.row(j)[i]);
    });
    matrix.transposed = !matrix.transposed;
}

RowSums limit_row_sums(FormFactorMatrix& matrix) {
    constexpr double rounding = 1e-6; // of float rows: not worth a word
    RowSums found;
    found.sum.assign(matrix.n, 0.0);
    std::vector<double> given(matrix.n);
    std::vector<std::uint8_t> broken(matrix.n);
    tbb::parallel_for(std::uint32_t(0), matrix.n, [&](std::uint32_t i) {
        float* row = matrix.row(i);
        for (std::uint32_t j = 0; j < matrix.n; ++j) {
            if (!(row[j] >= 0) || !std::isfinite(row[j])) row[j] = 0, broken[i] = 1;
            given[i] += row[j];
        }
        const float scale = given[i] > 1 ? std::nextafter(static_cast<float>(1 / given[i]), 0.0f) : 1.0f;
        for (std::uint32_t j = 0; j < matrix.n; ++j) {
            row[j] *= scale;
            found.sum[i] += row[j];
        }
    });
    for (std::uint32_t i = 0; i < matrix.n; ++i) {
        found.above += given[i] > 1 + rounding;
        found.largest = std::max(found.largest, given[i]);
        found.broken += broken[i];
    }
    return found;
}

} // namespace lueur
