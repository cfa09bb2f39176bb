#include "ui/viewport.h"

#include <algorithm>
#include <cmath>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "core/solve/choose_solver.h"
#include "core/view/picture.h"
#include "ui/false_colour.h"
#include "ui/navigation.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

constexpr double still_after = 0.15; // s without a movement or new light before the picture is refined

bool same_scene(const Document& document, const Snapshot& snapshot) {
    return snapshot.scene && snapshot.scene->geometry == document.scene().geometry;
}

bool key(int code) {
    return ImGui::IsKeyDown(code);
}

// Keys held: metres to the right, up and ahead in this frame.
glm::dvec3 flight(double speed, double dt) {
    const auto& io = ImGui::GetIO();
    if (io.WantTextInput || io.KeyCtrl || io.KeyAlt) return glm::dvec3(0);
    const auto axis = [](int more, int less) { return (key(more) ? 1.0 : 0.0) - (key(less) ? 1.0 : 0.0); };
    const glm::dvec3 way(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S));
    return way * (speed * (io.KeyShift ? 4 : 1) * std::min(dt, 0.1));
}

void legend(const UiState& state, const ViewportState& view, const DisplaySettings& display) {
    const float x = static_cast<float>(view.x) + 12 * state.scale,
                y = static_cast<float>(view.y + view.height) - 12 * state.scale;
    switch (state.view) {
    case ViewMode::shaded:
    case ViewMode::elements:
        return;
    case ViewMode::side_by_side: {
        const float middle = static_cast<float>(view.x + view.width / 2), top = static_cast<float>(view.y);
        auto* list = ImGui::GetWindowDrawList();
        list->AddLine({middle, top}, {middle, top + static_cast<float>(view.height)}, packed(colours::line),
                      std::max(1.0f, state.scale));
        const auto name = [&](const char* text, float left) {
            const auto size = ImGui::CalcTextSize(text);
            const float pad = 6 * state.scale;
            const ImVec2 from{left, y - size.y - 2 * pad};
            list->AddRectFilled(from, {left + size.x + 2 * pad, y}, packed(colours::panel), 4 * state.scale);
            list->AddText({left + pad, from.y + pad}, packed(colours::text), text);
        };
        name("Spectral", x);
        name("RGB (trichromatic)", middle + 12 * state.scale);
        return;
    }
    case ViewMode::difference:
        draw_legend(state, x, y, "Colour difference spectral - RGB, CIEDE2000", colour_difference_scale());
        return;
    case ViewMode::error:
        draw_legend(state, x, y, "Estimated error (one sigma), %", error_scale());
        return;
    case ViewMode::unshot:
        draw_legend(state, x, y, "Unshot light, lm/m²", unshot_scale(state.unshot_top));
        return;
    case ViewMode::luminance:
        draw_legend(state, x, y, "Luminance, cd/m²", display.luminance_scale);
        return;
    case ViewMode::illuminance:
        draw_legend(state, x, y, "Illuminance, lx", display.illuminance_scale);
        return;
    }
}

void busy_note(const UiState& state, const ViewportState& view, const Snapshot& snapshot) {
    const std::string text =
        snapshot.status.stage == SolveStage::failed ? snapshot.status.message : "Preparing the scene...";
    const auto size = ImGui::CalcTextSize(text.c_str());
    ImGui::GetWindowDrawList()->AddText(
        {static_cast<float>(view.x) + 0.5f * (static_cast<float>(view.width) - size.x),
         static_cast<float>(view.y) + 0.5f * (static_cast<float>(view.height) - size.y)},
        packed(colours::dim), text.c_str());
    (void)state;
}

// Mouse and keys -> the camera after them.
std::optional<Camera> steered(const Camera& before, const Bounds& bounds, ViewportState& view, double dt) {
    const auto& io = ImGui::GetIO();
    Camera camera = before;
    const double height = std::max(view.height, 1);
    const glm::dvec2 movement(io.MouseDelta.x / height, io.MouseDelta.y / height);
    const bool any_movement = io.MouseDelta.x != 0 || io.MouseDelta.y != 0;
    const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left), middle = ImGui::IsMouseDown(ImGuiMouseButton_Middle),
               right = ImGui::IsMouseDown(ImGuiMouseButton_Right);
    if (view.dragging) {
        if (ImGui::IsMouseDragging(ImGuiMouseButton_Left, 4) || ImGui::IsMouseDragging(ImGuiMouseButton_Middle, 1) ||
            ImGui::IsMouseDragging(ImGuiMouseButton_Right, 1))
            view.moved = true;
        if (any_movement && view.moved) {
            if ((left || middle) && io.KeyShift)
                camera = panned(camera, movement);
            else if (right)
                camera = looked_around(camera, movement);
            else if (left || middle)
                camera = orbited(camera, movement);
        }
    }
    const double size = 2 * bounds.radius();
    if (view.hovered && io.MouseWheel != 0) camera = dollied(camera, static_cast<double>(io.MouseWheel), size);
    view.looking = view.dragging && right;
    glm::dvec3 way(0);
    if (view.hovered || view.looking) way = flight(0.35 * size, dt);
    view.flying = way != glm::dvec3(0);
    if (view.flying) camera = flown(camera, way);
    if (camera == before) return {};
    return camera;
}

// The largest unshot exitance seen since the scene was opened or restarted, rounded up to a decade.
void update_unshot_top(const Snapshot& snapshot, ViewportState& view, UiState& state) {
    if (snapshot.field == view.unshot_field && state.unshot_top > 0) return;
    view.unshot_field = snapshot.field;
    float largest = 0;
    if (snapshot.field)
        for (const float value : snapshot.field->unshot) largest = std::max(largest, value);
    if (largest > 0) state.unshot_top = std::max(state.unshot_top, std::pow(10.0f, std::ceil(std::log10(largest))));
}

} // namespace

double aspect_of(const ViewportState& view) {
    return static_cast<double>(std::max(view.width, 1)) / std::max(view.height, 1);
}

std::optional<Probe> probe_at(const Snapshot& snapshot, const Camera& camera, const ViewportState& view, float x,
                              float y) {
    const double u = (static_cast<double>(x) + 0.5 - view.x) / std::max(view.width, 1);
    const double v = (static_cast<double>(y) + 0.5 - view.y) / std::max(view.height, 1);
    if (u < 0 || v < 0 || u > 1 || v > 1) return {};
    const auto ray = camera_ray(camera, aspect_of(view), u, v);
    return probe(snapshot, ray.origin, ray.direction);
}

std::optional<Edit> camera_command(Command command, const Document& document, const UiState& state,
                                   const ViewportState& view) {
    const auto& scene = document.scene();
    if (command == Command::home && view.home) return SetCamera{*view.home};
    if (command == Command::frame_selection) {
        const auto bounds = state.selected ? bounds_of(*scene.geometry, *state.selected) : bounds_of(*scene.geometry);
        return SetCamera{framed(scene.camera, bounds, aspect_of(view))};
    }
    return {};
}

std::optional<Edit> viewport(const Document& document, const Snapshot& snapshot, UiState& state, ViewportState& view,
                             Renderer& renderer, double now, double dt) {
    const auto corner = ImGui::GetCursorScreenPos();
    const auto room = ImGui::GetContentRegionAvail();
    view.x = static_cast<int>(std::lround(corner.x));
    view.y = static_cast<int>(std::lround(corner.y));
    view.width = std::max(16, static_cast<int>(room.x));
    view.height = std::max(16, static_cast<int>(room.y));
    state.layout_log.area("viewport", corner.x, corner.y, corner.x + static_cast<float>(view.width),
                          corner.y + static_cast<float>(view.height));

    const bool known = same_scene(document, snapshot);
    renderer.set_snapshot(known ? snapshot : Snapshot{});
    ImGui::SetCursorScreenPos({static_cast<float>(view.x), static_cast<float>(view.y)});
    ImGui::InvisibleButton("##viewport", {static_cast<float>(view.width), static_cast<float>(view.height)},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    view.hovered = ImGui::IsItemHovered();
    const bool was_dragging = view.dragging;
    view.dragging = ImGui::IsItemActive();
    if (view.dragging && !was_dragging) view.moved = false;
    const bool clicked =
        was_dragging && !view.dragging && !view.moved && view.hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Left);

    const auto& scene = document.scene();
    std::optional<Edit> edit;
    auto camera = scene.camera;
    if (const auto moved = steered(camera, renderer.bounds(), view, dt)) {
        camera = *moved; // shown in this frame already
        edit = SetCamera{camera};
        view.last_motion = now;
    }
    const auto mouse = ImGui::GetIO().MousePos;
    state.hovered.reset();
    if (known && view.hovered && !view.dragging) state.hovered = probe_at(snapshot, camera, view, mouse.x, mouse.y);
    if (clicked) {
        state.selected.reset();
        state.link_place.reset();
        if (state.hovered) {
            state.link_place = {state.hovered->position, state.hovered->normal};
            state.selected = state.hovered->object;
            state.material = state.hovered->material;
            if (state.hovered->luminaire) {
                state.luminaire = state.hovered->luminaire;
                state.show_luminaires = true;
            }
        }
    }

    if (known) update_unshot_top(snapshot, view, state);
    RenderParams params;
    params.width = view.width;
    params.height = view.height;
    params.camera = camera;
    params.display = display_in_use(scene.display, state.exposure);
    if (known && (state.view == ViewMode::luminance || state.view == ViewMode::illuminance))
        fit_scales(view.scales, snapshot, params.display);
    params.view = state.view;
    params.selected = state.selected;
    params.unshot_top = state.unshot_top;
    params.line_width = std::max(1.0f, std::round(1.2f * state.scale));
    const SolverKind solver = chosen_solver(scene);
    params.highlight_shooting =
        (solver == SolverKind::shooting || solver == SolverKind::overshooting) && !snapshot.status.settled;
    if (known && !snapshot.status.settled && !state.paused) view.last_motion = now;
    params.still = now - view.last_motion > still_after;
    view.picture = renderer.draw(params);
    view.refined = view.picture.samples > 1;
    view.drew_mesh = renderer.drew_mesh();
    view.draw_seconds = renderer.draw_seconds();

    if (!known || !snapshot.mesh) busy_note(state, view, snapshot);
    const OverlayArea area{static_cast<float>(view.x), static_cast<float>(view.y), static_cast<float>(view.width),
                           static_cast<float>(view.height)};
    if (known && state.levels_shown) draw_levels(state, snapshot, camera, area, view.outlines);
    if (known && state.links_shown) draw_links(state, snapshot, camera, area);
    legend(state, view, params.display);
    state.scales_in_use = {params.display.luminance_scale, params.display.illuminance_scale};
    if (known && view.refined && state.shares_wanted) state.shares = renderer.shares(params.display);
    state.shares_wanted = false; // who shows them says so anew in each frame
    if (state.layout.probe_at_cursor && state.hovered) {
        ImGui::BeginTooltip();
        probe_readout(document, state);
        ImGui::EndTooltip();
    }
    return edit;
}

} // namespace lueur
