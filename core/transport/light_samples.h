// Where light is computed on meshes of many small triangles: at few of their vertices. The others read it from there.
//
// Light does not know how finely a chair is cut. Coarse vertices that lie close together on one object and look the
// same way are a group; light is computed at one of them, its sample. A vertex that is no sample reads the samples
// around it, of its own object: a plane through them over place and normal (moving least squares: Lancaster &
// Salkauskas 1981), for what arrives at a small thing is nearly linear in the normal. Of geometry alone. Vertices of
// refined walls lie further apart than groups are wide: they are samples, all of them, and nothing is read.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/transport/mesh.h"
#include "core/transport/world.h"

namespace lueur {

struct LightSamples {
    std::vector<std::uint32_t> of_vertex; // the group of each coarse vertex
    std::vector<std::uint32_t> vertex;    // of each group: its sample
    std::vector<std::uint32_t> size;      // of each group: its vertices
    // Of each coarse vertex v, first_reading[v]..first_reading[v + 1]: the groups it reads, and what each counts (>= 0,
    // sum 1). None where it is a sample.
    struct Reading {
        std::uint32_t sample;
        float weight;
    };
    std::vector<std::uint32_t> first_reading;
    std::vector<Reading> readings;
    float cell = 0; // m, edge of the cubes that groups lie in

    std::uint32_t count() const { return static_cast<std::uint32_t>(vertex.size()); }
    bool is_sample(std::uint32_t v) const { return v >= of_vertex.size() || vertex[of_vertex[v]] == v; }
    bool stands_alone(std::uint32_t v) const { return v >= of_vertex.size() || size[of_vertex[v]] == 1; }
    std::span<const Reading> readings_of(std::uint32_t v) const {
        return {readings.data() + first_reading[v], readings.data() + first_reading[v + 1]};
    }
};

// Groups of vertices in cubes of edge `cell`, m, with normals within about 30 degrees; wider ones until there are at
// most three eighths of `most` of them. Then groups are cut where other surfaces are closer than they are wide. A
// sample is the vertex nearest to the middle of its group that does not lie inside a solid, if one does not. origins:
// of the coarse vertices.
LightSamples make_light_samples(const Scene& scene, const Mesh& mesh, const World& world,
                                const std::vector<glm::vec3>& origins, float cell, std::uint32_t most);

// How many there would be of the scene's own vertices.
std::uint32_t count_light_samples(const Scene& scene, float cell, std::uint32_t most);

} // namespace lueur
