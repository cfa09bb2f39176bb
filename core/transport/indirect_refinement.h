// Where indirect light needs more receivers than the coarse mesh has: at contacts and in narrow places, where what
// little of the room is seen changes within an element.
//
// Indirect light changes over distances of the order of those to the surfaces around (Ward, Rubinstein & Clear 1988):
// only edges longer than a part of them are looked at. There the light of one ray set is compared at the middle and
// at both ends; the same directions at all three leave what changes, not the noise. What the rays meet is grey and
// lit by luminaires as guessed_exitances has them, so that no edit of a lamp or a paint changes the mesh.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/transport/direct_transport.h"
#include "core/transport/edge_refinement.h"
#include "core/transport/mesh.h"
#include "core/transport/world.h"

namespace lueur {

struct IndirectParams {
    float tolerance = 0.04f;    // relative misfit of an edge's middle that splits it
    float smallest_element = 0; // m, longest edge: smaller coarse elements are left alone,
    float smallest_edge = 0;    // and elements of that size are not cut any more
    std::uint32_t most_vertices = 60000;
    Room room = Room::as_far_as_it_goes;
};

class IndirectRefinement {
public:
    // The coarse vertices of `mesh` are lit by `direct`; all outlive it. Nothing else may cut the mesh meanwhile.
    // buried, distance: of the coarse vertices (find_buried).
    IndirectRefinement(const World& world, Mesh& mesh, const DirectTransport& direct, std::vector<std::uint8_t> buried,
                       std::vector<float> distance, const IndirectParams& params);

    // Brings it forward by one time slice; true at the end. The mesh may have grown.
    bool step(const std::atomic<bool>& cancel);

    // At the end, of the mesh's vertices then:
    const std::vector<std::uint8_t>& buried() const { return buried_; }
    const std::vector<glm::vec3>& origins() const { return origins_; }
    const std::vector<float>& distance() const { return distance_; } // to what is around, harmonic mean, m
    std::uint64_t rays() const { return rays_.load(); }

private:
    struct Seen {
        float light = -1, distance = 0; // guessed irradiance, < 0: not gathered yet; m, harmonic mean
        bool buried = false;
    };
    Seen gather(glm::vec3 origin, glm::vec3 normal) const;
    bool is_close(std::uint32_t a, std::uint32_t b) const;
    bool begin_level(const std::atomic<bool>& cancel);
    bool look(const std::atomic<bool>& cancel);
    std::vector<float> bent_edges(); // their misfits, 0 where they are straight
    void split_bent();

    const World& world_;
    Mesh& mesh_;
    const IndirectParams params_;
    const LightSamples& samples_;
    EdgeRefinement edges_;
    std::vector<float> radiosity_; // grey, at coarse vertices
    std::vector<float> direct_;    // guessed, at all vertices
    float floor_ = 0;              // darker than this a relative error is not seen
    std::vector<std::uint8_t> buried_;
    std::vector<float> distance_;
    std::vector<float> light_; // < 0: not gathered
    std::vector<glm::vec3> origins_;

    std::vector<std::uint32_t> corners_; // vertices that the edges of this level ask for
    std::vector<Seen> seen_;             // of the edges, then of the corners
    std::uint32_t cursor_ = 0;
    bool done_ = false;
    mutable std::atomic<std::uint64_t> rays_{0};
};

} // namespace lueur
