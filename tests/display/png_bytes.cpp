#include "tests/display/png_bytes.h"

namespace lueur {

namespace {

std::string big_endian(std::uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
            static_cast<char>(value)};
}

std::uint32_t crc32(const std::string& bytes) { // annex D
    std::uint32_t crc = 0xffffffffu;
    for (const char byte : bytes) {
        crc ^= static_cast<std::uint8_t>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    return ~crc;
}

std::uint32_t adler32(const std::string& bytes) { // RFC 1950
    std::uint32_t a = 1, b = 0;
    for (const char byte : bytes) {
        a = (a + static_cast<std::uint8_t>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    return (b << 16) | a;
}

std::string chunk(const std::string& type, const std::string& data) {
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc32(type + data));
}

std::string zlib_stored(const std::string& bytes) { // one stored block, RFC 1951: at most 65535 bytes
    const auto size = static_cast<std::uint16_t>(bytes.size()), inverse = static_cast<std::uint16_t>(~size);
    std::string stream("\x78\x01\x01", 3);
    for (const std::uint16_t value : {size, inverse}) {
        stream += static_cast<char>(value & 0xff);
        stream += static_cast<char>(value >> 8);
    }
    return stream + bytes + big_endian(adler32(bytes));
}

} // namespace

std::string png_chunk(const std::string& type, const std::string& data) {
    return chunk(type, data);
}

std::string png_bytes(std::uint32_t width, std::uint32_t height, std::uint8_t bit_depth, PngColour colour,
                      const std::string& rows, const std::string& palette, const std::string& chunks) {
    std::string header = big_endian(width) + big_endian(height);
    header += static_cast<char>(bit_depth);
    header += static_cast<char>(colour);
    header += std::string(3, '\0'); // deflate, adaptive filtering, not interlaced
    std::string filtered;
    const std::size_t bytes_a_row = rows.size() / height;
    for (std::uint32_t y = 0; y < height; ++y)
        filtered += '\0' + rows.substr(y * bytes_a_row, bytes_a_row); // filter: none
    std::string png("\x89PNG\r\n\x1a\n", 8);
    png += chunk("IHDR", header) + chunks;
    if (!palette.empty()) png += chunk("PLTE", palette);
    return png + chunk("IDAT", zlib_stored(filtered)) + chunk("IEND", "");
}

} // namespace lueur
