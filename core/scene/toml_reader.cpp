// The tables of a scene file (scene_file.h has the format).
#include <functional>

#include "core/scene/files.h"
#include "core/scene/scene_description.h"
#include "core/scene/solver_words.h"
#include "core/scene/toml_display.h"
#include "core/scene/toml_spectra.h"
#include "core/scene/toml_values.h"
#include "core/scene/units.h"

namespace lueur {

namespace {

const NumberRange any_number{-1e9, 1e9, true, "-1e9..1e9"};
const NumberRange not_negative{0, 1e12, true, "0..1e12"};

const std::vector<std::pair<std::string, LengthUnit>> unit_words{{"metre", LengthUnit::metre},
                                                                 {"centimetre", LengthUnit::centimetre},
                                                                 {"millimetre", LengthUnit::millimetre},
                                                                 {"foot", LengthUnit::foot},
                                                                 {"inch", LengthUnit::inch}};
const std::vector<std::pair<std::string, UpAxis>> up_words{{"y", UpAxis::y}, {"z", UpAxis::z}};

struct Reader {
    TomlFile file;
    TomlSpectra spectra;
    SceneDescription scene;

    void read(const toml::table& root);

private:
    void each_table(const toml::node* node, std::string_view key,
                    const std::function<void(const toml::table&)>& read_one);
    std::optional<PlacedName> placed_name(TomlTable& table, std::string_view key, std::string_view allowed);

    void read_geometry(const toml::table& table);
    void read_polygon(const toml::table& table);
    void read_object(const toml::table& table);
    void read_material(const toml::table& table);
    void read_luminaire(const toml::table& table);
    void read_camera(const toml::table& table);
    void read_display(const toml::table& table);
    void read_solve(const toml::table& table);

    void read_power(const toml::node& node, Luminaire& luminaire);
};

void Reader::each_table(const toml::node* node, std::string_view key,
                        const std::function<void(const toml::table&)>& read_one) {
    if (!node) return;
    const toml::array* array = node->as_array();
    if (!array) {
        file.error(*node, fmt::format("{} is not a list of tables; write [[{}]]", key, key));
        scene.names_complete = false;
        return;
    }
    for (const toml::node& element : *array) {
        if (const toml::table* table = element.as_table())
            read_one(*table);
        else {
            file.error(element, fmt::format("{} holds something that is not a table; write [[{}]]", key, key));
            scene.names_complete = false;
        }
    }
}

std::optional<PlacedName> Reader::placed_name(TomlTable& table, std::string_view key, std::string_view allowed) {
    if (!table.table().contains(key)) {
        table.require(key, allowed);
        return {};
    }
    const std::optional<std::string> name = table.text(key);
    if (!name) return {};
    return PlacedName{*name, place_of(*table.table().get(key))};
}

void Reader::read_geometry(const toml::table& node) {
    TomlTable table(file, node, "[[geometry]]");
    GeometryEntry entry;
    const auto path = placed_name(table, "file", "a path to an .obj, .gltf or .glb is needed");
    entry.file.unit = table.choice("units", unit_words);
    entry.file.up = table.choice("up", up_words);
    entry.imported_emission = table.boolean("imported_emission").value_or(true);
    table.finish();
    if (!path) {
        scene.names_complete = false;
        return;
    }
    const std::string extension = lower_case_extension(path->name);
    if (extension != ".obj")
        for (const char* key : {"units", "up"})
            if (const toml::node* said = node.get(key))
                file.error(*said, fmt::format("{} is for .obj only; glTF is metre and y up by its own standard", key));
    entry.file.path = path->name;
    entry.place = path->place;
    scene.geometry.push_back(std::move(entry));
}

void Reader::read_polygon(const toml::table& node) {
    TomlTable table(file, node, "[[polygon]]");
    PolygonEntry entry;
    const auto name = placed_name(table, "name", "a name is needed");
    const auto material = placed_name(table, "material", "the name of a material is needed");
    if (const toml::node* vertices = table.require("vertices", "at least 3 points [x, y, z] are needed")) {
        entry.vertices_place = place_of(*vertices);
        const toml::array* array = vertices->as_array();
        if (!array || array->size() < 3)
            file.error(*vertices, fmt::format("vertices {}; at least 3 points [x, y, z] are needed",
                                              array ? fmt::format("has {} points", array->size()) : "is not an array"));
        else {
            for (const toml::node& element : *array)
                if (const auto point = read_numbers(file, element, 3, any_number, "a vertex"))
                    entry.polygon.vertices.emplace_back((*point)[0], (*point)[1], (*point)[2]);
            if (entry.polygon.vertices.size() != array->size()) entry.polygon.vertices.clear();
            if (const toml::node* uv = table.find("uv")) {
                const toml::array* coordinates = uv->as_array();
                if (!coordinates || coordinates->size() != array->size())
                    file.error(*uv, fmt::format("uv {}; one [u, v] a vertex is allowed, here {}",
                                                coordinates ? fmt::format("has {} values", coordinates->size())
                                                            : "is not an array",
                                                array->size()));
                else
                    for (const toml::node& element : *coordinates)
                        if (const auto pair = read_numbers(file, element, 2, {-1e5, 1e5, true, "-1e5..1e5"}, "a uv"))
                            entry.polygon.uv.emplace_back((*pair)[0], (*pair)[1]);
                if (!coordinates || entry.polygon.uv.size() != coordinates->size()) entry.polygon.uv.clear();
            }
        }
    }
    if (!node.contains("vertices")) table.find("uv");
    table.finish();
    if (!name || !material) {
        scene.names_complete = false;
        return;
    }
    entry.polygon.name = name->name;
    entry.polygon.material = material->name;
    entry.name_place = name->place;
    entry.material_place = material->place;
    scene.polygons.push_back(std::move(entry));
}

void Reader::read_object(const toml::table& node) {
    TomlTable table(file, node, "[[object]]");
    const auto name = placed_name(table, "name", "the name of an object of a geometry file is needed");
    const auto material = placed_name(table, "material", "the name of a material is needed");
    table.finish();
    if (name && material) scene.objects.push_back({*name, *material});
}

void Reader::read_material(const toml::table& node) {
    TomlTable table(file, node, "[[material]]");
    MaterialEntry entry;
    const auto name = placed_name(table, "name", "a name is needed");
    if (const toml::node* reflectance = table.find("reflectance")) {
        entry.reflectance = spectra.reflectance(*reflectance);
        if (!entry.reflectance) entry.reflectance = 0.5; // told; not to be told again as missing
    }
    if (const auto path = table.text("texture")) entry.texture = TextureEntry{*path, place_of(*node.get("texture"))};
    if (!entry.texture && node.contains("texture") && !entry.reflectance) entry.reflectance = 0.5;
    entry.two_sided = table.boolean("two_sided");
    table.finish();
    if (!name) {
        scene.names_complete = false;
        return;
    }
    entry.name = *name;
    scene.materials.push_back(std::move(entry));
}

void Reader::read_power(const toml::node& node, Luminaire& luminaire) {
    const toml::table* inner = node.as_table();
    if (!inner || inner->size() != 1) {
        file.error(node, "power is not one of { lumen = 3000 }, { watt = 40 }, { exitance = 1 }, { radiance = 1 }");
        return;
    }
    TomlTable table(file, *inner, "power");
    const std::pair<const char*, PowerUnit> units[] = {{"lumen", PowerUnit::lumen},
                                                       {"watt", PowerUnit::watt},
                                                       {"exitance", PowerUnit::exitance},
                                                       {"radiance", PowerUnit::radiance}};
    for (const auto& [key, unit] : units)
        if (const auto power = table.number(key, not_negative)) {
            luminaire.power = *power;
            luminaire.unit = unit;
        }
    table.finish();
}

void Reader::read_luminaire(const toml::table& node) {
    TomlTable table(file, node, "[[luminaire]]");
    LuminaireEntry entry;
    const auto name = placed_name(table, "name", "a name is needed");
    if (const toml::node* objects = table.require("objects", "the names of the objects that emit are needed")) {
        const toml::array* array = objects->as_array();
        if (!array || array->empty())
            file.error(*objects, "objects names nothing; an array of at least one object's name is needed");
        else
            for (const toml::node& element : *array)
                if (const auto object = read_text(file, element, "an object's name"))
                    entry.objects.push_back({*object, place_of(element)});
    }
    if (const toml::node* spectrum = table.find("spectrum"))
        if (auto read = spectra.emission(*spectrum)) entry.luminaire.spectrum = std::move(*read);
    if (const toml::node* power =
            table.require("power", "{ lumen = 3000 }, { watt = 40 }, { exitance = 1 } or { radiance = 1 } is needed"))
        read_power(*power, entry.luminaire);
    entry.luminaire.dimmer = table.number("dimmer", {0, 1e6, true, "0..1e6"}).value_or(1);
    entry.luminaire.side =
        table.choice<EmitSide>("side", {{"front", EmitSide::front}, {"back", EmitSide::back}, {"both", EmitSide::both}})
            .value_or(EmitSide::front);
    table.finish();
    if (!name) return;
    entry.luminaire.name = name->name;
    entry.name_place = name->place;
    scene.luminaires.push_back(std::move(entry));
}

void Reader::read_camera(const toml::table& node) {
    TomlTable table(file, node, "[camera]");
    const auto required_point = [&](std::string_view key) {
        if (!node.contains(key)) table.require(key, "[x, y, z] is needed");
        return table.point(key);
    };
    const auto position = required_point("position");
    const auto target = required_point("target");
    const auto up = table.point("up");
    Camera camera;
    camera.vertical_fov_degrees =
        table.number("vertical_fov_degrees", {1, 170, true, "1..170"}).value_or(camera.vertical_fov_degrees);
    camera.mirrored = table.boolean("mirrored").value_or(false);
    table.finish();
    if (!position || !target) return;
    camera.position = world_from_file(*position, scene.unit, scene.up);
    camera.target = world_from_file(*target, scene.unit, scene.up);
    if (up) camera.up = world_from_file(*up, LengthUnit::metre, scene.up);
    const glm::dvec3 forward = camera.target - camera.position;
    if (glm::length(forward) == 0)
        file.error(*node.get("target"), "target is where the camera stands; another point is allowed");
    else if (glm::length(glm::cross(forward, camera.up)) <= 1e-9 * glm::length(forward) * glm::length(camera.up))
        file.error(node.contains("up") ? *node.get("up") : *node.get("target"),
                   "the camera looks along its up direction; any other up is allowed");
    scene.camera = camera;
}

void Reader::read_display(const toml::table& node) {
    TomlTable table(file, node, "[display]");
    read_toml_display(table, scene.display);
    table.finish();
}

void Reader::read_solve(const toml::table& node) {
    TomlTable table(file, node, "[solve]");
    SolveSettings& solve = scene.solve;
    const auto word = [&](const char* key, auto& field, const auto& all) {
        using Enum = std::remove_reference_t<decltype(field)>;
        std::vector<std::pair<std::string, Enum>> words;
        for (const Enum one : all) words.emplace_back(to_string(one), one);
        field = table.choice<Enum>(key, words).value_or(field);
    };
    word("solver", solve.solver, all_solvers);
    word("form_factors", solve.form_factors, all_form_factor_methods);
    solve.form_factor_samples = static_cast<int>(
        table.integer("form_factor_samples", 0, most_form_factor_samples).value_or(solve.form_factor_samples));
    word("oracle", solve.oracle, all_oracles);
    solve.link_tolerance = table.number("link_tolerance", not_negative).value_or(solve.link_tolerance);
    solve.matrix_memory =
        static_cast<int>(table.integer("matrix_memory", 1, most_matrix_memory).value_or(solve.matrix_memory));
    if (const auto wavelengths = table.text("wavelengths")) {
        if (const auto spec = parse_wavelengths(*wavelengths))
            solve.wavelengths = *spec;
        else
            file.error(*node.get("wavelengths"), spec.error());
    }
    solve.colour_error =
        table.number("colour_error", {0, 100, false, "more than 0, at most 100"}).value_or(solve.colour_error);
    solve.compare_trichromatic = table.boolean("compare_trichromatic").value_or(solve.compare_trichromatic);
    solve.target_error =
        table.number("target_error", {0, 1, false, "more than 0, at most 1"}).value_or(solve.target_error);
    const auto element_size = table.number("element_size", not_negative);
    if (element_size) solve.element_size = metres_from_length(*element_size, scene.unit);
    solve.max_rays = static_cast<int>(table.integer("max_rays", 1, 1 << 20).value_or(solve.max_rays));
    solve.seed = static_cast<std::uint32_t>(table.integer("seed", 0, 0xffffffffLL).value_or(solve.seed));
    table.finish();
}

void Reader::read(const toml::table& root) {
    TomlTable table(file, root, "the scene");
    scene.name = table.text("name").value_or("");
    if (!root.contains("units"))
        file.error(toml::source_region{{1, 1}, {1, 1}, {}},
                   "the scene has no units; allowed: metre, centimetre, millimetre, foot, inch");
    scene.unit = table.choice("units", unit_words).value_or(LengthUnit::metre);
    scene.up = table.choice("up", up_words).value_or(UpAxis::y);

    each_table(table.find("geometry"), "geometry", [&](const toml::table& node) { read_geometry(node); });
    each_table(table.find("polygon"), "polygon", [&](const toml::table& node) { read_polygon(node); });
    each_table(table.find("object"), "object", [&](const toml::table& node) { read_object(node); });
    each_table(table.find("material"), "material", [&](const toml::table& node) { read_material(node); });
    each_table(table.find("luminaire"), "luminaire", [&](const toml::table& node) { read_luminaire(node); });

    const auto one_table = [&](std::string_view key, void (Reader::*read_one)(const toml::table&)) {
        const toml::node* node = table.find(key);
        if (!node) return;
        if (const toml::table* inner = node->as_table())
            (this->*read_one)(*inner);
        else
            file.error(*node, fmt::format("{} is not a table; write [{}]", key, key));
    };
    one_table("camera", &Reader::read_camera);
    one_table("display", &Reader::read_display);
    one_table("solve", &Reader::read_solve);
    table.finish();
}

} // namespace

std::optional<SceneDescription> read_toml_scene(const std::string& text, const std::string& file,
                                                const std::filesystem::path& folder,
                                                const std::filesystem::path& library, Diagnostics& diagnostics) {
    try {
        const toml::table root = toml::parse(std::string_view(text));
        const TomlFile source{file, diagnostics};
        Reader reader{source, TomlSpectra(source, folder, library), {}};
        reader.read(root);
        return std::move(reader.scene);
    } catch (const toml::parse_error& error) {
        const toml::source_position& begin = error.source().begin;
        diagnostics.error(file, {begin.line, begin.column},
                          fmt::format("{}; a TOML file is allowed", error.description()));
        return {};
    }
}

} // namespace lueur
