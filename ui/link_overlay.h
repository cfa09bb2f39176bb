// The hierarchy over the picture: the links that light a picked place, and the elements of each level.
#pragma once

#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "editor/snapshot.h"
#include "ui/ui_state.h"

namespace lueur {

struct HierarchyView; // core/solve/hierarchy_view.h

struct OverlayArea { // of the picture, pixels of the window
    float x = 0, y = 0, width = 0, height = 0;
};

// Outlines of the elements that the camera sees, remembered while neither moves.
struct LevelOutlines {
    struct Line {
        glm::vec2 from, to; // 0..1 of the picture
        float level;        // 0 the scene's own surfaces, 1 the most finely cut
    };
    std::shared_ptr<const HierarchyView> hierarchy;
    Camera camera;
    double aspect = 0;
    std::vector<Line> lines;
};

void draw_levels(const UiState& state, const Snapshot& snapshot, const Camera& camera, const OverlayArea& area,
                 LevelOutlines& outlines);

// Lines from the picked place's element to the sources of all its links; from the nodes above it where the links stand
// there. Colour: how much light each brings.
void draw_links(const UiState& state, const Snapshot& snapshot, const Camera& camera, const OverlayArea& area);

} // namespace lueur
