// Direct light apart: how much of a luminaire's exitance arrives at a point.
//
// D = F * V: F the exact polygon form factor (polygon_form_factor.h), V the visible share, weighted with cos cos / r^2
// (so D is the irradiance for unit exitance), by shadow rays at the shadow's edge (emitter_visibility.h) or, to
// luminaires of many triangles, by stratified ones. Far from a luminaire of many triangles F too
// comes from the stratified points: at four times its diameter they agree to 0.5 %. The points are the same for all
// receivers, so that shadows are smooth from vertex to vertex.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/scene.h"
#include "core/transport/world.h"

namespace lueur {

struct EmitterTriangle {
    std::array<glm::vec3, 3> corners; // counter-clockwise from the emitting side
    glm::vec3 normal;
    float area;
};

struct EmitterPoint {
    glm::vec3 position, normal;
};

// The geometry of one luminaire. Independent of its power and spectrum.
struct Emitter {
    // Windows in a row, lamps in one group: what lies apart is lit and shadowed apart, and has probes of its own.
    // Empty: it is one.
    std::vector<Emitter> parts;
    std::vector<EmitterTriangle> triangles;
    float area = 0;
    glm::vec3 centre{0};
    float radius = 0;                   // of a sphere around it
    bool flat = true;                   // all triangles look the same way
    EmitterPoint one_point{};           // a stratified one, for one ray: of each luminaire another, for middles are the
                                        // last that housings hide
    std::vector<EmitterPoint> probes;   // far apart: all seen or all hidden settles V
    std::vector<EmitterPoint> points;   // stratified by area
    std::vector<float> cumulative_area; // one a triangle, ends at `area`
};

// The point of a triangle with these weights, but not quite at its rim, which a frame may hide.
glm::vec3 inside_emitter(const EmitterTriangle& triangle, glm::vec3 weights);

// cos cos / r^2 from a receiver to a point of an emitter; 0 when one is behind the other.
float emitter_kernel(glm::vec3 origin, glm::vec3 normal, const EmitterPoint& point);
// Whether nothing is between a receiver and a point of an emitter.
bool sees(const World& world, glm::vec3 origin, glm::vec3 target);

std::vector<Emitter> make_emitters(const Scene& scene);

// Exitance of each luminaire as geometry alone lets it be guessed: half of all flux is given out equally, half by area
// (a window is large and sends much, a lamp is small and sends as much as the next). Rays and meshes that follow it are
// not changed by an edit of a lamp.
std::vector<float> guessed_exitances(std::span<const Emitter> emitters);

// A point of the emitter, uniform by area, for u in the unit square.
EmitterPoint emitter_point(const Emitter& emitter, glm::vec2 u);

// How finely penumbrae are known: the light of one luminaire of many, or on something small, matters less.
enum class VisibilityDetail { few_points, some_points, whole_cells, one_cut, two_cuts };

// D for one receiver. `origin` is already off its surface. deviation: the standard deviation of D that the stratified
// points leave (0 where the formula is exact and the probes agree).
float direct_form_factor(const World& world, const Emitter& emitter, glm::vec3 origin, glm::vec3 normal,
                         VisibilityDetail detail, std::uint64_t& rays, float* deviation = nullptr);

// F alone, as if nothing stood between; one kernel where the luminaire is far.
float unshadowed_form_factor(const Emitter& emitter, glm::vec3 origin, glm::vec3 normal);

// The same with `samples` shadow rays of their own random set, for measuring: unbiased visibility.
float direct_form_factor_sampled(const World& world, const Emitter& emitter, glm::vec3 origin, glm::vec3 normal,
                                 int samples, glm::vec2 offset);

} // namespace lueur
