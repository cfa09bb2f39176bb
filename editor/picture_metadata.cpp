#include "editor/picture_metadata.h"

#include <array>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "core/display/display_words.h"
#include "core/display/metadata_text.h"
#include "core/scene/solver_words.h"

namespace lueur {

std::string to_string(PictureQuantity quantity) {
    switch (quantity) {
    case PictureQuantity::colour:
        return "colour";
    case PictureQuantity::luminance:
        return "luminance";
    case PictureQuantity::illuminance:
        return "illuminance";
    case PictureQuantity::colour_difference:
        return "colour_difference";
    case PictureQuantity::error:
        return "error";
    }
    return {};
}

namespace {

std::string coordinates(const glm::dvec3& v) {
    return fmt::format("{} {} {}", v.x, v.y, v.z);
}

const char* word(bool value) {
    return value ? "yes" : "no";
}

// Reads values by key and keeps the first complaint.
struct Words {
    const ImageMetadata& metadata;
    std::optional<std::string> fault;

    const std::string* find(const std::string& key) {
        const auto found = metadata.find("lueur:" + key);
        if (found != metadata.end()) return &found->second;
        if (!fault) fault = fmt::format("the picture does not say its {}", key);
        return nullptr;
    }
    template <typename Value>
    void numbers(const std::string& key, Value* first, std::size_t count) {
        const std::string* text = find(key);
        if (!text) return;
        const char *place = text->data(), *const end = place + text->size();
        for (std::size_t i = 0; i < count; ++i) {
            while (place != end && *place == ' ') ++place;
            const auto [next, error] = std::from_chars(place, end, first[i]);
            if (error != std::errc()) return complain(key, *text);
            place = next;
        }
        if (place != end) complain(key, *text);
    }
    template <typename Value>
    void number(const std::string& key, Value& value) {
        numbers(key, &value, 1);
    }
    void truth(const std::string& key, bool& value) {
        const std::string* text = find(key);
        if (!text) return;
        value = *text == "yes";
        if (*text != "yes" && *text != "no") complain(key, *text);
    }
    template <typename Enum, std::size_t N>
    void choice(const std::string& key, Enum& value, const std::array<Enum, N>& all) {
        const std::string* text = find(key);
        if (!text) return;
        for (const Enum one : all)
            if (to_string(one) == *text) {
                value = one;
                return;
            }
        complain(key, *text);
    }
    void complain(const std::string& key, const std::string& text) {
        if (!fault) fault = fmt::format("{} = \"{}\" cannot be read", key, text);
    }
};

} // namespace

ImageMetadata picture_metadata(const Scene& scene, const std::filesystem::path& scene_file, const Camera& camera,
                               const SolveStatus& status, PictureQuantity quantity) {
    const SolveSettings& solve = scene.solve;
    ImageMetadata metadata{
        {"lueur:version", LUEUR_VERSION},
        {"lueur:scene", scene_file.filename().string()},
        {"lueur:scene_name", scene.name},
        {"lueur:quantity", to_string(quantity)},
        {"lueur:solver", to_string(solve.solver)},
        {"lueur:form_factors", to_string(solve.form_factors)},
        {"lueur:form_factor_samples", fmt::format("{}", solve.form_factor_samples)},
        {"lueur:oracle", to_string(solve.oracle)},
        {"lueur:link_tolerance", fmt::format("{}", solve.link_tolerance)},
        {"lueur:matrix_memory", fmt::format("{}", solve.matrix_memory)},
        {"lueur:wavelengths", to_string(solve.wavelengths)},
        {"lueur:colour_error", fmt::format("{}", solve.colour_error)},
        {"lueur:seed", fmt::format("{}", solve.seed)},
        {"lueur:target_error", fmt::format("{}", solve.target_error)},
        {"lueur:element_size", fmt::format("{}", solve.element_size)},
        {"lueur:max_rays", fmt::format("{}", solve.max_rays)},
        {"lueur:colour_error", fmt::format("{}", solve.colour_error)},
        {"lueur:compare_trichromatic", word(solve.compare_trichromatic)},
        {"lueur:estimated_error_percent", fmt::format("{:.4g}", 100 * status.estimated_error)},
        {"lueur:unshot_share", fmt::format("{:.4g}", status.unshot_share)},
        {"lueur:settled", word(status.settled)},
        {"lueur:rays", fmt::format("{}", status.rays)},
        {"lueur:sweeps", fmt::format("{}", status.sweeps)},
        {"lueur:shots", fmt::format("{}", status.shots)},
        {"lueur:camera_position", coordinates(camera.position)},
        {"lueur:camera_target", coordinates(camera.target)},
        {"lueur:camera_up", coordinates(camera.up)},
        {"lueur:camera_vertical_fov_degrees", fmt::format("{}", camera.vertical_fov_degrees)},
        {"lueur:camera_mirrored", word(camera.mirrored)},
    };
    std::error_code error;
    if (const auto path = std::filesystem::absolute(scene_file, error); !scene_file.empty() && !error)
        metadata["lueur:scene_path"] = path.lexically_normal().string();
    return metadata;
}

void add_display_metadata(ImageMetadata& metadata, const DisplaySettings& display, bool false_colour) {
    for (const auto& [key, value] : words_from_display(display)) metadata["lueur:" + key] = value;
    metadata["lueur:false_colour"] = word(false_colour);
}

std::expected<PictureRecipe, std::string> recipe_from_metadata(const ImageMetadata& metadata) {
    PictureRecipe recipe;
    Words words{metadata, {}};
    if (const auto* version = words.find("version")) recipe.version = *version;
    if (const auto* name = words.find("scene_name")) recipe.scene_name = *name;
    if (const auto path = metadata.find("lueur:scene_path"); path != metadata.end()) recipe.scene_file = path->second;
    words.choice("quantity", recipe.quantity,
                 std::array{PictureQuantity::colour, PictureQuantity::luminance, PictureQuantity::illuminance,
                            PictureQuantity::colour_difference, PictureQuantity::error});
    words.choice("solver", recipe.solve.solver, all_solvers);
    words.choice("form_factors", recipe.solve.form_factors, all_form_factor_methods);
    words.number("form_factor_samples", recipe.solve.form_factor_samples);
    words.choice("oracle", recipe.solve.oracle, all_oracles);
    words.number("link_tolerance", recipe.solve.link_tolerance);
    words.number("matrix_memory", recipe.solve.matrix_memory);
    if (const auto* text = words.find("wavelengths")) {
        if (const auto spec = parse_wavelengths(*text))
            recipe.solve.wavelengths = *spec;
        else
            words.complain("wavelengths", *text);
    }
    words.number("colour_error", recipe.solve.colour_error);
    words.number("seed", recipe.solve.seed);
    words.number("target_error", recipe.solve.target_error);
    words.number("element_size", recipe.solve.element_size);
    words.number("max_rays", recipe.solve.max_rays);
    words.number("colour_error", recipe.solve.colour_error);
    words.truth("compare_trichromatic", recipe.solve.compare_trichromatic);
    words.numbers("camera_position", &recipe.camera.position.x, 3);
    words.numbers("camera_target", &recipe.camera.target.x, 3);
    words.numbers("camera_up", &recipe.camera.up.x, 3);
    words.number("camera_vertical_fov_degrees", recipe.camera.vertical_fov_degrees);
    words.truth("camera_mirrored", recipe.camera.mirrored);
    if (metadata.contains("lueur:false_colour")) words.truth("false_colour", recipe.false_colour);

    std::map<std::string, std::string> display;
    for (const auto& [key, value] : metadata)
        if (key.starts_with(metadata_prefix)) display[key.substr(metadata_prefix.size())] = value;
    if (const auto fault = read_display_words(recipe.display, display); fault && !words.fault) words.fault = fault;
    if (words.fault) return std::unexpected(*words.fault);
    return recipe;
}

} // namespace lueur
