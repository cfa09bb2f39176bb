// Indirect light bends slowly where everything is far away: its neighbours know a receiver's light too, and their rays
// are other rays.
//
// At each vertex a plane is laid through the values around it (local linear regression, Cleveland 1979), as far out as
// a share of the harmonic mean distance to what is around (the radius of Ward, Rubinstein & Clear 1988, "A ray tracing
// solution for diffuse interreflection"), and its value there shown. Gradients are kept, also at a wall's rim; what
// bends away from the plane grows with the square of that share, which therefore shrinks as rays grow in number: noise
// falls with share^2 * rays, the bend's square rises with share^4, and the sum is smallest for share ~ rays^(-1/6).
// A fixed linear map of geometry alone: edits go through it as through the rows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/solve/channel_field.h"
#include "core/transport/mesh.h"

namespace lueur {

// Row v: sum of weight * value of neighbour; an empty row leaves the vertex as it is.
struct Smoothing {
    std::vector<std::uint32_t> first; // one a vertex, and the end
    std::vector<std::uint32_t> neighbour;
    std::vector<float> weight;
    bool empty() const { return neighbour.empty(); }
};

// How far neighbours count, of the distance to what is around, for so many rays a receiver.
float smoothing_reach(std::uint32_t rays);

// Vertices of the level with these elements. distance: m, to what is around each vertex (harmonic mean); neighbours
// count out to `reach` of it, at most `farthest` m.
Smoothing make_smoothing(const Mesh& mesh, std::span<const glm::uvec3> elements, std::span<const std::uint8_t> buried,
                         std::span<const float> distance, float reach, float farthest);

// Beside steep places planes may go below every value they are laid through: also below 0.
void smooth(const Smoothing& smoothing, ChannelField& field);
void smooth(const Smoothing& smoothing, std::vector<float>& values);

} // namespace lueur
