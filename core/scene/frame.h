// A first view of a scene that names no camera.
#pragma once

#include "core/scene/scene.h"

namespace lueur {

// From outside, all of it in a square picture; from inside, near a corner, where the surfaces face inwards: a room.
Camera frame_scene(const Geometry& geometry);

} // namespace lueur
