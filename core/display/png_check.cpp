#include "core/display/png_check.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace lueur {

namespace {

constexpr std::array<std::uint32_t, 256> crc_table = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t crc = byte;
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
        table[byte] = crc;
    }
    return table;
}();

std::uint32_t crc32(std::span<const unsigned char> bytes) {
    std::uint32_t crc = 0xffffffffu;
    for (const unsigned char byte : bytes) crc = crc_table[(crc ^ byte) & 0xff] ^ (crc >> 8);
    return ~crc;
}

std::uint32_t big_endian(std::span<const unsigned char> bytes) {
    return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 | bytes[3];
}

} // namespace

bool is_whole_png(std::span<const unsigned char> bytes) {
    constexpr std::size_t signature = 8, around_data = 12; // length, type and checksum, 4 bytes each
    if (bytes.size() < signature) return false;
    bytes = bytes.subspan(signature);
    while (bytes.size() >= around_data) {
        const std::size_t length = big_endian(bytes);
        if (length > bytes.size() - around_data) return false;
        const auto type_and_data = bytes.subspan(4, 4 + length);
        if (crc32(type_and_data) != big_endian(bytes.subspan(8 + length))) return false;
        if (std::string_view(reinterpret_cast<const char*>(type_and_data.data()), 4) == "IEND") return true;
        bytes = bytes.subspan(around_data + length);
    }
    return false;
}

} // namespace lueur
