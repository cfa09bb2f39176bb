// What a .toml scene file says, value by value checked, before names are resolved and geometry is read.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/diagnostics.h"
#include "core/scene/scene.h"

namespace lueur {

struct PlacedName {
    std::string name;
    Place place;
};

struct GeometryEntry {
    GeometryFile file;
    bool imported_emission = true;
    Place place; // of the file name
};

struct PolygonEntry {
    InlinePolygon polygon; // vertices empty: they were wrong, and told
    Place name_place, material_place, vertices_place;
};

struct ObjectEntry {
    PlacedName object, material;
};

struct TextureEntry {
    std::string path; // "none": take an imported texture away
    Place place;
};

struct MaterialEntry {
    PlacedName name;
    std::optional<Reflectance> reflectance;
    std::optional<TextureEntry> texture;
    std::optional<bool> two_sided;
};

struct LuminaireEntry {
    Luminaire luminaire; // its objects are named below
    Place name_place;
    std::vector<PlacedName> objects;
};

struct SceneDescription {
    std::string name;
    LengthUnit unit = LengthUnit::metre;
    UpAxis up = UpAxis::y;
    std::vector<GeometryEntry> geometry;
    std::vector<PolygonEntry> polygons;
    std::vector<ObjectEntry> objects;
    std::vector<MaterialEntry> materials;
    std::vector<LuminaireEntry> luminaires;
    std::optional<Camera> camera; // in metres, Y up
    DisplaySettings display;
    SolveSettings solve;
    bool names_complete = true; // false: some polygon or material could not be read, so an unknown name may be its
};

// Errors go to `diagnostics` under the name `file`; nothing at all only where the text is not TOML. Spectrum files are
// read from `folder`, and what is of the program's own library from `library`.
std::optional<SceneDescription> read_toml_scene(const std::string& text, const std::string& file,
                                                const std::filesystem::path& folder,
                                                const std::filesystem::path& library, Diagnostics& diagnostics);

} // namespace lueur
