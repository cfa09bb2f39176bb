// A scene of a few names for tests of edits: values only, three triangles of geometry.
#pragma once

#include <memory>

#include "core/scene/scene.h"
#include "core/scene/surfaces.h"

namespace lueur {

// Objects: 0 floor (white), 1 left wall (red), 2 right wall (red), 3 lamp (white). Materials: 0 white, 1 red, 2 cloth
// (two-sided). Luminaires: 0 lamp, 1000 lm.
inline Scene small_scene() {
    Scene scene;
    scene.name = "small";
    scene.materials = {{"white", 0.7, {}, false}, {"red", Rgb(0.6, 0.1, 0.1), {}, false}, {"cloth", 0.3, {}, true}};
    scene.objects = {{"floor", MaterialIndex(0)},
                     {"left wall", MaterialIndex(1)},
                     {"right wall", MaterialIndex(1)},
                     {"lamp", MaterialIndex(0)}};
    scene.luminaires = {{.name = "lamp", .objects = {ObjectIndex(3)}}};
    Geometry geometry;
    for (unsigned object = 0; object < 4; ++object) {
        const float y = static_cast<float>(object);
        const auto first = static_cast<unsigned>(geometry.vertices.size());
        for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(0, 1), glm::vec2(1, 0)})
            geometry.vertices.push_back({{corner.x, y, corner.y}, glm::vec3(0), corner});
        geometry.triangles.push_back({first, first + 1, first + 2});
        geometry.triangle_surface.push_back(SurfaceIndex(object));
        geometry.surfaces.push_back({ObjectIndex(object), true});
    }
    measure_surfaces(geometry);
    scene.geometry = std::make_shared<const Geometry>(std::move(geometry));
    return scene;
}

} // namespace lueur
