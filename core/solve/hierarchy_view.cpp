#include "core/solve/hierarchy_view.h"

#include <algorithm>

namespace lueur {

HierarchyView view_hierarchy(const Hierarchy& hierarchy, std::span<const double> luminous) {
    HierarchyView view;
    view.tree = hierarchy.tree();
    view.links = hierarchy.links();
    const std::size_t nodes = view.tree.nodes.size();
    view.first_link.assign(nodes + 1, 0);
    for (const Link& link : view.links) ++view.first_link[link.receiver + 1];
    for (std::size_t n = 0; n < nodes; ++n) view.first_link[n + 1] += view.first_link[n];
    for (std::uint32_t n = 0; n < nodes; ++n) {
        double y = 0;
        for (std::size_t c = 0; c < luminous.size(); ++c) y += luminous[c] * double(hierarchy.radiosity()[n][c]);
        view.brightness.push_back(static_cast<float>(y));
    }
    view.levels = hierarchy.level_count();
    return view;
}

std::uint32_t element_at(const HierarchyView& view, const Mesh& mesh, std::uint32_t coarse_element, glm::vec3 point) {
    if (coarse_element >= mesh.coarse_element_count) return no_index;
    const std::uint32_t root =
        view.tree.root_of_triangle[mesh.coarse_triangle[coarse_element]][mesh.coarse_back[coarse_element]];
    return root == no_index ? no_index : leaf_under(view.tree, root, point);
}

std::vector<LinkLine> links_of(const HierarchyView& view, std::uint32_t element) {
    std::vector<LinkLine> lines;
    std::uint16_t above = 0;
    for (std::uint32_t n = element; n != no_index; n = view.tree.nodes[n].parent, ++above)
        for (std::uint32_t l = view.first_link[n]; l < view.first_link[n + 1]; ++l) {
            const Link& link = view.links[l];
            const ElementNode& source = view.tree.nodes[link.source];
            lines.push_back({view.tree.nodes[n].centre, source.centre, link.form_factor,
                             link.form_factor * view.brightness[link.source], above, source.is_cluster()});
        }
    std::sort(lines.begin(), lines.end(),
              [](const LinkLine& a, const LinkLine& b) { return a.irradiance > b.irradiance; });
    return lines;
}

} // namespace lueur
