#include "core/solve/gather_system.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "core/solve/best_vectors.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

using Sums = std::array<double, max_channels>;
constexpr std::uint32_t vertices_a_task = 256;

// Channels first .. first + Count of one receiver.
template <int Count>
[[gnu::always_inline]] inline void apply_receiver(std::span<const GatherPass> passes, RayEnds which,
                                                  const ChannelField& field, std::uint32_t i, int first, float* out) {
    constexpr int registers = Count / 8;
    const std::size_t stride = static_cast<std::size_t>(field.stride);
    const float* values = field.values.data() + first;
    Lanes sum[registers] = {};
    for (const GatherPass& pass : passes) {
        const std::vector<std::uint32_t>& all_ends = which == RayEnds::coarse ? pass.ends : pass.fine_ends;
        const std::uint32_t* ends = all_ends.data() + std::size_t(i) * rays_per_pass;
        for (int k = 0; k < rays_per_pass; ++k) {
            const auto* row = reinterpret_cast<const Lanes*>(values + ends[k] * stride);
            for (int c = 0; c < registers; ++c) sum[c] += row[c];
        }
    }
    const float share = 1.0f / (static_cast<float>(passes.size()) * rays_per_pass);
    for (int c = 0; c < registers; ++c) reinterpret_cast<Lanes*>(out + first)[c] = sum[c] * share;
}

LUEUR_BEST_VECTORS void apply_receivers(std::span<const GatherPass> passes, RayEnds ends, const ChannelField& field,
                                        std::uint32_t first, std::uint32_t last, ChannelField& out) {
    for (std::uint32_t i = first; i < last; ++i) {
        int channel = 0; // as many at a time as there are registers for
        for (; field.stride - channel >= 32; channel += 32) apply_receiver<32>(passes, ends, field, i, channel, out[i]);
        switch (field.stride - channel) {
        case 8:
            apply_receiver<8>(passes, ends, field, i, channel, out[i]);
            break;
        case 16:
            apply_receiver<16>(passes, ends, field, i, channel, out[i]);
            break;
        case 24:
            apply_receiver<24>(passes, ends, field, i, channel, out[i]);
            break;
        default:
            break;
        }
    }
}

// sum_i weight_i f(i, c) for all channels; the split into blocks is fixed so that the sum does not depend on the
// threads.
template <typename F>
Sums weighted_sums(std::uint32_t n, int channels, const std::vector<float>& weight, const F& f) {
    return tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::uint32_t>(0, n, 4 * vertices_a_task), Sums{},
        [&](const tbb::blocked_range<std::uint32_t>& range, Sums sums) {
            for (std::uint32_t i = range.begin(); i < range.end(); ++i)
                for (int c = 0; c < channels; ++c) sums[c] += double(weight[i]) * f(i, c);
            return sums;
        },
        [](Sums a, const Sums& b) {
            for (int c = 0; c < max_channels; ++c) a[c] += b[c];
            return a;
        });
}

template <typename F>
void for_each_vertex(std::uint32_t n, const F& f) {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, n, vertices_a_task),
                      [&](const tbb::blocked_range<std::uint32_t>& range) {
                          for (std::uint32_t i = range.begin(); i < range.end(); ++i) f(i);
                      });
}

} // namespace

bool apply_rows(std::span<const GatherPass> passes, RayEnds ends, const ChannelField& field, ChannelField& out,
                const std::atomic<bool>& cancel) {
    if (passes.empty()) {
        std::fill(out.values.begin(), out.values.end(), 0.0f);
        return true;
    }
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, out.count, 64),
                      [&](const tbb::blocked_range<std::uint32_t>& range) {
                          if (!cancel.load(std::memory_order_relaxed))
                              apply_receivers(passes, ends, field, range.begin(), range.end(), out);
                      });
    return !cancel.load(std::memory_order_relaxed);
}

bool apply_rows(std::span<const GatherPass> passes, RayEnds ends, const ChannelField& field, std::uint32_t& cursor,
                ChannelField& out, const std::atomic<bool>& cancel) {
    return run_slice(cursor, out.count, 128, cancel, [&](std::uint32_t first, std::uint32_t last) {
        apply_receivers(passes, ends, field, first, last, out);
    });
}

GatherSystem::GatherSystem(std::uint32_t vertices, int channels, std::vector<float> weight)
    : n_(vertices)
    , channels_(channels)
    , weight_(std::move(weight))
    , rho_(vertices, channels)
    , b_(vertices, channels)
    , x_(vertices + 1, channels)
    , h_(vertices, channels)
    , r_(vertices, channels) {}

void GatherSystem::set_right_side(const ChannelField& rho, const ChannelField& gathered) {
    rho_ = rho;
    for_each_vertex(n_, [&](std::uint32_t i) {
        for (int c = 0; c < channels_; ++c) b_[i][c] = rho_[i][c] * gathered[i][c];
    });
    b_norm2_ =
        weighted_sums(n_, channels_, weight_, [&](std::uint32_t i, int c) { return double(b_[i][c]) * b_[i][c]; });
}

void GatherSystem::set_sources(const ChannelField& rho, const ChannelField& gathered, ChannelField radiosity,
                               ChannelField gathered_radiosity) {
    set_right_side(rho, gathered);
    x_ = std::move(radiosity);
    h_ = std::move(gathered_radiosity);
    refresh_residual();
}

void GatherSystem::set_sources(const ChannelField& rho, const ChannelField& gathered) {
    set_right_side(rho, gathered);
    // The guess alpha x with the smallest |b - alpha A x|: one lamp dimmed or recoloured is then solved at once.
    const auto ax = [&](std::uint32_t i, int c) { return double(x_[i][c]) - double(rho_[i][c]) * h_[i][c]; };
    const Sums bax = weighted_sums(n_, channels_, weight_, [&](std::uint32_t i, int c) { return b_[i][c] * ax(i, c); });
    const Sums axax =
        weighted_sums(n_, channels_, weight_, [&](std::uint32_t i, int c) { return ax(i, c) * ax(i, c); });
    std::array<float, max_channels> alpha{};
    for (int c = 0; c < channels_; ++c) {
        const double a = axax[c] > 0 ? bax[c] / axax[c] : 0;
        alpha[c] = static_cast<float>(std::isfinite(a) && a > 0 ? a : 0);
    }
    for_each_vertex(n_, [&](std::uint32_t i) {
        for (int c = 0; c < channels_; ++c) x_[i][c] *= alpha[c], h_[i][c] *= alpha[c];
    });
    refresh_residual();
}

void GatherSystem::set_guess(ChannelField radiosity) {
    x_ = std::move(radiosity);
}

void GatherSystem::set_rows(ChannelField gathered_radiosity) {
    h_ = std::move(gathered_radiosity);
    refresh_residual();
}

void GatherSystem::refresh_residual() {
    directions_.clear();
    sweep_.reset();
    diverged_ = false;
    for_each_vertex(n_, [&](std::uint32_t i) {
        for (int c = 0; c < channels_; ++c) r_[i][c] = b_[i][c] - x_[i][c] + rho_[i][c] * h_[i][c];
    });
    r_norm2_ =
        weighted_sums(n_, channels_, weight_, [&](std::uint32_t i, int c) { return double(r_[i][c]) * r_[i][c]; });
}

double GatherSystem::relative_residual() const {
    double worst = 0;
    for (int c = 0; c < channels_; ++c)
        if (b_norm2_[c] > 0) worst = std::max(worst, std::sqrt(r_norm2_[c] / b_norm2_[c]));
    return worst;
}

void GatherSystem::make_orthogonal(Direction& next, const Direction& old) const {
    const Sums product = weighted_sums(n_, channels_, weight_, [&](std::uint32_t i, int c) {
        return double(times_a(next, i, c)) * times_a(old, i, c);
    });
    std::array<float, max_channels> beta{};
    for (int c = 0; c < channels_; ++c)
        beta[c] = old.norm2[c] > 0 ? static_cast<float>(product[c] / old.norm2[c]) : 0.0f;
    for_each_vertex(n_, [&](std::uint32_t i) {
        for (int c = 0; c < channels_; ++c) {
            next.p[i][c] -= beta[c] * old.p[i][c];
            next.wp[i][c] -= beta[c] * old.wp[i][c];
        }
    });
}

void GatherSystem::take_step(Direction next) {
    next.norm2 = weighted_sums(n_, channels_, weight_, [&](std::uint32_t i, int c) {
        const double a = times_a(next, i, c);
        return a * a;
    });
    const Sums product = weighted_sums(n_, channels_, weight_,
                                       [&](std::uint32_t i, int c) { return double(r_[i][c]) * times_a(next, i, c); });
    std::array<float, max_channels> alpha{};
    for (int c = 0; c < channels_; ++c)
        alpha[c] = next.norm2[c] > 0 ? static_cast<float>(product[c] / next.norm2[c]) : 0.0f;
    for_each_vertex(n_, [&](std::uint32_t i) {
        for (int c = 0; c < channels_; ++c) {
            x_[i][c] += alpha[c] * next.p[i][c];
            h_[i][c] += alpha[c] * next.wp[i][c];
            r_[i][c] -= alpha[c] * times_a(next, i, c);
        }
    });
    r_norm2_ =
        weighted_sums(n_, channels_, weight_, [&](std::uint32_t i, int c) { return double(r_[i][c]) * r_[i][c]; });
    for (int c = 0; c < channels_; ++c) diverged_ = diverged_ || !std::isfinite(r_norm2_[c]);
    if (directions_.size() == kept_directions) directions_.erase(directions_.begin());
    directions_.push_back(std::move(next));
}

bool GatherSystem::sweep(const std::vector<GatherPass>& passes, const std::atomic<bool>& cancel) {
    if (!sweep_) {
        sweep_.emplace();
        sweep_->next = {ChannelField(n_ + 1, channels_), ChannelField(n_, channels_), {}};
        std::copy(r_.values.begin(), r_.values.end(), sweep_->next.p.values.begin());
    }
    if (passes.empty()) sweep_->receiver = n_;
    TimeSlice slice(cancel);
    Direction& next = sweep_->next;
    for (;;) {
        switch (sweep_->part) {
        case Sweep::Part::rows:
            if (!apply_rows(passes, RayEnds::coarse, next.p, sweep_->receiver, next.wp, cancel)) return false;
            sweep_->part = Sweep::Part::orthogonal;
            break;
        case Sweep::Part::orthogonal: // A p to those of the directions that are kept
            if (sweep_->directions < directions_.size())
                make_orthogonal(next, directions_[sweep_->directions++]);
            else
                sweep_->part = Sweep::Part::step;
            break;
        case Sweep::Part::step:
            take_step(std::move(next));
            sweep_.reset();
            return true;
        }
        if (slice.over()) return false;
    }
}

} // namespace lueur
