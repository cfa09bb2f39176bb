#include "editor/asset_path.h"

#include <system_error>

namespace lueur {

std::filesystem::path asset_path(const std::filesystem::path& name) {
    std::error_code error;
    const auto executable = std::filesystem::read_symlink("/proc/self/exe", error);
    if (!error) {
        const auto folder = executable.parent_path();
        for (const auto& assets : {folder / "assets", folder / "../share/lueur/assets"})
            if (std::filesystem::exists(assets / name, error)) return (assets / name).lexically_normal();
    }
    return std::filesystem::path(LUEUR_SOURCE_DIR) / "assets" / name;
}

std::filesystem::path default_scene_file() {
    return asset_path("cornell.toml");
}

} // namespace lueur
