// Writing a file so that nobody ever sees half of it.
#pragma once

#include <expected>
#include <filesystem>
#include <span>
#include <string>

namespace lueur {

// Writes the bytes beside `file` and renames them into its place. On an error the old file, if any, is untouched and
// nothing is left beside it. The error is one line, `FILE: what; what is allowed`.
std::expected<void, std::string> replace_file(const std::filesystem::path& file, std::span<const unsigned char> bytes);

} // namespace lueur
