// Rows of the transport, traced once and kept: for each receiver, which vertices its cosine-distributed rays meet.
//
// This is the lecture's hemisphere with its item buffer, kept: each ray carries an equal share of the form factors, so
// that W_ij = (rays of i that end at vertex j) / (rays of i) and a row sums to the share of rays that hit anything: 1
// in a closed scene. A hit inside an element is given to one of its three vertices, drawn with its interpolation
// weight: linear interpolation, unbiased, one index a ray. Rays come in passes of one size. Even passes continue one
// quasi-random sequence, odd passes another, independent one: long sequences are better spread than many short ones
// (twice the accuracy at 512 rays), and the difference of the two tells the error.
#pragma once

#include <cstdint>
#include <vector>

#include "core/transport/mesh.h"
#include "core/transport/receivers.h"
#include "core/transport/world.h"

namespace lueur {

inline constexpr int rays_per_pass = 32;
inline constexpr std::uint32_t burial_rays = 16; // of find_buried, a vertex
inline constexpr int independent_sets = 2;       // pass p belongs to set p % 2

// Where a ray met the coarse mesh; no_index: nothing that can shine.
struct RayHit {
    static constexpr std::uint32_t untraced = no_index - 1;
    std::uint32_t element = untraced;
    float b1 = 0, b2 = 0;
};

// What the burial rays of each vertex meet: so many a lit side, so many a black back; the others leave the scene. near:
// how many meet something within `near_distance`, m.
struct Surroundings {
    std::vector<std::uint8_t> lit, back, near;
    std::vector<float> distance; // to what is around, harmonic mean, m
    float near_distance = 0;
    std::vector<RayHit> hits; // burial_rays a vertex; none when they are not to be kept
};

// Coarse vertices whose rays mostly meet back faces lie inside a solid (a floor vertex under a block): they take no
// part. Receivers in [first, last) of `origins`; the result is written to buried[first..last), and to `around` there.
// The rays are the first ones of pass 0 of a receiver at that vertex.
void find_buried(const World& world, const Mesh& mesh, const std::vector<glm::vec3>& origins, std::uint32_t seed,
                 std::uint32_t first, std::uint32_t last, std::vector<std::uint8_t>& buried,
                 Surroundings* around = nullptr);

// The same for one place, from where its rays start.
struct LookAround {
    bool buried;
    float distance; // to what is around, harmonic mean, m
};
LookAround look_around(const World& world, glm::vec3 origin, glm::vec3 normal);

struct GatherPass {
    // receivers * rays_per_pass of each. The receiver each ray ended at, drawn among those of the vertices of the
    // element it met on the level of indirect light (the number of receivers where it left the scene or met a black
    // back face), and the fine vertex, drawn among those of the fine element (the number of vertices then): indirect
    // light is read from receivers, direct light from fine vertices.
    std::vector<std::uint32_t> ends;
    std::vector<std::uint32_t> fine_ends;
    std::uint32_t fine_vertices = 0; // the number of vertices then
    // Rays of the first receivers as traced, kept while the mesh still grows: on the next one they end at other
    // vertices, but none is traced again.
    std::vector<RayHit> hits;
};

// hits: of rays of the same pass on the mesh before, of the same receivers, then the first ones.
GatherPass make_gather_pass(const Mesh& mesh, const Receivers& receivers, std::vector<RayHit> hits = {});

// For pass 0: what burial rays have met at the receivers' vertices. hits: burial_rays a vertex, or none.
std::vector<RayHit> hits_of_burial(const Receivers& receivers, const std::vector<RayHit>& hits);

// Traces the rays of receivers [first, last) of pass number `pass` (but for those whose hits are there) and finds where
// they end. origins, buried: of all vertices, coarse ones first. Deterministic for a seed, whatever the chunks and
// threads, and whichever hits were kept. Returns how many rays were traced.
std::uint64_t trace_gather_rays(const World& world, const Mesh& mesh, const std::vector<glm::vec3>& origins,
                                const Receivers& receivers, const std::vector<std::uint8_t>& buried, std::uint32_t seed,
                                std::uint32_t pass, std::uint32_t first, std::uint32_t last, GatherPass& out);

// Share of a receiver's rays that hit something that can shine: the row sum.
double row_sum(const std::vector<GatherPass>& passes, std::uint32_t receiver, std::uint32_t receivers);

} // namespace lueur
