// Longest-edge bisection of a conforming triangle mesh (Rivara 1984, "Algorithms for refining triangular grids suitable
// for adaptive and multigrid techniques"): splitting an element splits its neighbours as far as needed, so that the
// mesh stays conforming.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/transport/edge_table.h"
#include "core/transport/mesh.h"

namespace lueur {

class Bisection {
public:
    explicit Bisection(Mesh& mesh); // adopts the leaves of `mesh`; the mesh must outlive it
    enum AdoptsLater { adopts_later };
    Bisection(Mesh& mesh, AdoptsLater); // call adopt until it is true before anything else
    bool adopt(const std::atomic<bool>& cancel);

    // Splits leaf `node` (and neighbours, as conformity asks). New vertices and nodes are appended to the mesh.
    void split(std::uint32_t node);

    static std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
        return a < b ? (std::uint64_t(a) << 32 | b) : (std::uint64_t(b) << 32 | a);
    }
    int longest_edge(std::uint32_t node) const { return longest_edge(mesh_, node); }
    float edge_length(std::uint32_t a, std::uint32_t b) const { return edge_length(mesh_, a, b); } // squared
    static int longest_edge(const Mesh& mesh, std::uint32_t node);
    static float edge_length(const Mesh& mesh, std::uint32_t a, std::uint32_t b);

private:
    void bisect(std::uint32_t node, int edge, std::uint32_t midpoint);
    void attach(std::uint32_t node);
    void detach(std::uint32_t node);
    std::uint32_t neighbour(std::uint32_t node, int edge) const;

    Mesh& mesh_;
    EdgeTable edge_leaves_;
    std::uint32_t adopted_ = 0; // so many nodes have been looked at
    bool adopts_ = true;
};

// The list of leaves anew, after splitting.
void list_leaves(Mesh& mesh);

} // namespace lueur
