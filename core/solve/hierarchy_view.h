// A hierarchy to look at: which links light a place, and how finely it is cut. Immutable, any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/solve/hierarchy.h"

namespace lueur {

struct HierarchyView {
    ElementTree tree;
    std::vector<Link> links;               // by receiver
    std::vector<std::uint32_t> first_link; // of each node, one more than nodes
    std::vector<float> brightness;         // luminous exitance of each node, lm m^-2
    std::uint32_t levels = 0;              // cuts of the most finely cut surface
};

// luminous: Y of one unit of each channel, lm/W.
HierarchyView view_hierarchy(const Hierarchy& hierarchy, std::span<const double> luminous);

// The element under a point of a coarse element of the mesh; no_index where there is none.
std::uint32_t element_at(const HierarchyView& view, const Mesh& mesh, std::uint32_t coarse_element, glm::vec3 point);

struct LinkLine {
    glm::vec3 from, to;               // middle of the receiver that holds the link, of the source
    float form_factor = 0;            // F_rs
    float irradiance = 0;             // F_rs B_s, lx
    std::uint16_t receiver_above = 0; // how many nodes above the element the link stands
    bool cluster = false;             // the source is one
};
// All links that light an element: its own and those of the nodes above it, the brightest first.
std::vector<LinkLine> links_of(const HierarchyView& view, std::uint32_t element);

} // namespace lueur
