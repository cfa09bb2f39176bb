// How wrong a field may be: a standard deviation of illuminance at every vertex, and one number for the scene. The
// lecture's chapter 8 has a title only; what is uncertain is this:
//
// - the rays of each receiver: two independent sets differ (ray_budget.h), or what the solver says of its own links;
// - the shadow rays in penumbrae, and beside them (direct_transport.h);
// - interpolation: how much a straight line between vertices misses where the field bends;
// - what is not solved yet: the light still missing, summed over all its reflections, 1 / (1 - rho);
// - the wavelengths: what the channels make of each lamp's light reflected by each paint, against integration.
//
// Where each of them is large is modelled; how large they are is measured, at probes (error_probes.h) where the light
// was gathered once more with other rays. What rays tell of themselves is believed unless the probes know better, since
// a few hundred squares, a few of them large, know a variance to a third at best.
#pragma once

#include <vector>

#include "core/solve/field.h"
#include "core/solve/solution_state.h"

namespace lueur {

// What is kept of the mesh as it is now.
const ErrorMesh& error_mesh_of(const Solution::State& state);

// Fills the error members of a composed field. Everything else of it must be there.
void estimate_error(const Solution::State& state, Field& field);

// Relative RMS (relative_error.h) of `deviation` (and of what is added between vertices) over the surfaces, weighted by
// area; vertices darker than 2 % of the mean and `left_out` ones do not count.
double relative_rms(const std::vector<float>& illuminance, const std::vector<float>& deviation,
                    const std::vector<float>& between, const std::vector<float>& area,
                    const std::vector<std::uint8_t>& left_out);

} // namespace lueur
