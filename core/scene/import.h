// Geometry files as they are: .obj with its .mtl, and .gltf, .glb.
//
// OBJ is read here (obj_file.cpp, mtl_file.cpp) and not by assimp, which drops a face with an index out of range, takes
// "nan" as 0 and gives no line. glTF goes through assimp (gltf_file.cpp, the only code that sees it).
#pragma once

#include <expected>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/scene/diagnostics.h"
#include "core/scene/scene.h"
#include "core/scene/surfaces.h"

namespace lueur {

struct ImportRequest {
    std::filesystem::path file;
    std::string written; // its path as the scene file writes it; paths of its textures are written beside it
    LengthUnit unit = LengthUnit::metre; // of an .obj
    UpAxis up = UpAxis::y;               // of an .obj
};

struct ImportedEmission { // OBJ Ke, glTF emissive factor: radiance per channel
    ObjectIndex object{};
    Rgb radiance{0};
    EmitSide side = EmitSide::front;
};

struct ImportedModel {
    TriangleSoup soup; // metres, Y up; its objects are those below
    std::vector<Object> objects;
    std::vector<Material>
        materials; // of a textured one the reflectance is what its texels are multiplied by (glTF base colour, MTL Kd)
    std::vector<ImportedEmission> emission;
    std::map<std::string, std::shared_ptr<const TextureImage>> pictures; // inside the file: "*0", ...
    std::optional<Camera> camera;
};

// Nothing where the file is unusable; then there is an error in `diagnostics`. Names of objects and materials are
// unique in the model.
std::optional<ImportedModel> import_model(const ImportRequest& request, Diagnostics& diagnostics);

// The two behind it.
std::optional<ImportedModel> read_obj(const ImportRequest& request, Diagnostics& diagnostics);
std::optional<ImportedModel> read_gltf(const ImportRequest& request, Diagnostics& diagnostics);

// Names that nothing else has: the one wanted, or "name 2", "name 3", ...
class UniqueNames {
public:
    std::string take(const std::string& wanted);

private:
    std::set<std::string> taken_;
};

} // namespace lueur
