#include "tests/layout/layout_rules.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lueur {

namespace {

constexpr std::array<std::string_view, 8> rooms{"core/spectrum/", "core/display/", "core/scene/", "core/transport/",
                                                "core/solve/",    "core/view/",    "editor/",     "ui/"};

std::optional<std::size_t> room_of(std::string_view path) {
    for (std::size_t i = 0; i < rooms.size(); ++i)
        if (path.starts_with(rooms[i])) return i;
    return std::nullopt;
}

struct ForeignLibrary {
    std::string_view name;
    std::vector<std::string_view> beginnings; // of its headers' paths
    std::string_view only_in;                 // a file or, with a closing '/', a folder
};

const std::vector<ForeignLibrary>& foreign_libraries() {
    static const std::vector<ForeignLibrary> libraries{
        {"Embree", {"embree"}, "core/transport/world.cpp"},
        {"OpenImageIO", {"OpenImageIO/"}, "core/display/image_file.cpp"},
        {"assimp", {"assimp/"}, "core/scene/gltf_file.cpp"},
        {"toml++", {"toml++/", "tomlplusplus", "toml.hpp"}, "core/scene/"},
        {"GLFW", {"GLFW/"}, "ui/"},
        {"OpenGL", {"GL/", "GLES", "EGL/", "epoxy/"}, "ui/"},
        {"Dear ImGui", {"imgui", "backends/imgui", "misc/cpp/imgui"}, "ui/"},
    };
    return libraries;
}

bool is_within(std::string_view file, std::string_view place) {
    return place.ends_with('/') ? file.starts_with(place) : file == place;
}

} // namespace

std::vector<Include> includes_of(std::string_view source) {
    std::vector<Include> includes;
    int line_number = 0;
    while (!source.empty()) {
        ++line_number;
        const std::size_t end = std::min(source.find('\n'), source.size());
        std::string_view line = source.substr(0, end);
        source.remove_prefix(std::min(end + 1, source.size()));
        const auto skip_blanks = [&line] { line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size())); };
        skip_blanks();
        if (!line.starts_with('#')) continue;
        line.remove_prefix(1);
        skip_blanks();
        constexpr std::string_view keyword = "include";
        if (!line.starts_with(keyword)) continue;
        line.remove_prefix(keyword.size());
        skip_blanks();
        if (line.empty() || (line.front() != '"' && line.front() != '<')) continue;
        const bool quoted = line.front() == '"';
        line.remove_prefix(1);
        includes.push_back({std::string(line.substr(0, line.find(quoted ? '"' : '>'))), quoted, line_number});
    }
    return includes;
}

std::optional<std::string> include_fault(std::string_view file, const Include& include) {
    for (const ForeignLibrary& library : foreign_libraries()) {
        const bool is_its_header = std::ranges::any_of(
            library.beginnings, [&](std::string_view beginning) { return include.path.starts_with(beginning); });
        if (!is_its_header) continue;
        if (is_within(file, library.only_in)) return std::nullopt;
        return fmt::format("{} is seen by {} only", library.name, library.only_in);
    }
    const auto from = room_of(file), to = room_of(include.path);
    if (!from) return fmt::format("{} is in no room; allowed: {}", file, fmt::join(rooms, ", "));
    if (!to) {
        if (!include.quoted) return std::nullopt; // the standard library and plain libraries
        return fmt::format(
            "\"{}\" does not begin with a room; allowed: paths from the root, such as \"core/scene/scene.h\"",
            include.path);
    }
    if (!include.quoted) return fmt::format("<{}> is our own; allowed: quotes", include.path);
    if (*to > *from) return fmt::format("{} may not see {}: includes point one way only", rooms[*from], rooms[*to]);
    return std::nullopt;
}

std::optional<std::string> root_entry_fault(std::string_view name, bool is_folder) {
    constexpr std::array<std::string_view, 5> folders{"core", "editor", "ui", "assets", "tests"};
    constexpr std::array<std::string_view, 3> files{"CMakeLists.txt", "README.md", "LICENSE"};
    if (name.starts_with('.')) return std::nullopt;
    if (is_folder && name.starts_with("build")) return std::nullopt; // ignored by git
    if (is_folder ? std::ranges::find(folders, name) != folders.end() : std::ranges::find(files, name) != files.end())
        return std::nullopt;
    return fmt::format("{} does not belong in the root; allowed: {}, {}", name, fmt::join(folders, ", "),
                       fmt::join(files, ", "));
}

std::optional<std::string> asset_fault(std::string_view file, std::uintmax_t bytes) {
    constexpr std::uintmax_t limit = 4 * 1024 * 1024;
    if (bytes <= limit) return std::nullopt;
    return fmt::format("{} has {} bytes; allowed: {}", file, bytes, limit);
}

} // namespace lueur
