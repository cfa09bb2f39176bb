// Files that the commands write: whole or not at all, and known to be possible before minutes of work.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

namespace lueur {

// The errors are one line, `FILE: what; what is allowed`. A device or a folder is refused: files are renamed into their
// place.
std::expected<void, std::string> check_writable(const std::filesystem::path& file);
std::expected<void, std::string> write_text(const std::filesystem::path& file, const std::string& text);

} // namespace lueur
