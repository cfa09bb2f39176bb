// Is a PNG whole? libpng, which would find out too, tells of it on stderr whatever its caller wants.
#pragma once

#include <span>

namespace lueur {

// Every chunk lies within the bytes and has the checksum it says, up to the last one (ISO/IEC 15948, 5.3 and annex D).
bool is_whole_png(std::span<const unsigned char> bytes);

} // namespace lueur
