// Level by level: the edges of a mesh's leaves at whose middles something is looked at, and the leaves that are split
// because it was not what the ends had promised. What is looked at is the caller's.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/transport/bisection.h"
#include "core/transport/mesh.h"

namespace lueur {

// What becomes of the room there is where it is too small for all that is bent: as far as it goes, or kept for finer
// levels of what is worth most.
enum class Room { as_far_as_it_goes, for_finer_levels };

class EdgeRefinement {
public:
    explicit EdgeRefinement(Mesh& mesh, Room room = Room::as_far_as_it_goes); // `mesh` must outlive it

    struct Edge {
        std::uint32_t a, b;
        glm::vec3 inward{0}; // sum of the middles of the elements at it,
        int elements = 0;    // so many
    };
    struct Place {
        glm::vec3 origin, normal; // off the surface, where rays start
    };

    void follow_mesh(); // it was cut by someone else

    // What is the caller's of a level. collect: calls collect(); look: at the middles of edges(), one time slice, true
    // at the end; bent: of each edge, by how much its middle is off, 0: straight; split: calls split().
    struct Level {
        std::function<bool()> collect, look;
        std::function<std::vector<float>()> bent;
        std::function<void()> split;
    };
    // Brings a level forward by one part of it, in slices that end when time is up; true when it has ended.
    bool step(const Level& level, const std::atomic<bool>& cancel);
    bool begun() const { return first_node_ > 0; }

    // A new level, one time slice of it, true at the end: the edges of the leaves made since the last one, but of
    // leaves whose longest edge is shorter than `smallest`, m, those that were straight before, and those that are not
    // `wanted`.
    bool collect(float smallest, const std::function<bool(std::uint32_t a, std::uint32_t b)>& wanted,
                 const std::atomic<bool>& cancel);
    const std::vector<Edge>& edges() const { return edges_; }
    Place middle(const Edge& edge, float epsilon) const;

    // Splits the leaves at bent edges (and neighbours, as conformity asks), the largest misfits by area first, until
    // there are `most_vertices`, and lists the leaves anew.
    void split(std::uint32_t most_vertices);
    // The edge of this level whose middle a new vertex is; no_index: it was made for conformity.
    std::uint32_t edge_of(std::uint32_t vertex) const;

private:
    bool prepare(const std::atomic<bool>& cancel); // finds the leaves at each edge
    void judge(std::vector<float> bent);
    bool plan_split(const std::atomic<bool>& cancel); // finds the leaves at bent edges

    Mesh& mesh_;
    Room room_;
    enum class Part { prepare, collect, look, plan, split } part_ = Part::prepare; // of a level
    std::optional<Bisection> bisection_; // made when edges are first asked for
    std::vector<Edge> edges_;
    std::unordered_map<std::uint64_t, std::uint32_t> edge_slot_;
    std::unordered_map<std::uint64_t, std::uint8_t> straight_; // edges of earlier levels whose middle was right
    std::vector<std::uint32_t> open_;                          // leaves of this level
    std::uint32_t next_node_ = 0, first_node_ = 0;             // first_node_: where the last whole level ended
    bool collecting_ = false;
    std::size_t cursor_ = 0; // of open_, or of the edges and then of open_
    std::vector<float> bent_;
    std::vector<std::pair<float, std::uint32_t>> wanted_; // misfit by area, leaf
};

} // namespace lueur
