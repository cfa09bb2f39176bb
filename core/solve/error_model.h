// Where each cause of error is large: variances of illuminance at the vertices, before probes have told how large.
#pragma once

#include "core/solve/error_light.h"
#include "core/solve/error_mesh.h"
#include "core/solve/solution_state.h"

namespace lueur {

// Variances by cause, at the fine vertices, lx^2.
struct ErrorModel {
    std::vector<float> direct;  // of the shadow rays
    std::vector<float> hidden;  // of luminaires that none of the shadow rays has found: a tenth of the light
    std::vector<float> rays;    // of what a solver knows of its own indirect light
    std::vector<float> bent;    // of indirect light, as far as it differs from vertex to vertex
    std::vector<float> between; // added between the vertices
    // Of light that is read at samples (light_samples.h): by how much these differ.
    std::vector<float> read_direct, read_indirect;
    bool known = false; // the solver says something of its own error
};

// At how many vertices, the first ones, indirect light is solved; the others interpolate it.
std::uint32_t solved_vertices(const Solution::State& state);
// Whether direct light is shown as the transport has it, not through a solver's form factors.
bool shows_direct_apart(const Solution::State& state);

ErrorModel error_model(const Solution::State& state, const ErrorMesh& mesh, const ErrorLight& light);

} // namespace lueur
