// A picture as a file: what `lueur render` and the window save.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

#include "core/display/display.h"
#include "core/display/image_file.h"
#include "core/view/picture.h"

namespace lueur {

struct PictureFile {
    std::filesystem::path output; // its ending says the kind: .png .jpg .tif as displayed, .exr .hdr as radiance
    PictureQuantity quantity = PictureQuantity::colour;
    DisplaySettings display;   // with the numbers in use
    bool false_colour = false; // with the legend
    int bits = 8;              // a channel, or 16: .png and .tif; a .jpg has 8
};

// `metadata`: to which those of the display are added where it is applied.
std::expected<void, std::string> write_picture(const PictureFile& file, const RadianceImage& image,
                                               ImageMetadata metadata);

} // namespace lueur
