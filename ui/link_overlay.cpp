#include "ui/link_overlay.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <imgui.h>

#include "core/display/false_colour.h"
#include "core/solve/hierarchy_view.h"
#include "core/view/picture.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

constexpr double decades = 3; // of irradiance that the colours tell apart
constexpr std::size_t most_lines = 4000;

ImU32 scale_colour(double t, float alpha) {
    const auto c = false_colour(std::clamp(t, 0.0, 1.0));
    return packed({static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), alpha});
}

// Ends of a line in 0..1 of the picture, without what lies behind the eye.
std::optional<std::pair<glm::vec2, glm::vec2>> on_picture(const glm::dmat4& clip, glm::vec3 from, glm::vec3 to) {
    glm::dvec4 a = clip * glm::dvec4(glm::dvec3(from), 1), b = clip * glm::dvec4(glm::dvec3(to), 1);
    constexpr double nearest = 1e-3;
    if (a.w < nearest && b.w < nearest) return {};
    if (a.w < nearest) a = b + (a - b) * ((b.w - nearest) / (b.w - a.w));
    if (b.w < nearest) b = a + (b - a) * ((a.w - nearest) / (a.w - b.w));
    const auto place = [](const glm::dvec4& p) {
        return glm::vec2(static_cast<float>(0.5 + 0.5 * p.x / p.w), static_cast<float>(0.5 - 0.5 * p.y / p.w));
    };
    return std::pair(place(a), place(b));
}

ImVec2 pixel(const OverlayArea& area, glm::vec2 p) {
    return {area.x + p.x * area.width, area.y + p.y * area.height};
}

glm::dmat4 clip_of(const Camera& camera, const OverlayArea& area) {
    return clip_from_world(camera, static_cast<double>(area.width) / std::max(area.height, 1.0f), 0.01, 1000);
}

void note(const UiState& state, const OverlayArea& area, const std::string& text) {
    const float pad = 6 * state.scale;
    const auto size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 from{area.x + 12 * state.scale, area.y + 12 * state.scale};
    auto* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(from, {from.x + size.x + 2 * pad, from.y + size.y + 2 * pad}, packed(colours::panel),
                        4 * state.scale);
    draw->AddText({from.x + pad, from.y + pad}, packed(colours::text), text.c_str());
}

bool seen(const World& world, glm::vec3 eye, glm::vec3 point) {
    return !world.occluded({eye, point - eye, 0, 1 - 1e-3f});
}

void find_outlines(const Snapshot& snapshot, const glm::dmat4& clip, LevelOutlines& outlines) {
    const ElementTree& tree = outlines.hierarchy->tree;
    const glm::vec3 eye = outlines.camera.position;
    const float deepest = static_cast<float>(std::max(1u, outlines.hierarchy->levels));
    outlines.lines.clear();
    for (const ElementNode& node : tree.nodes) {
        if (!node.is_leaf() || node.is_cluster() || glm::dot(eye - node.centre, node.normal) <= 0) continue;
        const std::size_t corners = node.shape == ElementShape::quadrilateral ? 4 : 3;
        for (std::size_t k = 0; k < corners; ++k) {
            const glm::vec3 a = tree.vertices[node.corners[k]], b = tree.vertices[node.corners[(k + 1) % corners]];
            // Long edges are hidden in parts.
            const int parts =
                std::clamp(static_cast<int>(6 * node.radius / (1e-6f + glm::distance(eye, node.centre))), 1, 8);
            for (int part = 0; part < parts; ++part) {
                const float t = static_cast<float>(part) / static_cast<float>(parts),
                            step = 1.0f / static_cast<float>(parts);
                const glm::vec3 p = a + t * (b - a), q = a + (t + step) * (b - a);
                if (!seen(*snapshot.world, eye,
                          0.49f * (p + q) + 0.02f * node.centre + 1e-4f * node.radius * node.normal))
                    continue;
                if (const auto line = on_picture(clip, p, q))
                    outlines.lines.push_back({line->first, line->second, static_cast<float>(node.level) / deepest});
            }
        }
    }
}

} // namespace

void draw_levels(const UiState& state, const Snapshot& snapshot, const Camera& camera, const OverlayArea& area,
                 LevelOutlines& outlines) {
    if (!snapshot.hierarchy || !snapshot.world) {
        note(state, area, "Element levels: the hierarchical solver has them");
        return;
    }
    const double aspect = static_cast<double>(area.width) / std::max(area.height, 1.0f);
    if (outlines.hierarchy != snapshot.hierarchy || !(outlines.camera == camera) || outlines.aspect != aspect) {
        outlines.hierarchy = snapshot.hierarchy;
        outlines.camera = camera;
        outlines.aspect = aspect;
        find_outlines(snapshot, clip_of(camera, area), outlines);
    }
    auto* draw = ImGui::GetWindowDrawList();
    draw->PushClipRect({area.x, area.y}, {area.x + area.width, area.y + area.height}, true);
    for (const LevelOutlines::Line& line : outlines.lines)
        draw->AddLine(pixel(area, line.from), pixel(area, line.to),
                      scale_colour(0.25 + 0.75 * static_cast<double>(line.level), 0.9f), std::max(1.0f, state.scale));
    draw->PopClipRect();
    if (!state.links_shown)
        note(state, area,
             fmt::format("Elements of levels 0 to {}, dark to bright; {} links", snapshot.hierarchy->levels,
                         whole_number(snapshot.hierarchy->links.size())));
}

void draw_links(const UiState& state, const Snapshot& snapshot, const Camera& camera, const OverlayArea& area) {
    if (!snapshot.hierarchy || !snapshot.world || !snapshot.mesh) {
        note(state, area, "Links: the hierarchical solver has them");
        return;
    }
    if (!state.link_place) {
        note(state, area, "Links: click at a place to see what lights it");
        return;
    }
    const HierarchyView& view = *snapshot.hierarchy;
    const float size = 1e-3f * (1 + glm::length(state.link_place->position));
    const Hit hit = snapshot.world->closest(
        {state.link_place->position + size * state.link_place->normal, -state.link_place->normal, 0, 2 * size});
    if (hit.element == no_index) return;
    const std::uint32_t element = element_at(view, *snapshot.mesh, hit.element, state.link_place->position);
    if (element == no_index) return;
    const std::vector<LinkLine> lines = links_of(view, element);
    const glm::dmat4 clip = clip_of(camera, area);
    auto* draw = ImGui::GetWindowDrawList();
    draw->PushClipRect({area.x, area.y}, {area.x + area.width, area.y + area.height}, true);
    const double brightest = lines.empty() ? 0 : static_cast<double>(lines.front().irradiance);
    double light = 0;
    std::size_t own = 0;
    for (const LinkLine& line : lines) light += static_cast<double>(line.irradiance), own += line.receiver_above == 0;
    for (std::size_t k = std::min(lines.size(), most_lines); k-- > 0;) { // the brightest on top
        const LinkLine& line = lines[k];
        const double share = brightest > 0 ? static_cast<double>(line.irradiance) / brightest : 0;
        const double t = share > 0 ? 1 + std::log10(share) / decades : 0;
        if (const auto ends = on_picture(clip, line.from, line.to))
            draw->AddLine(pixel(area, ends->first), pixel(area, ends->second),
                          scale_colour(t, static_cast<float>(std::clamp(0.25 + 0.75 * t, 0.25, 1.0))),
                          std::max(1.0f, state.scale * (t > 0.8 ? 2.0f : 1.0f)));
    }
    const ElementNode& node = view.tree.nodes[element];
    const std::size_t corners = node.shape == ElementShape::quadrilateral ? 4 : 3;
    for (std::size_t k = 0; k < corners; ++k)
        if (const auto ends = on_picture(clip, view.tree.vertices[node.corners[k]],
                                         view.tree.vertices[node.corners[(k + 1) % corners]]))
            draw->AddLine(pixel(area, ends->first), pixel(area, ends->second), packed(colours::accent),
                          2 * std::max(1.0f, state.scale));
    draw->PopClipRect();
    note(state, area,
         fmt::format(
             "{} links light this element of level {}: {} its own, {} of what it is part of. The brightest brings "
             "{} lx (F {:.3g}), all {} lx",
             whole_number(lines.size()), node.level, whole_number(own), whole_number(lines.size() - own),
             short_number(brightest), lines.empty() ? 0.0f : lines.front().form_factor, short_number(light)));
}

} // namespace lueur
