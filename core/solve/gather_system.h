// The gathered system (I - rho W) U = rho G, solved for all channels at once on kept rows.
//
// G: irradiance after one reflection of direct light, gathered from the fine vertices where direct light is kept. U:
// the part of the radiosity that indirect light is reflected into, at the coarse vertices, W m^-2 nm^-1. W:
// gather_rows.h. H = G + W U is the indirect irradiance. Method: generalised conjugate residuals, truncated (Eisenstat,
// Elman & Schultz 1983, Orthomin(k)): one application of W a sweep, and the residual of no channel ever grows. W by
// random rays is not symmetric; each channel is its own system: the coefficients are per channel.
//
// Sweeps to a residual of 1e-3 on the Cornell box (2,886 receivers, 256 rays) with all paints of one reflectance:
//
//     rho                                                      0.5    0.7    0.9   0.99
//     Jacobi                                                     9     15     30     53
//     this, 4 directions kept (1, 2, 8 and all: the same)        5      6      8     10
//     BiCGSTAB (van der Vorst 1992)                              5      7     10     12
//     conjugate gradients on the normal equations               19     31     49     67
//     conjugate gradients on rows made reciprocal            2 x 6  2 x 9 2 x 34 2 x 31
//
// Rows made reciprocal, (A W + W^T A) / 2, do not sum to 1 any more: their solution is off by 3.7 % at 0.5, and at 0.9
// they have no definite one (off by 328 %).
#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <span>
#include <vector>

#include "core/solve/channel_field.h"
#include "core/transport/gather_rows.h"

namespace lueur {

// out_i = mean over all rays of all passes of field[end of ray]. `field` has one more row than vertices, which is zero:
// the outside. False (and out undefined) when cancelled.
enum class RayEnds { coarse, fine };
bool apply_rows(std::span<const GatherPass> passes, RayEnds ends, const ChannelField& field, ChannelField& out,
                const std::atomic<bool>& cancel);

// One time slice of it, from `cursor` on; true at the end.
bool apply_rows(std::span<const GatherPass> passes, RayEnds ends, const ChannelField& field, std::uint32_t& cursor,
                ChannelField& out, const std::atomic<bool>& cancel);

class GatherSystem {
public:
    GatherSystem() = default;
    // weight: of each vertex in norms, its area; rho: n rows.
    GatherSystem(std::uint32_t vertices, int channels, std::vector<float> weight);

    // A new right side (rho * G) and reflectance; keeps the solution so far as the first guess, scaled in each channel
    // so that its residual is smallest. Needs no ray and no application of W.
    void set_sources(const ChannelField& rho, const ChannelField& gathered);
    // The same with a first guess of one's own: `radiosity` has n + 1 rows, `gathered_radiosity` is W of it.
    void set_sources(const ChannelField& rho, const ChannelField& gathered, ChannelField radiosity,
                     ChannelField gathered_radiosity);
    void set_guess(ChannelField radiosity);         // n + 1 rows; set_rows and set_sources are still to come
    void set_rows(ChannelField gathered_radiosity); // other rays: W U of them

    // Brings a sweep forward by one time slice; true when it is through, and nothing has changed before.
    bool sweep(const std::vector<GatherPass>& passes, const std::atomic<bool>& cancel);
    bool sweeping() const { return sweep_.has_value(); } // one is going on

    std::uint32_t count() const { return n_; } // receivers
    double relative_residual() const; // worst channel: |r| / |b|, area-weighted 2-norms; 0 for a channel without light
    bool diverged() const { return diverged_; }

    const ChannelField& radiosity() const { return x_; } // U; n + 1 rows, the last zero
    const ChannelField& gathered() const { return h_; }  // W U
    const ChannelField& residual() const { return r_; }  // unshot radiosity

private:
    struct Direction {
        ChannelField p, wp;
        std::array<double, max_channels> norm2{}; // of A p
    };
    // A sweep that is going on: what there will be one more direction of.
    struct Sweep {
        enum class Part { rows, orthogonal, step };
        Part part = Part::rows;
        Direction next;
        std::uint32_t receiver = 0; // rows: so many are applied
        std::size_t directions = 0; // orthogonal to so many
    };
    void set_right_side(const ChannelField& rho, const ChannelField& gathered);
    void refresh_residual();
    float times_a(const Direction& d, std::uint32_t i, int c) const { return d.p[i][c] - rho_[i][c] * d.wp[i][c]; }
    void make_orthogonal(Direction& next, const Direction& old) const;
    void take_step(Direction next);

    static constexpr int kept_directions = 4;
    std::uint32_t n_ = 0;
    int channels_ = 0;
    std::vector<float> weight_;
    ChannelField rho_, b_, x_, h_, r_;
    std::vector<Direction> directions_;
    std::optional<Sweep> sweep_;
    std::array<double, max_channels> b_norm2_{}, r_norm2_{};
    bool diverged_ = false;
};

} // namespace lueur
