// Light that is still missing because it is not solved.
#pragma once

#include <vector>

#include "core/solve/error_fit.h"

namespace lueur {

// At each vertex, lx. Probes that are there tell how much is missing on average: the mean residual is one reflection of
// it, all of it 1 / (1 - rho) times that. (What direct light lacks is not reflected either; but at the bottom of a
// lamp's housing it would have stayed there.) Without them it is what is unshot; and before any light is reflected,
// what the rays that told who is buried find at their ends: a drawer lacks less of it than a wall.
std::vector<float> missing_light(const Solution::State& state, const ErrorMesh& mesh, const ErrorLight& light,
                                 const std::vector<Residual>& probes, double rho);

} // namespace lueur
