// What a saved picture says of itself, so that it can be made again and compared: the window's screenshots and `lueur
// render` say the same.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

#include "core/display/image_file.h"
#include "core/scene/scene.h"
#include "core/solve/status.h"
#include "core/view/picture.h"

namespace lueur {

std::string to_string(PictureQuantity quantity);

// Keys "lueur:..."; numbers are the shortest that read back exactly. Metres, Y up.
ImageMetadata picture_metadata(const Scene& scene, const std::filesystem::path& scene_file, const Camera& camera,
                               const SolveStatus& status, PictureQuantity quantity);
// The numbers of the display are those that were used, automatic ones included.
void add_display_metadata(ImageMetadata& metadata, const DisplaySettings& display, bool false_colour = false);

// All that is needed to make a picture again.
struct PictureRecipe {
    std::string version, scene_name;
    std::filesystem::path scene_file; // absolute, where it was known
    PictureQuantity quantity = PictureQuantity::colour;
    bool false_colour = false;
    Camera camera;
    DisplaySettings display;
    SolveSettings solve;
    bool operator==(const PictureRecipe&) const = default;
};
// The error names what is missing or cannot be read, in one line. A picture without display settings (EXR, HDR) has the
// default ones.
std::expected<PictureRecipe, std::string> recipe_from_metadata(const ImageMetadata& metadata);

} // namespace lueur
