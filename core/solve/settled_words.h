// What a settled solution should say of itself in a line: light that its method has lost or made, that fell on black
// backs, that was never sent, or that lies twice in one plane.
#pragma once

#include <atomic>
#include <string>

#include "core/solve/solution_state.h"

namespace lueur {

// Where the luminous flux goes, lm. Rays of the coarse vertices tell what of it is caught, so that in an open scene
// `sent` is good to a per cent or so, and exact in a closed one.
struct FluxBalance {
    double emitted = 0;
    double sent = 0;     // that leaves surfaces towards lit sides of others
    double arriving = 0; // that arrives there, as the solver has it
    double on_backs = 0; // on black backs of one-sided surfaces
    double unsure = 0;   // of `sent`, from how unlike neighbouring vertices see the scene: 0 in a closed one
    // Of the light there is, the share that the solver has lost; below 0: that it has made. Where all of a closed scene
    // reflects alike and arriving light is too little by a factor, that is the factor, whatever the reflectance:
    // E + (rho - 1) H falls short of 0 by just that share of E.
    double lost_share() const { return emitted > 0 ? (sent - arriving) / emitted : 0; }
};
FluxBalance flux_balance(const Solution::State& state, const Field& field);

// A slice; true at the end.
bool find_overlap(const Mesh& mesh, const World& world, const std::vector<std::uint8_t>& buried,
                  const std::atomic<bool>& cancel, Overlap& overlap);

std::string settled_words(const Solution::State& state, const Field& field); // empty: nothing to be said

} // namespace lueur
