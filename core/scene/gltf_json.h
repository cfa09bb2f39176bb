// The JSON of a glTF file, for what assimp 5.2 does not give: the place of a syntax error, and emissive strength.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/diagnostics.h"

namespace lueur {

struct GltfJson {
    std::vector<double>
        emissive_strength;            // of each material; 1 where nothing is said (KHR_materials_emissive_strength)
    std::vector<double> vertical_fov; // of each camera, radians; 0 where it has none: assimp's versions disagree on
                                      // what they make of it
};

// `bytes` is a whole .gltf or .glb. Nothing where it is neither; then there is an error.
std::optional<GltfJson> read_gltf_json(const std::string& bytes, const std::string& file, Diagnostics& diagnostics);

} // namespace lueur
