// The picture in the middle: draws it, turns the mouse and the keys into camera movements and picks.
#pragma once

#include <memory>
#include <optional>

#include "editor/document.h"
#include "editor/snapshot.h"
#include "ui/false_colour.h"
#include "ui/link_overlay.h"
#include "ui/renderer.h"
#include "ui/ui_state.h"

namespace lueur {

// What the viewport remembers of the hand.
struct ViewportState {
    int x = 0, y = 0, width = 0, height = 0; // pixels of the window
    bool hovered = false;
    bool dragging = false;
    bool moved = false;        // since the button went down: a drag, not a click
    bool looking = false;      // right button down: the mouse turns the head
    bool flying = false;       // keys are held: draw on
    double last_motion = -1e9; // s; a still picture gets more samples
    bool refined = false;      // it has them
    Renderer::Picture picture; // to be put under the panels by the window
    double draw_seconds = 0;
    bool drew_mesh = false;
    std::shared_ptr<const Field> unshot_field; // whose largest unshot value has been looked for
    FittedScales scales;                       // of the false colours
    LevelOutlines outlines;                    // of the element levels
    std::optional<Camera> home;                // the scene's own camera
};

// Draws the area under the cursor of the present ImGui window. `now` and `dt` in seconds.
std::optional<Edit> viewport(const Document& document, const Snapshot& snapshot, UiState& state, ViewportState& view,
                             Renderer& renderer, double now, double dt);

// The camera that a command asks for.
std::optional<Edit> camera_command(Command command, const Document& document, const UiState& state,
                                   const ViewportState& view);

double aspect_of(const ViewportState& view);
std::optional<Probe> probe_at(const Snapshot& snapshot, const Camera& camera, const ViewportState& view, float x,
                              float y);

} // namespace lueur
