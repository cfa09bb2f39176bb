#include "core/scene/import.h"

#include "core/scene/files.h"

namespace lueur {

std::string UniqueNames::take(const std::string& wanted) {
    std::string name = wanted;
    for (int number = 2; !taken_.insert(name).second; ++number) name = fmt::format("{} {}", wanted, number);
    return name;
}

std::optional<ImportedModel> import_model(const ImportRequest& request, Diagnostics& diagnostics) {
    const std::string extension = lower_case_extension(request.file);
    const bool obj = extension == ".obj", gltf = extension == ".gltf" || extension == ".glb";
    if (!obj && !gltf) {
        diagnostics.error(request.file.string(), {},
                          fmt::format("\"{}\" is not a geometry file; .obj, .gltf or .glb is allowed", extension));
        return {};
    }
    return obj ? read_obj(request, diagnostics) : read_gltf(request, diagnostics);
}

} // namespace lueur
