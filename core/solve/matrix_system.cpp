#include "core/solve/matrix_system.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/solve/matrix_products.h"
#include "core/spectrum/wavelengths.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr std::uint32_t gauss_block = 64;  // rows whose sums over all other columns are taken together
constexpr double brightest_ambient = 0.98; // mean reflectance above which 1 / (1 - rho_ave) is capped

} // namespace

MatrixSystem::MatrixSystem(const FormFactorMatrix& matrix, int channels, std::vector<float> weight)
    : matrix_(&matrix)
    , channels_(channels)
    , weight_(std::move(weight))
    , rho_(matrix.n, channels)
    , e_(matrix.n, channels)
    , x_(matrix.n, channels)
    , h_(matrix.n, channels)
    , r_(matrix.n, channels)
    , b_(matrix.n, channels) {
    for (const float a : matrix.area) area_ += a;
}

void MatrixSystem::set_sources(PatchField rho, PatchField exitance) {
    rho_ = std::move(rho);
    e_ = std::move(exitance);
    emitted_ = 0;
    mean_rho_.assign(static_cast<std::size_t>(channels_), 0.0);
    for (std::uint32_t i = 0; i < matrix_->n; ++i)
        for (int c = 0; c < channels_; ++c) {
            emitted_ += double(matrix_->area[i]) * weight_[c] * e_[i][c];
            mean_rho_[c] += matrix_->area[i] / area_ * rho_[i][c];
        }
    if (!(emitted_ > 0)) {
        std::ranges::fill(x_.values, 0.0), std::ranges::fill(h_.values, 0.0);
        any_sent_ = false, h_exact_ = true;
    }
    cursor_ = 0;
    left_known_ = false;
    given_up_ = false;
    last_shooter_ = no_index;
    halved_from_ = 0;
    for (std::size_t k = 0; k < r_.values.size(); ++k)
        r_.values[k] = e_.values[k] + rho_.values[k] * h_.values[k] - x_.values[k];
    refresh();
    if (!h_exact_) {
        residual_known_ = false;
        residual_ = 1;
        unshot_ = emitted_;
        flux_known_ = false;
    }
}

void MatrixSystem::refresh() {
    for (std::size_t k = 0; k < b_.values.size(); ++k) b_.values[k] = e_.values[k] + rho_.values[k] * h_.values[k];
    if (h_exact_) note_residual();
}

void MatrixSystem::note_residual() {
    std::array<double, max_channels> most{}, source{};
    for (std::uint32_t i = 0; i < matrix_->n; ++i)
        for (int c = 0; c < channels_; ++c) {
            most[c] = std::max(most[c], std::abs(r_[i][c]));
            source[c] = std::max(source[c], e_[i][c]);
        }
    residual_ = 0;
    for (int c = 0; c < channels_; ++c)
        if (source[c] > 0) residual_ = std::max(residual_, most[c] / source[c]);
    residual_known_ = true;
    find_flux();
}

void MatrixSystem::find_flux() {
    flux_.resize(matrix_->n);
    unshot_ = 0;
    signed_.assign(static_cast<std::size_t>(channels_), 0.0);
    for (std::uint32_t i = 0; i < matrix_->n; ++i) {
        double flux = 0;
        for (int c = 0; c < channels_; ++c) {
            flux += weight_[c] * std::abs(r_[i][c]);
            signed_[c] += matrix_->area[i] * r_[i][c];
        }
        flux_[i] = flux * matrix_->area[i];
        unshot_ += flux_[i];
    }
    flux_known_ = true;
}

double MatrixSystem::unshot_share() const {
    return emitted_ > 0 ? unshot_ / emitted_ : 0;
}

double MatrixSystem::relative_residual() const {
    return residual_;
}

bool MatrixSystem::jacobi_sweep(const std::atomic<bool>& cancel) {
    const std::uint32_t n = matrix_->n;
    if (cursor_ == 0) next_ = PatchField(n, channels_);
    if (!run_slice(cursor_, n, 4 * rows_at_once, cancel,
                   [&](std::uint32_t first, std::uint32_t last) { multiply_rows(*matrix_, first, last, b_, next_); }))
        return false;
    cursor_ = 0;
    std::swap(x_, b_); // b is made anew below
    std::swap(h_, next_);
    any_sent_ = h_exact_ = true;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double own = matrix_->row(i)[i];
        for (int c = 0; c < channels_; ++c) {
            r_[i][c] = e_[i][c] + rho_[i][c] * h_[i][c] - x_[i][c];
            b_[i][c] = x_[i][c] + r_[i][c] / (1 - rho_[i][c] * own); // K_ii = 1 - rho_i F_ii
        }
    }
    note_residual();
    return true;
}

bool MatrixSystem::gauss_seidel_sweep(const std::atomic<bool>& cancel) {
    const std::uint32_t n = matrix_->n;
    const auto stride = static_cast<std::size_t>(x_.stride);
    if (!any_sent_) x_ = e_;
    any_sent_ = true;
    if (left_.count != n) left_ = PatchField(n, channels_), left_known_ = false;
    h_exact_ = false;
    const auto start = std::chrono::steady_clock::now();
    while (cursor_ < n) {
        if (cancel.load(std::memory_order_relaxed)) return false;
        const std::uint32_t block = cursor_, end = std::min(n, block + gauss_block);
        std::vector<double> left(gauss_block * stride, 0.0), right(gauss_block * stride, 0.0);
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, (end - block + rows_at_once - 1) / rows_at_once),
                          [&](const tbb::blocked_range<std::uint32_t>& range) {
                              multiply_outside(*matrix_, block + range.begin() * rows_at_once,
                                               std::min(end, block + range.end() * rows_at_once), block, end, x_,
                                               left.data(), right.data());
                          });
        for (std::uint32_t i = block; i < end; ++i) {
            double* before = left.data() + (i - block) * stride;
            double* after = right.data() + (i - block) * stride;
            multiply_part(*matrix_, i, block, i, x_, before);
            multiply_part(*matrix_, i, i + 1, end, x_, after);
            const double own = matrix_->row(i)[i];
            for (int c = 0; c < channels_; ++c) {
                // The residual of the iterate before this sweep: what lies left of i as it was then, was summed then.
                r_[i][c] = e_[i][c] + rho_[i][c] * (left_[i][c] + after[c] + own * x_[i][c]) - x_[i][c];
                left_[i][c] = before[c];
                x_[i][c] = (e_[i][c] + rho_[i][c] * (before[c] + after[c])) / (1 - rho_[i][c] * own);
                h_[i][c] = before[c] + after[c] + own * x_[i][c];
            }
        }
        cursor_ = end;
        if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > step_seconds) break;
    }
    if (cursor_ < n) return false;
    cursor_ = 0;
    b_ = x_;
    if (left_known_) note_residual();
    left_known_ = true;
    return true;
}

double MatrixSystem::send(std::uint32_t j, const double* amount, double* l1_change, double* sent_on) {
    std::array<float, max_channels + 8> weight{};
    std::ranges::copy(weight_, weight.begin());
    const double area = matrix_->area[j];
    double flux = 0;
    for (int c = 0; c < channels_; ++c) {
        const double before = r_[j][c];
        x_[j][c] += amount[c];
        r_[j][c] = before - amount[c];
        l1_change[c] += area * (std::abs(r_[j][c]) - std::abs(before));
        flux += area * weight_[c] * std::abs(r_[j][c]);
    }
    double change = flux - flux_[j];
    flux_[j] = flux;
    std::array<double, max_channels + 8> sent{};
    change += send_column(*matrix_, j, amount, weight.data(), rho_, h_, r_, flux_, l1_change, sent.data());
    for (int c = 0; c < channels_; ++c) {
        sent_on[c] += sent[c];
        signed_[c] += (sent[c] - area) * amount[c];
    }
    unshot_ += change;
    return change;
}

bool MatrixSystem::shoot(bool over) {
    if (!flux_known_ || !(emitted_ > 0)) return false;
    const auto largest = std::ranges::max_element(flux_);
    if (largest == flux_.end() || !(*largest > 0)) return false;
    const auto j = static_cast<std::uint32_t>(largest - flux_.begin());
    if (halved_from_ <= 0 || unshot_ < 0.5 * halved_from_) halved_from_ = unshot_, shots_since_halved_ = 0;
    if (double(++shots_since_halved_) > patience * matrix_->n) given_up_ = true;

    std::array<double, max_channels + 8> amount{}, l1{}, sent_on{}, extra{};
    for (int c = 0; c < channels_; ++c) amount[c] = r_[j][c];
    bool more = false;
    if (over && !given_up_) {
        for (int c = 0; c < channels_; ++c) {
            const double ambient = signed_[c] / area_ / (1 - std::min(mean_rho_[c], brightest_ambient));
            const double ahead = rho_[j][c] * ambient;
            if (ahead * amount[c] > 0) extra[c] = ahead, more = true;
        }
    }
    const std::array<double, max_channels + 8> plain = amount;
    for (int c = 0; c < channels_; ++c) amount[c] += extra[c];
    send(j, amount.data(), l1.data(), sent_on.data());
    if (more) {
        std::array<double, max_channels + 8> back{}, ignored{};
        bool any_back = false;
        for (int c = 0; c < channels_; ++c) {
            const double plain_drop = matrix_->area[j] * std::abs(plain[c]) - sent_on[c] * std::abs(plain[c]);
            if (extra[c] != 0 && !(-l1[c] >= 0.5 * std::max(plain_drop, 0.0) && plain_drop > 0))
                back[c] = -extra[c], any_back = true;
        }
        bool all_back = true;
        for (int c = 0; c < channels_; ++c) all_back = all_back && back[c] == -extra[c];
        if (any_back) send(j, back.data(), ignored.data(), ignored.data());
        overshots_ += !all_back;
    }
    last_shooter_ = j;
    any_sent_ = true;
    if (shots_since_halved_ % 1024 == 0) find_flux(); // sums of many differences: rounding
    return true;
}

bool has_no_finite_solution(const FormFactorMatrix& matrix, const RowSums& sums, const PatchField& rho,
                            const PatchField& exitance, int channels) {
    constexpr double absorbs = 1e-7, leaks = 1e-5; // of float reflectances, and of rows that are sums of n floats
    const std::uint32_t n = matrix.n;
    std::vector<std::uint8_t> open(n); // light of these leaves the scene
    for (std::uint32_t i = 0; i < n; ++i) open[i] = sums.sum[i] < 1 - leaks;
    for (int c = 0; c < channels; ++c) {
        std::vector<std::uint8_t> loses(n);
        std::vector<std::uint32_t> queue;
        for (std::uint32_t i = 0; i < n; ++i)
            if (open[i] || rho[i][c] < 1 - absorbs) loses[i] = 1, queue.push_back(i);
        for (std::size_t k = 0; k < queue.size() && queue.size() < n; ++k)
            for (std::uint32_t i = 0; i < n; ++i)
                if (!loses[i] && matrix.at(i, queue[k]) > 0) loses[i] = 1, queue.push_back(i);
        for (std::uint32_t i = 0; i < n; ++i)
            if (!loses[i] && exitance[i][c] > 0) return true;
    }
    return false;
}

} // namespace lueur
