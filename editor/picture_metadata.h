// What a saved picture says of itself, so that it can be made again and compared: the window's screenshots and `lueur
// render` say the same.
#pragma once

#include <filesystem>

#include "core/display/image_file.h"
#include "core/scene/scene.h"
#include "core/solve/status.h"
#include "core/view/picture.h"

namespace lueur {

std::string to_string(SolverKind solver);
std::string to_string(PictureQuantity quantity);

// Keys "lueur:...". `max_display` of the display is the one that was used, an automatic one included.
ImageMetadata picture_metadata(const Scene& scene, const std::filesystem::path& scene_file, const Camera& camera,
                               const SolveStatus& status, PictureQuantity quantity);
void add_display_metadata(ImageMetadata& metadata, const DisplaySettings& display);

} // namespace lueur
