// Where a solution is asked whether it is right: points at vertices and between them, each with light gathered by rays
// of its own.
//
// A probe's rays read the solution's own field, so that what they gather less what the field says there is the residual
// of the radiosity equation at that point (an a posteriori estimate: Arvo, Torrance & Smits 1994, "A framework for the
// analysis of error in global illumination algorithms"). Rays are traced once and kept, as the solver's are: asking
// again after an edit costs no ray. Placed by geometry only, so that no edit of a lamp or a paint moves them.
//
// Direct light is gathered by both sets of rays, those to the luminaires and those of the hemisphere that meet one
// (multiple importance sampling, balance heuristic: Veach & Guibas 1995): of a window's sky behind slats, a sliver is
// seen, near and large, which dozens of shadow rays to all of the sky miss.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/transport/direct_transport.h"
#include "core/transport/mesh.h"
#include "core/transport/world.h"

namespace lueur {

// That tell the error of a solution: more of them where there are many small surfaces to be wrong on.
inline std::uint32_t probe_count(const Mesh& mesh) {
    return std::clamp(static_cast<std::uint32_t>(mesh.elements.size() / 150), 400u, 800u);
}

// A point: their own noise, which is known and taken off, must not hide the error that is asked about.
inline int probe_rays(double target_error) {
    return std::clamp(static_cast<int>(512 * std::pow(0.02 / target_error, 2)) / 32 * 32, 128, 512);
}

struct ErrorProbes {
    struct Point {
        glm::vec3 origin, normal;
        glm::uvec3 vertices; // of a leaf, and what each counts; all the same for a probe at a vertex
        glm::vec3 weights;
        float area; // m^2 that it stands for: probes are denser where direct light is uncertain
        bool between;
        float reach; // m, two elements
        float near;  // share of its rays that end within reach, where the field errs as it does here
    };
    static constexpr int shadow_rays = 48; // a point and luminaire
    static constexpr int sets = 4;         // independent parts of all rays of a point, which know their own spread

    int rays = 0;                                    // a point
    std::vector<std::uint32_t> luminaire_of_element; // of coarse elements; no_index: not of one
    std::vector<Point> points;
    std::vector<float> direct;       // points * sets * emitters: D
    std::vector<std::uint32_t> ends; // points * rays, set by set: the fine vertex each ray ends at; no_index: outside
    std::uint32_t cursor = 0;
    bool complete() const { return !points.empty() && cursor == points.size(); }
};

// Chooses about `count` points on the mesh as it is now, half of them at vertices, each to have `rays` of them.
void place_probes(const World& world, const Mesh& mesh, const DirectTransport& direct,
                  const std::vector<std::uint8_t>& buried, std::vector<std::uint32_t> luminaire_of_element,
                  std::uint32_t count, int rays, std::uint32_t seed, ErrorProbes& probes);

// Traces them by one time slice; true at the end.
bool trace_probes(const World& world, const Mesh& mesh, const DirectTransport& direct,
                  const std::vector<std::uint8_t>& buried, std::uint32_t seed, const std::atomic<bool>& cancel,
                  ErrorProbes& probes);

} // namespace lueur
