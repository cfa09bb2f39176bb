// PNG files of every kind written by hand (ISO/IEC 15948), so that the reader is tested against the standard and not
// against the writer.
#pragma once

#include <cstdint>
#include <string>

namespace lueur {

enum class PngColour : std::uint8_t { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgb_alpha = 6 };

// `rows`: the samples of each row as they stand in the file, height * bytes-a-row; `palette`: RGB triples; `chunks`: to
// be put in before the palette, from png_chunk.
std::string png_bytes(std::uint32_t width, std::uint32_t height, std::uint8_t bit_depth, PngColour colour,
                      const std::string& rows, const std::string& palette = {}, const std::string& chunks = {});
std::string png_chunk(const std::string& type, const std::string& data);

} // namespace lueur
