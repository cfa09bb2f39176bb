#include "core/transport/receivers.h"

#include <array>
#include <cmath>
#include <unordered_map>

namespace lueur {

namespace {

// Of the cell, along the look. The inner walls of a tube look as the outer ones of its other side do and see another
// light, a hand's breadth away.
constexpr float depth_share = 0.25f;

// Object, place, look, depth along it, buried.
using Key = std::array<std::int64_t, 9>;
struct KeyHash {
    std::size_t operator()(const Key& key) const {
        std::uint64_t hash = 0x9e3779b97f4a7c15ull;
        for (const std::int64_t k : key) {
            hash = (hash ^ static_cast<std::uint64_t>(k)) * 0xff51afd7ed558ccdull;
            hash ^= hash >> 32;
        }
        return hash;
    }
};

} // namespace

Receivers make_receivers(const Scene& scene, const Mesh& mesh, const std::vector<std::uint8_t>& buried, float cell) {
    struct Cluster {
        glm::vec3 sum{0};
        std::uint32_t count = 0;
    };
    std::unordered_map<Key, std::uint32_t, KeyHash> known;
    known.reserve(mesh.coarse_vertex_count);
    std::vector<Cluster> clusters;
    Receivers receivers;
    receivers.of_vertex.resize(mesh.coarse_vertex_count);
    for (std::uint32_t v = 0; v < mesh.coarse_vertex_count; ++v) {
        const MeshVertex& vertex = mesh.vertices[v];
        const glm::ivec3 place(glm::floor(vertex.position / cell));
        const glm::ivec3 look(glm::round(2.0f * vertex.normal));
        const auto depth = static_cast<std::int64_t>(
            std::floor(glm::dot(vertex.position, 0.5f * glm::vec3(look)) / (depth_share * cell)));
        const auto object = static_cast<std::uint32_t>(at(scene.geometry->surfaces[vertex.surface].object));
        const Key key{object, place.x, place.y, place.z, look.x, look.y, look.z, depth, buried[v]};
        const auto [found, fresh] = known.try_emplace(key, static_cast<std::uint32_t>(clusters.size()));
        if (fresh) clusters.push_back({});
        clusters[found->second].sum += vertex.position;
        ++clusters[found->second].count;
        receivers.of_vertex[v] = found->second;
    }
    // The vertex nearest to the middle stands for its cluster.
    receivers.vertex.assign(clusters.size(), no_index);
    std::vector<float> nearest(clusters.size(), 1e30f);
    for (std::uint32_t v = 0; v < mesh.coarse_vertex_count; ++v) {
        const std::uint32_t r = receivers.of_vertex[v];
        const glm::vec3 d = mesh.vertices[v].position - clusters[r].sum / float(clusters[r].count);
        const float distance = glm::dot(d, d);
        if (distance < nearest[r]) nearest[r] = distance, receivers.vertex[r] = v;
    }
    for (const std::uint32_t v : receivers.vertex) receivers.buried.push_back(buried[v]);
    return receivers;
}

Receivers receivers_of(const LightSamples& samples, const std::vector<std::uint8_t>& buried) {
    Receivers receivers{samples.of_vertex, samples.vertex, {}};
    for (const std::uint32_t v : receivers.vertex) receivers.buried.push_back(buried[v]);
    return receivers;
}

void add_receivers(std::uint32_t vertices, const std::vector<std::uint8_t>& buried, Receivers& receivers) {
    for (auto v = static_cast<std::uint32_t>(receivers.of_vertex.size()); v < vertices; ++v) {
        receivers.of_vertex.push_back(receivers.count());
        receivers.vertex.push_back(v);
        receivers.buried.push_back(buried[v]);
    }
}

} // namespace lueur
