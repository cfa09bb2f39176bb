// Image metadata as text: one `key = value` line each, for formats that have a single free text field.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/display/image_file.h"

namespace lueur {

// Keys begin with this, which tells them from what the format and other programs add.
inline constexpr std::string_view metadata_prefix = "lueur:";

std::string text_from_metadata(const ImageMetadata& metadata); // newlines and backslashes of values are escaped
ImageMetadata metadata_from_text(std::string_view text);       // lines of another kind are left out

// What is wrong with the metadata, in one line: keys are `lueur:` and up to 60 letters, digits and "_.-"; values have
// no control characters but newline and tab.
std::optional<std::string> metadata_fault(const ImageMetadata& metadata);

} // namespace lueur
