// The reference as a solution: irradiance traced at every vertex of the mesh, pass by pass.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/solve/channel_field.h"
#include "core/solve/path_tracer.h"

namespace lueur {

// One pass is one path of each batch at each vertex that is not buried. Numbers may be read between passes and within
// one: each vertex knows how many it has had.
struct TracedField {
    PathLights lights;
    std::vector<glm::vec3> origins;
    std::vector<std::uint8_t> buried;
    std::vector<double> sums;    // vertices * channels
    std::vector<double> batches; // vertices * path_batches: sums of illuminance, lx
    int channels = 0;
    bool cut_short = false;               // a path had to be ended: all of this is of no use
    std::uint32_t passes = 0, cursor = 0; // complete ones, and the vertex where the next goes on

    std::uint32_t passes_at(std::uint32_t v) const { return passes + (v < cursor ? 1 : 0); }
    // Per channel; 0 before the first pass of the vertex.
    void irradiance(std::uint32_t v, float* out) const;
    double standard_error(std::uint32_t v) const; // of the illuminance, lx
};

TracedField make_traced_field(const Solution::State& state);

// One time slice; true at the end of a pass.
bool trace_pass(const Solution::State& state, const std::atomic<bool>& cancel, TracedField& field);

} // namespace lueur
