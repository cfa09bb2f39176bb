#include "core/scene/scene_file.h"

#include <fstream>

#include "core/scene/build_scene.h"
#include "core/scene/files.h"

namespace lueur {

namespace fs = std::filesystem;

namespace {

std::optional<Scene> load_toml(const fs::path& file, const LoadParams& params, Diagnostics& diagnostics) {
    const std::string name = file.string();
    const auto text = read_bytes(file);
    if (!text) {
        diagnostics.error(name, {}, text.error());
        return {};
    }
    if (text->find_first_not_of(" \t\r\n") == std::string::npos) {
        diagnostics.error(name, {}, "is empty; a scene needs units and at least one [[geometry]] or [[polygon]]");
        return {};
    }
    std::optional<SceneDescription> description =
        read_toml_scene(*text, name, file.parent_path(), params.spectrum_library, diagnostics);
    if (!description) return {};
    if (description->name.empty()) description->name = file.stem().string();
    return build_scene(*description, name, file.parent_path(), diagnostics);
}

std::optional<Scene> load_geometry_as_scene(const fs::path& file, Diagnostics& diagnostics) {
    SceneDescription description;
    description.name = file.stem().string();
    GeometryEntry entry;
    entry.file.path = file.filename().generic_string();
    description.geometry.push_back(std::move(entry));
    return build_scene(description, file.string(), file.parent_path(), diagnostics);
}

} // namespace

std::expected<LoadedScene, std::vector<std::string>> load_scene(const fs::path& file, const LoadParams& params) {
    Diagnostics diagnostics;
    std::optional<Scene> scene;
    const std::string extension = lower_case_extension(file);
    if (const auto why = why_unreadable(file))
        diagnostics.error(file.string(), {}, *why + "; a .toml, .obj, .gltf or .glb file is allowed");
    else if (extension == ".toml")
        scene = load_toml(file, params, diagnostics);
    else if (extension == ".obj" || extension == ".gltf" || extension == ".glb")
        scene = load_geometry_as_scene(file, diagnostics);
    else
        diagnostics.error(file.string(), {},
                          fmt::format("\"{}\" is not a scene; .toml, .obj, .gltf or .glb is allowed", extension));
    if (!scene || !diagnostics.errors.empty()) return std::unexpected(std::move(diagnostics.errors));
    return LoadedScene{std::move(*scene), std::move(diagnostics.warnings)};
}

std::expected<void, std::string> save_scene(const Scene& scene, const fs::path& file) {
    if (lower_case_extension(file) != ".toml")
        return std::unexpected(fmt::format("{}: a scene is saved as .toml only", file.string()));
    std::error_code error;
    const fs::path folder = fs::absolute(file, error).parent_path();
    if (!fs::is_directory(folder, error))
        return std::unexpected(
            fmt::format("{}: the folder is not there; a file in an existing folder is allowed", file.string()));
    if (fs::is_directory(file, error))
        return std::unexpected(fmt::format("{}: is a folder; a file is allowed", file.string()));
    const std::string text = scene_to_toml(scene, folder);
    fs::path beside = file; // in the same folder, so that the renaming cannot be torn
    beside += ".part";
    {
        std::ofstream stream(beside, std::ios::binary | std::ios::trunc);
        stream.write(text.data(), static_cast<std::streamsize>(text.size()));
        stream.close();
        if (!stream) {
            fs::remove(beside, error);
            return std::unexpected(fmt::format("{}: cannot be written", file.string()));
        }
    }
    fs::rename(beside, file, error);
    if (!error) return {};
    const std::string why = error.message();
    fs::remove(beside, error);
    return std::unexpected(fmt::format("{}: cannot be written: {}", file.string(), why));
}

} // namespace lueur
