// Pictures in and out of files: the only code that sees OpenImageIO.
//
// Files are written beside their place and renamed into it: no half file is ever seen.
// Errors are one line, `FILE: what; what is allowed`.
#pragma once

#include <cstddef>
#include <expected>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/display/display.h"

namespace lueur {

// "lueur:max_display" -> "120.5", ... Every key begins with `lueur:`, which tells it from what formats and other
// programs add. Values are text without control characters but newline and tab.
using ImageMetadata = std::map<std::string, std::string>;

// .png .jpg .jpeg .tif .tiff take the display image; the metadata go into the file's own text fields
// (PNG text chunks; JPEG comment / ImageDescription as `key = value` lines).
std::expected<void, std::string> write_display_image(const std::filesystem::path& file, const DisplayImage& image,
                                                     const ImageMetadata& metadata);

// .exr .hdr take the scene-referred radiance, as linear sRGB in cd m^-2. An .exr says so in its header and has the
// metadata as attributes; an .hdr has room for neither.
std::expected<void, std::string> write_radiance_image(const std::filesystem::path& file, const RadianceImage& image,
                                                      const ImageMetadata& metadata);

// What the two above wrote.
std::expected<ImageMetadata, std::string> read_image_metadata(const std::filesystem::path& file);

bool is_radiance_image_name(const std::filesystem::path& file); // .exr .hdr
bool is_display_image_name(const std::filesystem::path& file);  // .png .jpg .jpeg .tif .tiff

// A texture: linear RGB reflectance 0..1 in float, row-major from the top left; 8 and 16 bit integers are decoded from
// sRGB, float files are taken as linear and must hold 0..1; grey becomes three equal channels; palettes are expanded;
// alpha is dropped. .png .jpg .tif .exr .hdr .bmp .tga, told by their first bytes and not by their names.
struct TextureImage {
    int width = 0, height = 0;
    std::vector<glm::vec3> rgb;
    bool operator==(const TextureImage&) const = default;
};
std::expected<TextureImage, std::string> read_texture(const std::filesystem::path& file);
// Embedded in a .glb; the name is for errors.
std::expected<TextureImage, std::string> read_texture_memory(std::span<const std::byte> encoded,
                                                             const std::string& name);

} // namespace lueur
