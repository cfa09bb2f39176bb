// Level by level: the edges of a mesh's leaves at whose middles something is looked at, and the leaves that are split
// because it was not what the ends had promised. What is looked at is the caller's.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
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
    EdgeRefinement(Mesh& mesh, std::uint32_t most_vertices, Room room); // `mesh` must outlive it

    struct Edge {
        std::uint32_t a, b;
        glm::vec3 inward{0}; // sum of the middles of the elements at it,
        int elements = 0;    // so many
        float reach = 0;     // the longest edge of these, squared
    };
    struct Place {
        glm::vec3 origin, normal; // off the surface, where rays start
    };

    void follow_mesh(); // it was cut by someone else

    // What is the caller's of a level. collect: calls collect(); look: at the middles of those edges() that are asked,
    // one time slice, true at the end; bent: of each of these, by how much its middle is off, 0: straight; split: calls
    // split(). Look and bent may come twice, for other edges.
    struct Level {
        std::function<bool()> collect, look;
        std::function<std::vector<float>()> bent;
        std::function<void()> split;
        float largest_bend = std::numeric_limits<float>::infinity(); // that there can be
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
    // Where there is room for few leaves, the edges of large ones are asked first, and those of small ones only if
    // these could be worth as much.
    bool is_asked(const Edge& edge) const { return edge.reach >= asked_from_ && edge.reach < asked_below_; }
    Place middle(const Edge& edge, float epsilon) const;

    // Splits the leaves at bent edges (and neighbours, as conformity asks), the largest misfits by area first, until
    // there are most_vertices, and lists the leaves anew.
    void split();
    // The edge of this level whose middle a new vertex is; no_index: nobody looked there, it was made for conformity.
    std::uint32_t edge_of(std::uint32_t vertex) const;

private:
    bool prepare(const std::atomic<bool>& cancel); // finds the leaves at each edge
    void ask_first(float largest_bend);
    bool ask_more(float largest_bend); // false: what is left cannot be worth it
    void judge(const std::vector<float>& bent);
    bool plan_split(const std::atomic<bool>& cancel); // finds the leaves at bent edges
    double room() const { return double(most_vertices_) - double(mesh_.vertices.size()); }

    Mesh& mesh_;
    std::uint32_t most_vertices_;
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
    float asked_from_ = 0, asked_below_ = std::numeric_limits<float>::infinity(); // of Edge::reach
    std::vector<float> bent_;
    std::vector<std::pair<float, std::uint32_t>> wanted_; // misfit by area, leaf; the largest first
    float least_ = 0;                                     // of it that is cut
};

} // namespace lueur
