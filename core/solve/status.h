// What a solution says of itself: how far it is, what it cost, how wrong it still may be.
#pragma once

#include <cstdint>
#include <string>

#include "core/transport/mesh.h"

namespace lueur {

enum class SolveStage { idle, meshing, direct, gathering_rays, form_factors, solving, settled, failed };
std::string to_string(SolveStage stage);

struct ConvergencePoint {
    double seconds = 0;      // of solve time since the last restart or edit that made the solution stale
    double unshot_share = 1; // unshot (or residual) luminous flux / emitted flux
    double error = 1;        // estimated relative RMS error of irradiance
};

struct SolveStatus {
    SolveStage stage = SolveStage::idle;
    double progress = 0; // 0..1 of the stage
    bool settled =
        false; // nothing is left to do: what the solver can lower of its error is below the target, or at its limit
    bool paused = false;
    double unshot_share = 1; // as ConvergencePoint
    double estimated_error = 1;
    double emitted_lumens = 0;
    double seconds = 0;           // solve time since the last stale edit
    double last_edit_seconds = 0; // solve time from the last edit to the first picture that settled it; 0: not yet
    std::uint64_t rays = 0;
    std::uint64_t paths = 0; // of the reference solver
    std::uint64_t row_entries = 0;
    std::uint32_t rays_per_receiver = 0;
    std::uint32_t sweeps = 0, shots = 0;
    double residual = 1;              // |r| / |E| of the system solved, worst channel; hierarchical: change in a sweep
    std::uint32_t matrix_patches = 0; // that a full matrix would have here; known once there is a mesh
    std::uint64_t form_factor_cost = 0; // rays, pixels or kernel evaluations, for form factors between patches
    // Pairs of patches that face each other; those for which the method is outside its region (for item buffers: below
    // their resolution); those that no pixel met though they see each other.
    std::uint64_t form_factor_pairs = 0, form_factors_warned = 0, form_factors_missed = 0;
    std::uint64_t matrix_bytes = 0; // and the memory it takes, taken only by the solvers that keep one
    std::uint32_t links = 0, link_elements = 0, link_levels = 0, link_rounds = 0; // hierarchical
    std::uint64_t final_gather_bytes = 0; // hierarchical: memory of the last gather, stated before it is taken
    double error_bound = 0;               // hierarchical: mean relative error if all links err the same way
    std::uint32_t receivers = 0, vertices = 0, elements = 0;
    std::uint32_t shooting_patch = no_index; // patch of the mesh that shot last; no_index: a luminaire, or none
    std::string wavelengths;                 // what the channels are, in a line
    double predicted_colour_error = -1; // CIEDE2000 at worst, of auto and folded wavelengths; below 0: not predicted
    std::string message;                // a warning the user should read (no light, open scene...), or why it failed
};

} // namespace lueur
