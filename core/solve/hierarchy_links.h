// Links: who shines on whom, and with what form factor.
//
// One convention: a link stands in its receiver's list and holds F_rs, the share of what leaves r that would reach s,
// so that r gathers H_r += F_rs B_s (LECTURE corrections 38-40). Four points stand for each node. F between two
// elements is taken from the smaller one, so that A_r F_rs = A_s F_sr holds to rounding for both links of a pair; an
// element that lies in part inside a solid has only the rest as its area. What is behind the receiver's horizon or the
// source's plane does not count.
#pragma once

#include <cstdint>
#include <vector>

#include "core/solve/hierarchy_tree.h"
#include "core/transport/world.h"

namespace lueur {

inline constexpr int link_points = 4;

// Where rays of a node start and end: off their surface, not inside solids.
struct NodePoints {
    std::array<glm::vec3, link_points> position, normal;
    int count = 0; // 0: all of the node lies inside solids
};

// Looks around a node from points of it: sets its live_share and closed, and gives the points that stand for it.
// Elements much larger than `small` (m^2) are looked at from more places.
NodePoints look_around(const World& world, ElementTree& tree, std::uint32_t node, float small);

enum class LinkKernel {
    disks,   // the lecture's: the source in parts, each a disk, dA cos cos / (pi r^2 + dA). Loses energy
    polygon, // exact from points to the whole source, times the visible share; clusters still as disks
};

struct LinkEstimate {
    float form_factor = 0; // F_rs
    float spread = 0; // standard deviation of F over the receiver, and standard error of F from few points and rays
    std::uint32_t rays = 0;
};

// F_rs and F_sr = F_rs A_r / A_s. Deterministic; the same visibility for both directions.
LinkEstimate estimate_link(const World& world, const ElementTree& tree, const std::vector<NodePoints>& points,
                           std::uint32_t receiver, std::uint32_t source, LinkKernel kernel);

// Share of an element's corners, seen from a point, that are not hidden; of those before it and above its horizon. For
// elements of which no inner point is seen from there: slivers above an edge.
double visible_corners(const World& world, const ElementTree& tree, glm::vec3 position, glm::vec3 normal,
                       std::uint32_t node, std::uint64_t& rays);

// False where one lies wholly behind the other, so that no light is exchanged.
bool can_face(const ElementTree& tree, std::uint32_t a, std::uint32_t b);

// The lecture's estimate F ~ cos(theta) Omega / pi: Omega of a disk around the source, theta at the receiver's centre,
// towards the disk's edge where the receiver sees that better (a source of which the centre is below the horizon).
float lecture_form_factor(const ElementTree& tree, std::uint32_t receiver, std::uint32_t source);

} // namespace lueur
