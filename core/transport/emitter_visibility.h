// How much of an emitter a point sees, in a penumbra: the emitter's triangles are cut into cells, and those whose
// corners are not all seen or all hidden are cut again. The rays go where the shadow's edge falls on the emitter: an
// edge through n cells is known to about sqrt(n) of them, of which the finest are small.
//
// The lattice is the same for all receivers, so that shadows are smooth from vertex to vertex. What is narrower than a
// quarter of the emitter and lies between the corners is not seen.
#pragma once

#include <cstdint>

#include "core/transport/direct_light.h"
#include "core/transport/world.h"

namespace lueur {

// More triangles are sampled by points instead: a lattice of their own for each costs more than it tells.
inline constexpr std::size_t most_subdivided_triangles = 32;

struct VisibleShare {
    double share = 0;     // of cos cos / r^2 over the emitter, 0..1
    double deviation = 0; // standard deviation of it that the finest cells leave
};

VisibleShare visible_share(const World& world, const Emitter& emitter, glm::vec3 origin, glm::vec3 normal,
                           VisibilityDetail detail, std::uint64_t& rays);

} // namespace lueur
