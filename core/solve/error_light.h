// The light whose error is estimated: luminous, at the vertices, apart by where it comes from.
#pragma once

#include <vector>

#include "core/solve/error_mesh.h"
#include "core/solve/field.h"
#include "core/solve/solution_state.h"

namespace lueur {

struct ErrorLight {
    std::vector<float> total, direct, indirect; // lx
    std::vector<float> reflected;               // lm m^-2
    std::vector<float> direct_variance;         // lx^2, of the shadow rays
    std::vector<float> unlit;                   // lx, direct light of luminaires that have not shot yet
    std::vector<double> exitance;               // lm m^-2 of each luminaire whose light is shown
    double mean_indirect = 0;
    double mean = 0;   // lx, over the surfaces that are not buried
    double caught = 1; // of the luminaires' flux by the surfaces: 1 in a closed scene
    // What is shown at a buried vertex is its neighbours' light; beside it, that is off by about a third (RMS against
    // paths at 150 points of each scene: Cornell box 24 %, gallery 25 %, with smaller elements 29 %, office 47 %).
    float at_rim(std::size_t v) const { return 0.33f * total[v]; }
};

// Of the solution as `field` shows it: its irradiance and what is reflected of it.
ErrorLight error_light(const Solution::State& state, const ErrorMesh& mesh, const Field& field);

// Mean over the first `vertices` without the brightest fiftieth of the area: that of a scene is often the light inside
// its lamps' housings. lx.
double usual_light(const ErrorLight& light, const ErrorMesh& mesh, std::uint32_t vertices);

} // namespace lueur
