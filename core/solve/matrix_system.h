// B_i = E_i + rho_i sum_j F_ij B_j on the full matrix, for all channels at once: the lecture's solvers.
//
// Held are x, the radiosity that has been sent out, h = F x, the irradiance it gives, and the unshot radiosity
// r = E + rho h - x, which is the residual of x. Each method moves x its own way; B is E + rho h, or x itself after
// Gauss-Seidel. The lecture's slips are mended: K_ii = 1 - rho_i F_ii (correction 29), Gauss-Seidel subtracts K_ij B_j
// (30), shooting sends rho_i dB_j F_ij, starts at B = E, takes dB_j away after all have received, and weighs all
// wavelengths in its choice (31-34).
//
// Convergence, for rho row_sum < 1: Jacobi's residual and Gauss-Seidel's change from sweep to sweep fall in the largest
// norm by that factor or better. Shots of the largest unshot flux converge because F >= 0 (Southwell relaxation;
// Gortler, Cohen & Slusallek 1994), and where F is reciprocal the unshot flux falls with every one.
// Double precision: F is given in float, but what is solved is solved.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/solve/matrix_products.h"

namespace lueur {

class MatrixSystem {
public:
    MatrixSystem() = default;
    // The matrix must outlive the system. weight: of each channel in the choice of a shooter and in "unshot flux".
    MatrixSystem(const FormFactorMatrix& matrix, int channels, std::vector<float> weight);

    // New exitances and reflectances, 0 <= rho <= 1. What was sent so far stays as the first guess: no row is read.
    void set_sources(PatchField rho, PatchField exitance);

    // Each goes on until a sweep is complete (true), its time slice is over or `cancel` is set (false: again).
    bool jacobi_sweep(const std::atomic<bool>& cancel);
    bool gauss_seidel_sweep(const std::atomic<bool>& cancel);

    // One shot of the patch with the largest unshot flux; false when nothing is unshot. With `over` it shoots also what
    // the ambient light has yet to bring it (Feda & Purgathofer 1992), and what is unshot there becomes negative until
    // it has come. Guarded, channel by channel: where the flux unshot in all patches, sign or no sign, would not fall
    // by at least half of what a plain shot takes off it, the shot is a plain one; and when the flux unshot has not
    // halved in `patience` shots a patch, all are.
    bool shoot(bool over);

    double unshot_share() const;      // weighted unshot flux, without its sign, / emitted flux; 1 where not yet known
    double relative_residual() const; // worst channel: |r| / |E|, largest norm, of the iterate before the last sweep
    bool residual_known() const { return residual_known_; }
    std::uint32_t last_shooter() const { return last_shooter_; } // no_index: none
    std::uint64_t overshots() const { return overshots_; }
    bool overshooting_given_up() const { return given_up_; }

    const PatchField& radiosity() const { return b_; }  // as of the last sweep or refresh
    const PatchField& irradiance() const { return h_; } // F x
    const PatchField& unshot() const { return r_; }
    void refresh(); // after shots: radiosity, residual, and sums that have rounded

    static constexpr double patience = 4;

private:
    void note_residual(); // of r_, which is exact
    void find_flux();     // of each patch, from r_
    double send(std::uint32_t j, const double* amount, double* l1_change, double* sent_on);

    const FormFactorMatrix* matrix_ = nullptr;
    int channels_ = 0;
    std::vector<float> weight_;
    PatchField rho_, e_, x_, h_, r_, b_;
    double area_ = 0;
    std::vector<double> mean_rho_; // over area, of each channel
    double emitted_ = 0, unshot_ = 0, residual_ = 1;
    bool residual_known_ = false;

    std::uint32_t cursor_ = 0; // rows of the sweep that are done
    PatchField next_, left_;   // Jacobi: F b so far; Gauss-Seidel: sum_{j<i} F_ij x_j of its last sweep
    bool left_known_ = false, any_sent_ = false;
    bool h_exact_ = true; // h is F x: not between and after Gauss-Seidel sweeps

    std::uint32_t last_shooter_ = no_index;
    std::uint64_t overshots_ = 0;
    std::vector<double> signed_; // sum_i A_i r_i of each channel: what ambient light there is
    std::vector<double> flux_;   // weighted unshot flux of each patch, without sign; its sum is unshot_
    bool flux_known_ = false, given_up_ = false;
    double halved_from_ = 0; // unshot flux when it last had halved
    std::uint64_t shots_since_halved_ = 0;
};

// In a part of the scene that keeps all its light the radiosity grows without end. True when some patch that emits,
// in some channel, can reach only patches with rho = 1 and row sums of 1.
bool has_no_finite_solution(const FormFactorMatrix& matrix, const RowSums& sums, const PatchField& rho,
                            const PatchField& exitance, int channels);

} // namespace lueur
