// Files of a scene: where they are, whether they can be read, how they are named from another folder.
#pragma once

#include <expected>
#include <filesystem>
#include <optional>
#include <string>

namespace lueur {

// Why `file` cannot be opened ("is not there", "is a folder"), or nothing.
std::optional<std::string> why_unreadable(const std::filesystem::path& file);

// All bytes, or why not.
std::expected<std::string, std::string> read_bytes(const std::filesystem::path& file);

// `path` as seen from `folder`, written as seen from `other`. Absolute paths stay as they are.
std::string path_from_folder(const std::string& path, const std::filesystem::path& folder,
                             const std::filesystem::path& other);

// "office.glb*0" is picture 0 inside office.glb.
struct EmbeddedPicture {
    std::string file, picture; // "office.glb", "*0"
};
std::optional<EmbeddedPicture> embedded_picture(const std::string& path);

std::string lower_case_extension(const std::filesystem::path& file); // ".glb"

} // namespace lueur
