#include "core/scene/build_scene.h"

#include <algorithm>

#include "core/scene/files.h"
#include "core/scene/frame.h"
#include "core/scene/import.h"
#include "core/scene/scene_file.h"
#include "core/scene/surfaces.h"
#include "core/scene/texture.h"
#include "core/scene/toml_values.h"
#include "core/scene/triangulate.h"
#include "core/scene/units.h"

namespace lueur {

namespace {

struct SceneBuilder {
    const SceneDescription& said;
    const std::string& file;
    const std::filesystem::path& folder;
    Diagnostics& diagnostics;

    Scene scene{};
    TriangleSoup soup{};
    bool names_complete = said.names_complete;
    std::map<std::string, MaterialIndex> material_named{};
    std::map<std::string, ObjectIndex> object_named{};
    std::size_t imported_objects = 0;                            // the first of scene.objects
    std::vector<bool> reflectance_said{}, reflectance_is_tint{}; // of each material
    std::vector<ImportedEmission> emission{};
    std::map<std::string, std::shared_ptr<const TextureImage>> pictures{}; // "office.glb*0"
    std::optional<Camera> imported_camera{};
    UniqueNames object_names{}, imported_material_names{};

    void error(Place place, std::string_view what) { diagnostics.error(file, place, what); }

    void start_materials();
    void import(const GeometryEntry& entry);
    MaterialIndex add_material(Material imported);
    void finish_materials();
    void polygons();
    void object_materials();
    void load_textures();
    void mean_reflectances();
    void luminaires();
    void last_warnings();

    std::optional<MaterialIndex> material_of(const std::string& name, Place place);
};

template <typename Named>
std::vector<std::string> names_of(const Named& named) {
    std::vector<std::string> names;
    for (const auto& [name, index] : named) names.push_back(name);
    return names;
}

// Long lists of names help nobody.
std::string known_names(const std::string& wrong, std::vector<std::string> names) {
    if (names.empty()) return "there is none";
    if (names.size() <= 12) return allowed_words(wrong, names);
    const std::string words = allowed_words(wrong, names);
    const std::size_t hint = words.find("? allowed");
    return hint == std::string::npos ? fmt::format("one of the {} that there are is allowed", names.size())
                                     : words.substr(0, hint + 1);
}

std::optional<MaterialIndex> SceneBuilder::material_of(const std::string& name, Place place) {
    if (const auto found = material_named.find(name); found != material_named.end()) return found->second;
    if (names_complete)
        error(place,
              fmt::format("material \"{}\" is not there; {}", name, known_names(name, names_of(material_named))));
    return {};
}

void SceneBuilder::start_materials() {
    for (const MaterialEntry& entry : said.materials) {
        const MaterialIndex index{static_cast<std::uint32_t>(scene.materials.size())};
        if (!material_named.try_emplace(entry.name.name, index).second) {
            error(entry.name.place,
                  fmt::format("material \"{}\" is there twice; one of each name is allowed", entry.name.name));
            continue;
        }
        Material material;
        material.name = entry.name.name;
        scene.materials.push_back(std::move(material));
        reflectance_said.push_back(false);
        reflectance_is_tint.push_back(false);
    }
}

MaterialIndex SceneBuilder::add_material(Material imported) {
    const bool textured = imported.texture.has_value();
    const auto [found, fresh] =
        material_named.try_emplace(imported.name, MaterialIndex{static_cast<std::uint32_t>(scene.materials.size())});
    if (fresh) {
        scene.materials.push_back(std::move(imported));
        reflectance_said.push_back(true);
        reflectance_is_tint.push_back(textured);
    } else { // the scene file changes some of it: finish_materials
        scene.materials[at(found->second)] = std::move(imported);
        reflectance_said[at(found->second)] = true;
        reflectance_is_tint[at(found->second)] = textured;
    }
    return found->second;
}

void SceneBuilder::import(const GeometryEntry& entry) {
    const std::filesystem::path path = folder / entry.file.path;
    GeometryFile source = entry.file;
    if (const auto why = why_unreadable(path)) {
        error(entry.place, fmt::format("geometry file \"{}\" {}", entry.file.path, *why));
        names_complete = false;
        scene.sources.emplace_back(std::move(source));
        return;
    }
    std::optional<ImportedModel> model = import_model(
        {path, entry.file.path, entry.file.unit.value_or(said.unit), entry.file.up.value_or(said.up)}, diagnostics);
    if (!model) {
        names_complete = false;
        return;
    }
    auto facts = std::make_shared<ImportedFacts>();
    std::vector<MaterialIndex> material;
    for (Material& imported : model->materials) {
        imported.name = imported_material_names.take(imported.name);
        if (imported.texture) facts->textured_materials.insert(imported.name);
        material.push_back(add_material(std::move(imported)));
    }
    const auto first = static_cast<std::uint32_t>(scene.objects.size());
    for (const Object& imported : model->objects) {
        const ObjectIndex index{static_cast<std::uint32_t>(scene.objects.size())};
        scene.objects.push_back({object_names.take(imported.name), material[at(imported.material)]});
        object_named[scene.objects.back().name] = index;
        facts->object_material[scene.objects.back().name] = scene.materials[at(scene.objects.back().material)].name;
    }
    facts->emissive = !model->emission.empty();
    if (entry.imported_emission)
        for (const ImportedEmission& glow : model->emission)
            emission.push_back(
                {ObjectIndex{static_cast<std::uint32_t>(at(glow.object)) + first}, glow.radiance, glow.side});
    for (const auto& [picture, image] : model->pictures) pictures[entry.file.path + picture] = image;
    if (!imported_camera) imported_camera = model->camera;

    const auto base = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), model->soup.vertices.begin(), model->soup.vertices.end());
    for (std::size_t i = 0; i < model->soup.triangles.size(); ++i) {
        soup.triangles.push_back(model->soup.triangles[i] + base);
        soup.triangle_object.push_back(
            ObjectIndex{static_cast<std::uint32_t>(at(model->soup.triangle_object[i])) + first});
    }
    source.imported = std::move(facts);
    scene.sources.emplace_back(std::move(source));
}

void SceneBuilder::finish_materials() {
    for (const MaterialEntry& entry : said.materials) {
        const std::size_t index = at(material_named.at(entry.name.name));
        Material& material = scene.materials[index];
        if (entry.reflectance) {
            material.reflectance = *entry.reflectance;
            reflectance_is_tint[index] = false;
        } else if (!reflectance_said[index] && !entry.texture && names_complete)
            error(entry.name.place, fmt::format("material \"{}\" has no reflectance; reflectance = 0..1, [r, g, b], {{ "
                                                "file = \"...\" }}, or a texture is needed",
                                                entry.name.name));
        reflectance_said[index] = reflectance_said[index] || entry.reflectance;
        if (entry.two_sided) material.two_sided = *entry.two_sided;
    }
}

void SceneBuilder::polygons() {
    imported_objects = scene.objects.size();
    for (const PolygonEntry& entry : said.polygons) {
        const InlinePolygon& polygon = entry.polygon;
        const std::optional<MaterialIndex> material = material_of(polygon.material, entry.material_place);
        const auto [found, fresh] =
            object_named.try_emplace(polygon.name, ObjectIndex{static_cast<std::uint32_t>(scene.objects.size())});
        const ObjectIndex object = found->second;
        if (fresh)
            scene.objects.push_back({polygon.name, material.value_or(MaterialIndex{})});
        else if (at(object) < imported_objects)
            error(entry.name_place,
                  fmt::format("an object of a geometry file is named \"{}\"; another name is allowed", polygon.name));
        else if (material && scene.objects[at(object)].material != *material)
            error(entry.material_place,
                  fmt::format("object \"{}\" has material \"{}\" already; polygons of one name have one material",
                              polygon.name, scene.materials[at(scene.objects[at(object)].material)].name));
        scene.sources.emplace_back(polygon);
        if (polygon.vertices.empty()) continue; // told
        std::vector<glm::dvec3> corners;
        for (const glm::dvec3& vertex : polygon.vertices)
            corners.push_back(world_from_file(vertex, said.unit, said.up));
        const auto triangles = triangulate(corners);
        if (!triangles) {
            error(entry.vertices_place,
                  fmt::format("polygon \"{}\" {}; a simple polygon is allowed", polygon.name, triangles.error()));
            continue;
        }
        const auto base = static_cast<std::uint32_t>(soup.vertices.size());
        for (std::size_t i = 0; i < corners.size(); ++i) {
            Vertex vertex;
            vertex.position = glm::vec3(corners[i]);
            if (!polygon.uv.empty()) vertex.uv = glm::vec2(polygon.uv[i]);
            soup.vertices.push_back(vertex);
        }
        for (const glm::uvec3& triangle : *triangles) {
            soup.triangles.push_back(triangle + base);
            soup.triangle_object.push_back(object);
        }
    }
}

void SceneBuilder::object_materials() {
    std::set<std::string> seen;
    for (const ObjectEntry& entry : said.objects) {
        const auto material = material_of(entry.material.name, entry.material.place);
        const auto found = object_named.find(entry.object.name);
        if (!seen.insert(entry.object.name).second)
            error(
                entry.object.place,
                fmt::format("object \"{}\" is there twice; one [[object]] of each name is allowed", entry.object.name));
        else if (found == object_named.end()) {
            if (names_complete)
                error(entry.object.place, fmt::format("object \"{}\" is in no geometry file; {}", entry.object.name,
                                                      known_names(entry.object.name, names_of(object_named))));
        } else if (at(found->second) >= imported_objects)
            error(entry.object.place,
                  fmt::format(
                      "object \"{}\" is a [[polygon]], which names its own material; [[object]] is for geometry files",
                      entry.object.name));
        else if (material)
            scene.objects[at(found->second)].material = *material;
    }
}

void SceneBuilder::load_textures() {
    for (const MaterialEntry& entry : said.materials) {
        if (!entry.texture) continue;
        const std::size_t index = at(material_named.at(entry.name.name));
        Material& material = scene.materials[index];
        const std::string& path = entry.texture->path;
        if (path == "none") {
            if (reflectance_is_tint[index]) material.reflectance = 0.5;
            if (!reflectance_said[index])
                error(entry.texture->place, "texture \"none\" leaves no reflectance; reflectance is needed");
            material.texture.reset();
            reflectance_is_tint[index] = false;
            continue;
        }
        std::shared_ptr<const TextureImage> image;
        if (embedded_picture(path)) {
            const auto found = pictures.find(path);
            if (found == pictures.end()) {
                if (names_complete)
                    error(entry.texture->place, fmt::format("texture \"{}\" is inside no geometry file; {}", path,
                                                            known_names(path, names_of(pictures))));
                continue;
            }
            image = found->second;
        } else if (const auto why = why_unreadable(folder / path)) {
            error(entry.texture->place, fmt::format("texture \"{}\" {}", path, *why));
            continue;
        } else if (auto read = read_texture(folder / path))
            image = std::make_shared<const TextureImage>(std::move(*read));
        else {
            error(entry.texture->place, fmt::format("texture \"{}\" cannot be read: {}", path, read.error()));
            continue;
        }
        material.texture = Texture{path, std::move(image), Rgb(1)};
        if (!entry.reflectance) { // its mean is the reflectance
            material.reflectance = Rgb(1);
            reflectance_is_tint[index] = true;
        }
    }
}

void SceneBuilder::mean_reflectances() {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material& material = scene.materials[i];
        if (!material.texture) continue;
        const auto triangles = triangles_of_material(scene, MaterialIndex{static_cast<std::uint32_t>(i)});
        material.texture->mean = mean_texel(*material.texture->image, scene.geometry->vertices, triangles);
        if (reflectance_is_tint[i]) {
            const Rgb* tint = std::get_if<Rgb>(&material.reflectance);
            material.reflectance = (tint ? *tint : Rgb(1)) * material.texture->mean;
        }
        if (has_no_uv(scene.geometry->vertices, triangles))
            diagnostics.warning(
                file, {},
                fmt::format("material \"{}\" has a texture, but what it covers has no texture coordinates",
                            material.name));
    }
}

void SceneBuilder::luminaires() {
    std::map<std::string, Place> names;
    std::map<std::uint32_t, std::string> lit_by;
    UniqueNames unique;
    for (const LuminaireEntry& entry : said.luminaires) {
        Luminaire luminaire = entry.luminaire;
        if (!names.try_emplace(luminaire.name, entry.name_place).second)
            error(entry.name_place,
                  fmt::format("luminaire \"{}\" is there twice; one of each name is allowed", luminaire.name));
        for (const PlacedName& object : entry.objects) {
            const auto found = object_named.find(object.name);
            if (found == object_named.end()) {
                if (names_complete)
                    error(object.place, fmt::format("object \"{}\" is not there; {}", object.name,
                                                    known_names(object.name, names_of(object_named))));
                continue;
            }
            const auto [other, fresh] =
                lit_by.try_emplace(static_cast<std::uint32_t>(at(found->second)), luminaire.name);
            if (!fresh)
                error(
                    object.place,
                    fmt::format("object \"{}\" is lit by luminaire \"{}\" already; one luminaire an object is allowed",
                                object.name, other->second));
            luminaire.objects.push_back(found->second);
        }
        unique.take(luminaire.name);
        scene.luminaires.push_back(std::move(luminaire));
    }
    for (const ImportedEmission& glow : emission) {
        if (lit_by.contains(static_cast<std::uint32_t>(at(glow.object)))) continue;
        Luminaire luminaire;
        luminaire.name = unique.take(scene.objects[at(glow.object)].name);
        luminaire.objects = {glow.object};
        luminaire.spectrum = glow.radiance;
        luminaire.unit = PowerUnit::radiance;
        luminaire.power = 1;
        luminaire.side = glow.side;
        scene.luminaires.push_back(std::move(luminaire));
    }
}

void SceneBuilder::last_warnings() {
    const bool dark = std::all_of(scene.luminaires.begin(), scene.luminaires.end(), [](const Luminaire& luminaire) {
        return luminaire.power == 0 || luminaire.dimmer == 0;
    });
    if (dark) diagnostics.warning(file, {}, "nothing emits; the picture will be black");
    const bool white =
        !scene.objects.empty() && std::all_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
            const Reflectance& reflectance = scene.materials[at(object.material)].reflectance;
            const double* grey = std::get_if<double>(&reflectance);
            const Rgb* rgb = std::get_if<Rgb>(&reflectance);
            return (grey && *grey == 1) || (rgb && *rgb == Rgb(1));
        });
    if (white)
        diagnostics.warning(
            file, {},
            "every surface reflects all light (reflectance 1); in a closed scene the light grows without end");
    for (const std::string& fault : check(scene)) diagnostics.warning(file, {}, fault);
}

} // namespace

std::optional<Scene> build_scene(const SceneDescription& description, const std::string& file,
                                 const std::filesystem::path& folder, Diagnostics& diagnostics) {
    SceneBuilder builder{description, file, folder, diagnostics};
    Scene& scene = builder.scene;
    scene.name = description.name;
    std::error_code ignored;
    scene.folder = std::filesystem::absolute(folder, ignored).lexically_normal();
    scene.unit = description.unit;
    scene.up = description.up;
    scene.display = description.display;
    scene.solve = description.solve;

    builder.start_materials();
    for (const GeometryEntry& entry : description.geometry) builder.import(entry);
    builder.finish_materials();
    builder.polygons();
    builder.object_materials();
    builder.load_textures();
    builder.luminaires();
    if (description.geometry.empty() && description.polygons.empty() && description.names_complete)
        diagnostics.error(file, {},
                          "there is nothing in the scene; at least one [[geometry]] or [[polygon]] is needed");
    if (!diagnostics.errors.empty()) return {};

    std::vector<std::string> left_out;
    scene.geometry = std::make_shared<const Geometry>(make_geometry(builder.soup, scene.objects, left_out));
    for (const std::string& line : left_out) diagnostics.warning(file, {}, line);
    if (scene.geometry->triangles.empty()) {
        diagnostics.error(file, {}, "no triangle with an area is left; at least one is needed");
        return {};
    }
    builder.mean_reflectances();
    scene.camera = description.camera        ? *description.camera
                   : builder.imported_camera ? *builder.imported_camera
                                             : frame_scene(*scene.geometry);
    builder.last_warnings();
    return std::move(scene);
}

} // namespace lueur
