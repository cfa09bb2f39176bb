// A scene as TOML (scene_file.h has the format). Numbers are the shortest that read back exactly, so that saving again
// changes no byte.
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/scene/files.h"
#include "core/scene/scene_file.h"
#include "core/scene/solver_words.h"
#include "core/scene/toml_display.h"
#include "core/scene/units.h"

namespace lueur {

namespace {

std::string quoted(const std::string& text) { // TOML basic string
    std::string result = "\"";
    for (const char letter : text) switch (letter) {
        case '"':
            result += "\\\"";
            break;
        case '\\':
            result += "\\\\";
            break;
        case '\n':
            result += "\\n";
            break;
        case '\t':
            result += "\\t";
            break;
        default:
            if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f)
                result += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(letter)));
            else
                result += letter;
        }
    return result + "\"";
}

std::string number(double value) {
    return fmt::format("{}", value + 0.0);
} // "-0" would be read as the integer 0

template <int count>
std::string numbers(const glm::vec<count, double>& values) {
    std::string result = "[";
    for (int i = 0; i < count; ++i) result += (i ? ", " : "") + number(values[i]);
    return result + "]";
}

template <int count>
std::string list(const std::vector<glm::vec<count, double>>& rows) {
    std::string result = "[";
    for (std::size_t i = 0; i < rows.size(); ++i) result += (i ? ", " : "") + numbers(rows[i]);
    return result + "]";
}

const char* truth(bool value) {
    return value ? "true" : "false";
}

const char* power_word(PowerUnit unit) {
    switch (unit) {
    case PowerUnit::lumen:
        return "lumen";
    case PowerUnit::watt:
        return "watt";
    case PowerUnit::exitance:
        return "exitance";
    case PowerUnit::radiance:
        return "radiance";
    }
    return "";
}

const char* side_word(EmitSide side) {
    switch (side) {
    case EmitSide::front:
        return "front";
    case EmitSide::back:
        return "back";
    case EmitSide::both:
        return "both";
    }
    return "";
}

struct Writer {
    const Scene& scene;
    const std::filesystem::path& folder;
    std::string text{};

    template <typename... Arguments>
    void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
        text += '\n';
    }
    std::string path(const std::string& written) const {
        return quoted(path_from_folder(written, scene.folder, folder));
    }
    std::string file_point(const glm::dvec3& point) const {
        return numbers(file_from_world(point, scene.unit, scene.up));
    }

    std::string spectrum(const SpectrumFile& file) const {
        const std::string column = file.column.empty() ? "" : ", column = " + quoted(file.column);
        const bool bin = file.spectrum.interpolation == Interpolation::bin;
        return fmt::format("{{ file = {}{}{} }}", path(file.path), column, bin ? ", interpolation = \"bin\"" : "");
    }
    std::string spectrum(const LibrarySpectrum& library) const {
        return fmt::format("{{ library = {} }}", quoted(library.name));
    }
    std::string spectrum(const Drawn& drawn) const {
        std::vector<glm::dvec2> points;
        for (std::size_t i = 0; i < drawn.spectrum.nm.size(); ++i)
            points.emplace_back(drawn.spectrum.nm[i], drawn.spectrum.value[i]);
        return fmt::format("{{ points = {} }}", list(points));
    }
    std::string spectrum(double grey) const { return number(grey); }
    std::string spectrum(const Rgb& colour) const { return numbers(colour); }
    std::string spectrum(const Flat&) const { return "\"flat\""; }
    std::string spectrum(const Blackbody& body) const {
        return fmt::format("{{ blackbody = {} }}", number(body.kelvin));
    }
    std::string spectrum(const Daylight& day) const { return fmt::format("{{ daylight = {} }}", number(day.kelvin)); }
    std::string spectrum(const Lines& lines) const {
        std::string each;
        for (const SpectralLine& one : lines.lines)
            each += fmt::format("{}{{ nm = {}, width = {}, power = {} }}", each.empty() ? "" : ", ", number(one.nm),
                                number(one.width), number(one.power));
        return fmt::format("{{ lines = [{}] }}", each);
    }
    std::string spectrum(const Mix& mix) const {
        const auto one = [this](const auto& light) { return spectrum(light); };
        return fmt::format("{{ mix = [{}, {}], share = {} }}", std::visit(one, mix.lights[0]),
                           std::visit(one, mix.lights[1]), number(mix.share));
    }

    void source(const GeometryFile& file) {
        line("\n[[geometry]]");
        line("file = {}", path(file.path));
        if (file.unit) line("units = \"{}\"", to_string(*file.unit));
        if (file.up) line("up = \"{}\"", to_string(*file.up));
        if (file.imported && file.imported->emissive)
            line("imported_emission = false # the luminaires below say it all");
    }

    void source(const InlinePolygon& polygon, const std::map<std::string, std::string>& material_of_object) {
        const auto current = material_of_object.find(polygon.name);
        line("\n[[polygon]]");
        line("name = {}", quoted(polygon.name));
        line("material = {}", quoted(current == material_of_object.end() ? polygon.material : current->second));
        line("vertices = {}", list(polygon.vertices));
        if (!polygon.uv.empty()) line("uv = {}", list(polygon.uv));
    }

    void sources() {
        std::map<std::string, std::string> material_of_object, imported_material;
        std::set<std::string> textured;
        for (const Object& object : scene.objects)
            material_of_object[object.name] = scene.materials[at(object.material)].name;
        for (const GeometrySource& one : scene.sources)
            if (const auto* file = std::get_if<GeometryFile>(&one)) {
                source(*file);
                if (!file->imported) continue;
                imported_material.insert(file->imported->object_material.begin(),
                                         file->imported->object_material.end());
                textured.insert(file->imported->textured_materials.begin(), file->imported->textured_materials.end());
            }
        for (const GeometrySource& one : scene.sources)
            if (const auto* polygon = std::get_if<InlinePolygon>(&one)) source(*polygon, material_of_object);
        for (const Object& object : scene.objects) {
            const auto imported = imported_material.find(object.name);
            const std::string& now = material_of_object[object.name];
            if (imported == imported_material.end() || imported->second == now) continue;
            line("\n[[object]]");
            line("name = {}", quoted(object.name));
            line("material = {}", quoted(now));
        }
        for (const Material& one : scene.materials) material(one, textured.contains(one.name));
    }

    void material(const Material& one, bool imported_texture) {
        line("\n[[material]]");
        line("name = {}", quoted(one.name));
        const Rgb* rgb = std::get_if<Rgb>(&one.reflectance);
        if (!one.texture || !rgb || *rgb != one.texture->mean)
            line("reflectance = {}", std::visit([this](const auto& kind) { return spectrum(kind); }, one.reflectance));
        if (one.texture)
            line("texture = {}", path(one.texture->path));
        else if (imported_texture)
            line("texture = \"none\"");
        line("two_sided = {}", truth(one.two_sided));
    }

    void luminaire(const Luminaire& one) {
        line("\n[[luminaire]]");
        line("name = {}", quoted(one.name));
        std::string names;
        for (const ObjectIndex object : one.objects)
            names += (names.empty() ? "" : ", ") + quoted(scene.objects[at(object)].name);
        line("objects = [{}]", names);
        line("spectrum = {}", std::visit([this](const auto& kind) { return spectrum(kind); }, one.spectrum));
        line("power = {{ {} = {} }}", power_word(one.unit), number(one.power));
        line("dimmer = {}", number(one.dimmer));
        line("side = \"{}\"", side_word(one.side));
    }

    void settings() {
        const Camera& camera = scene.camera;
        line("\n[camera]");
        line("position = {}", file_point(camera.position));
        line("target = {}", file_point(camera.target));
        line("up = {}", numbers(file_from_world(camera.up, LengthUnit::metre, scene.up)));
        line("vertical_fov_degrees = {}", number(camera.vertical_fov_degrees));
        line("mirrored = {}", truth(camera.mirrored));

        line("\n[display]");
        text += toml_from_display(scene.display);

        const SolveSettings& solve = scene.solve;
        line("\n[solve]");
        line("solver = \"{}\"", to_string(solve.solver));
        line("form_factors = \"{}\"", to_string(solve.form_factors));
        line("form_factor_samples = {}", solve.form_factor_samples);
        line("oracle = \"{}\"", to_string(solve.oracle));
        line("link_tolerance = {}", number(solve.link_tolerance));
        line("matrix_memory = {}", solve.matrix_memory);
        line("wavelengths = \"{}\"", to_string(solve.wavelengths));
        line("colour_error = {}", number(solve.colour_error));
        line("compare_trichromatic = {}", truth(solve.compare_trichromatic));
        line("target_error = {}", number(solve.target_error));
        line("element_size = {}", number(length_from_metres(solve.element_size, scene.unit)));
        line("max_rays = {}", solve.max_rays);
        line("seed = {}", solve.seed);
    }
};

} // namespace

std::string scene_to_toml(const Scene& scene, const std::filesystem::path& folder) {
    Writer writer{scene, folder};
    if (!scene.name.empty()) writer.line("name = {}", quoted(scene.name));
    writer.line("units = \"{}\"", to_string(scene.unit));
    writer.line("up = \"{}\"", to_string(scene.up));
    writer.sources();
    for (const Luminaire& luminaire : scene.luminaires) writer.luminaire(luminaire);
    writer.settings();
    return std::move(writer.text);
}

} // namespace lueur
