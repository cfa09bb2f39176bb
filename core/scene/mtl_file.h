// Materials of .obj files (Wavefront MTL): Kd, Ke, map_Kd. Everything that is not diffuse or emission is left out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/diagnostics.h"
#include "core/scene/scene.h"

namespace lueur {

struct MtlMaterial {
    std::string name;
    std::optional<Rgb> kd; // each 0..1
    Rgb ke{0};             // radiance, each >= 0
    std::string map_kd;    // path as written, seen from the .mtl; empty: none
    Place map_kd_place;
};

// Errors carry the .mtl's own lines. Nothing where the file cannot be read (told by the caller, who knows who asked for
// it).
std::optional<std::vector<MtlMaterial>> read_mtl(const std::filesystem::path& file, Diagnostics& diagnostics);

} // namespace lueur
