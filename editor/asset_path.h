// Where the data that come with the program are.
#pragma once

#include <filesystem>

namespace lueur {

// A file under assets/: beside the executable when it was moved there together with its assets, else in the source tree
// it was built from.
std::filesystem::path asset_path(const std::filesystem::path& name);

std::filesystem::path default_scene_file(); // the measured Cornell box

} // namespace lueur
