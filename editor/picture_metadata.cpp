#include "editor/picture_metadata.h"

#include <fmt/format.h>

namespace lueur {

std::string to_string(SolverKind solver) {
    switch (solver) {
    case SolverKind::gathering:
        return "gathering";
    case SolverKind::shooting:
        return "shooting";
    }
    return {};
}

std::string to_string(PictureQuantity quantity) {
    switch (quantity) {
    case PictureQuantity::colour:
        return "colour";
    case PictureQuantity::luminance:
        return "luminance";
    case PictureQuantity::illuminance:
        return "illuminance";
    }
    return {};
}

namespace {
std::string coordinates(const glm::dvec3& v) {
    return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z);
}
} // namespace

ImageMetadata picture_metadata(const Scene& scene, const std::filesystem::path& scene_file, const Camera& camera,
                               const SolveStatus& status, PictureQuantity quantity) {
    ImageMetadata metadata{
        {"lueur:version", LUEUR_VERSION},
        {"lueur:scene", scene_file.filename().string()},
        {"lueur:quantity", to_string(quantity)},
        {"lueur:solver", to_string(scene.solve.solver)},
        {"lueur:wavelengths", to_string(scene.solve.wavelengths)},
        {"lueur:seed", fmt::format("{}", scene.solve.seed)},
        {"lueur:target_error_percent", fmt::format("{:.4g}", 100 * scene.solve.target_error)},
        {"lueur:estimated_error_percent", fmt::format("{:.4g}", 100 * status.estimated_error)},
        {"lueur:unshot_share", fmt::format("{:.4g}", status.unshot_share)},
        {"lueur:settled", status.settled ? "yes" : "no"},
        {"lueur:rays", fmt::format("{}", status.rays)},
        {"lueur:sweeps", fmt::format("{}", status.sweeps)},
        {"lueur:shots", fmt::format("{}", status.shots)},
        // Metres, Y up.
        {"lueur:camera_position", coordinates(camera.position)},
        {"lueur:camera_target", coordinates(camera.target)},
        {"lueur:camera_up", coordinates(camera.up)},
        {"lueur:camera_vertical_fov_degrees", fmt::format("{:.6g}", camera.vertical_fov_degrees)},
        {"lueur:camera_mirrored", camera.mirrored ? "yes" : "no"},
    };
    if (!scene.name.empty()) metadata["lueur:scene_name"] = scene.name;
    return metadata;
}

void add_display_metadata(ImageMetadata& metadata, const DisplaySettings& display) {
    metadata["lueur:max_display"] = fmt::format("{:.6g}", display.max_display);
    metadata["lueur:clip"] = to_string(display.clip);
    metadata["lueur:curve"] = to_string(display.curve);
    if (display.curve == TransferCurve::gamma) metadata["lueur:gamma"] = fmt::format("{:.6g}", display.gamma);
}

} // namespace lueur
