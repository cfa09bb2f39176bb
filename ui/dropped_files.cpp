#include "ui/dropped_files.h"

#include <algorithm>
#include <cctype>

#include "core/scene/scene_file.h"
#include "core/spectrum/read_spectrum.h"

namespace lueur {
namespace {

std::string extension_of(const std::filesystem::path& file) {
    auto text = file.extension().string();
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::expected<SpectrumFile, std::string> read(const std::filesystem::path& file, const std::string& column,
                                              const Scene& scene) {
    auto spectrum = read_spectrum(file, column);
    if (!spectrum) {
        const auto& errors = spectrum.error();
        if (errors.empty()) return std::unexpected(file.string() + ": cannot be read");
        const auto more = errors.size() > 1 ? " (and " + std::to_string(errors.size() - 1) + " more)" : std::string();
        return std::unexpected(errors.front() + more);
    }
    std::error_code error;
    auto path = std::filesystem::relative(file, scene.folder.empty() ? "." : scene.folder, error);
    if (error || path.empty()) path = std::filesystem::absolute(file, error);
    return SpectrumFile{path.string(), column, std::move(*spectrum)};
}

} // namespace

std::vector<std::string> picture_extensions() {
    return {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".tga", ".exr", ".hdr"};
}

DroppedKind kind_of_dropped(const std::filesystem::path& file) {
    const auto extension = extension_of(file);
    for (const char* scene : {".toml", ".obj", ".gltf", ".glb"})
        if (extension == scene) return DroppedKind::scene;
    if (std::ranges::count(spectrum_extensions(), extension)) return DroppedKind::spectrum;
    return std::ranges::count(picture_extensions(), extension) ? DroppedKind::picture : DroppedKind::unknown;
}

std::expected<Edit, std::string> texture_edit(const std::filesystem::path& file, const Scene& scene,
                                              MaterialIndex material) {
    auto texture = load_texture(scene, file);
    if (!texture) return std::unexpected(texture.error());
    return SetTexture{material, std::move(*texture)};
}

std::expected<Edit, std::string> reflectance_edit(const std::filesystem::path& file, const std::string& column,
                                                  const Scene& scene, MaterialIndex material) {
    auto spectrum = read(file, column, scene);
    if (!spectrum) return std::unexpected(spectrum.error());
    return SetReflectance{material, std::move(*spectrum)};
}

std::expected<Edit, std::string> emission_edit(const std::filesystem::path& file, const std::string& column,
                                               const Scene& scene, LuminaireIndex luminaire) {
    auto spectrum = read(file, column, scene);
    if (!spectrum) return std::unexpected(spectrum.error());
    return SetEmissionSpectrum{luminaire, std::move(*spectrum)};
}

std::expected<Edit, std::string> edit_of_dropped(const std::filesystem::path& file, const Scene& scene,
                                                 const std::optional<Probe>& target, const SpectrumTarget& open) {
    if (!target && kind_of_dropped(file) == DroppedKind::spectrum) {
        const auto* luminaire = std::get_if<LuminaireIndex>(&open);
        if (luminaire && at(*luminaire) < scene.luminaires.size()) return emission_edit(file, {}, scene, *luminaire);
        const auto* material = std::get_if<MaterialIndex>(&open);
        if (material && at(*material) < scene.materials.size()) return reflectance_edit(file, {}, scene, *material);
    }
    if (!target || at(target->material) >= scene.materials.size())
        return std::unexpected(file.filename().string() + ": drop it on the surface it is for");
    if (kind_of_dropped(file) == DroppedKind::picture) return texture_edit(file, scene, target->material);
    if (target->luminaire) return emission_edit(file, {}, scene, *target->luminaire);
    return reflectance_edit(file, {}, scene, target->material);
}

} // namespace lueur
