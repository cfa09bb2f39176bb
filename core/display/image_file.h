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
// 16 bits a channel: .png .tif .tiff.
std::expected<void, std::string> write_display_image(const std::filesystem::path& file, const DeepDisplayImage& image,
                                                     const ImageMetadata& metadata);

// .exr .hdr take the scene-referred radiance, as linear sRGB in cd m^-2. An .exr says so in its header and has the
// metadata as attributes; an .hdr has room for neither.
std::expected<void, std::string> write_radiance_image(const std::filesystem::path& file, const RadianceImage& image,
                                                      const ImageMetadata& metadata);

// Spectral radiance in W m^-2 sr^-1 nm^-1, one plane a wavelength, row-major from the top left.
struct SpectralImage {
    int width = 0, height = 0;
    std::vector<double> nm;                 // rising, above 0
    std::vector<std::vector<float>> planes; // one a wavelength
    bool operator==(const SpectralImage&) const = default;
};
// .exr in the layout of Fichet, Pacanowski & Wilkie 2021, "An OpenEXR Layout for Spectral Images" (Journal of Computer
// Graphics Techniques 10(3)): channels "S0.500,0nm" (the unpolarised Stokes component; a comma, since EXR takes a full
// stop for the end of a layer's name), the attributes spectralLayoutVersion "1.0" and emissiveUnits, and R, G, B of
// `preview` (linear sRGB in cd m^-2) for programs that know nothing of spectra.
std::expected<void, std::string> write_spectral_image(const std::filesystem::path& file, const SpectralImage& image,
                                                      const RadianceImage& preview, const ImageMetadata& metadata);
std::expected<SpectralImage, std::string> read_spectral_image(const std::filesystem::path& file);

// What the writers above wrote.
std::expected<ImageMetadata, std::string> read_image_metadata(const std::filesystem::path& file);

bool is_radiance_image_name(const std::filesystem::path& file); // .exr .hdr
bool is_display_image_name(const std::filesystem::path& file);  // .png .jpg .jpeg .tif .tiff
bool is_jpeg_name(const std::filesystem::path& file);           // of them, those with 8 bits a channel only

// A texture: linear RGB reflectance 0..1 in float, row-major from the top left. .png .jpg .tif .exr .hdr .bmp .tga,
// told by their first bytes and not by their names.
//   8 bit             codes of sRGB, decoded by its curve
//   16 bit            the same curve, with all 65536 codes kept apart
//   1, 2, 4 bit       spread over 0..1, then as 8 bit
//   float and half    linear already; must hold 0..1
//   tagged linear     a PNG with gAMA 1.0: integers taken as they are, without a curve
//   tagged with gamma a PNG with gAMA and no sRGB chunk: light = code^(1 / gAMA); 1/2.2 among them
//   tagged sRGB, ICC  as sRGB; an ICC profile is not read
//   grey              three equal channels
//   palette           its colours, as 8 bit
//   alpha             dropped, and darkens nothing: a surface reflects with the colour that is stored, however
//                     transparent the picture says it is
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
