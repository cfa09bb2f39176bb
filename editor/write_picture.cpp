#include "editor/write_picture.h"

#include "core/display/false_colour.h"
#include "core/display/legend.h"
#include "editor/false_colour_range.h"
#include "editor/picture_metadata.h"

namespace lueur {

std::expected<void, std::string> write_picture(const PictureFile& file, const RadianceImage& image,
                                               ImageMetadata metadata) {
    if (is_radiance_image_name(file.output)) return write_radiance_image(file.output, image, metadata);
    add_display_metadata(metadata, file.display, file.false_colour);
    const bool deep = file.bits == 16 && !is_jpeg_name(file.output);
    if (file.false_colour) {
        const FalseColourSettings& scale = scale_of(file.display, file.quantity);
        const auto write = [&](auto picture) {
            draw_legend(picture, scale, unit_of(file.quantity));
            return write_display_image(file.output, picture, metadata);
        };
        return deep ? write(deep_false_colour_image(image, scale)) : write(false_colour_image(image, scale));
    }
    return deep ? write_display_image(file.output, deep_display_image(image, file.display), metadata)
                : write_display_image(file.output, display_image(image, file.display), metadata);
}

} // namespace lueur
