#include "core/scene/files.h"

#include <array>
#include <cctype>
#include <fstream>

namespace lueur {

namespace fs = std::filesystem;

std::optional<std::string> why_unreadable(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (status.type() == fs::file_type::not_found) return "is not there";
    if (status.type() == fs::file_type::directory) return "is a folder";
    if (status.type() == fs::file_type::none) return "cannot be looked at: " + error.message();
    if (status.type() != fs::file_type::regular) return "is not a regular file";
    if (!std::ifstream(file, std::ios::binary)) return "cannot be opened for reading";
    return {};
}

std::expected<std::string, std::string> read_bytes(const fs::path& file) {
    if (const auto why = why_unreadable(file)) return std::unexpected(*why);
    std::ifstream stream(file, std::ios::binary);
    std::string bytes;
    std::array<char, 1 << 16> block;
    while (stream.read(block.data(), block.size()) || stream.gcount() > 0)
        bytes.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (stream.bad()) return std::unexpected("cannot be read to its end");
    return bytes;
}

std::string path_from_folder(const std::string& path, const fs::path& folder, const fs::path& other) {
    if (path.empty() || fs::path(path).is_absolute()) return path;
    std::error_code error;
    const fs::path here = fs::absolute(folder, error).lexically_normal();
    const fs::path there = fs::absolute(other, error).lexically_normal();
    const fs::path target = (here / path).lexically_normal();
    const fs::path relative = target.lexically_relative(there);
    return (relative.empty() ? target : relative).generic_string();
}

std::optional<EmbeddedPicture> embedded_picture(const std::string& path) {
    const std::size_t star = path.rfind('*');
    if (star == std::string::npos || star == 0 || star + 1 == path.size()) return {};
    for (std::size_t i = star + 1; i < path.size(); ++i)
        if (!std::isdigit(static_cast<unsigned char>(path[i]))) return {};
    return EmbeddedPicture{path.substr(0, star), path.substr(star)};
}

std::string lower_case_extension(const fs::path& file) {
    std::string extension = file.extension().string();
    for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return extension;
}

} // namespace lueur
