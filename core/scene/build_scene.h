// From what a scene file says to a scene: geometry is read, names are resolved, surfaces are made.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/scene/scene_description.h"

namespace lueur {

// `file` is the scene file's name for messages; paths are seen from `folder`. Nothing where there were errors, here or
// before.
std::optional<Scene> build_scene(const SceneDescription& description, const std::string& file,
                                 const std::filesystem::path& folder, Diagnostics& diagnostics);

} // namespace lueur
