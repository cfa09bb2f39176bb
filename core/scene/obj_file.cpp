// Wavefront OBJ: vertices, faces, objects and groups, materials. Free-form curves are not read; lines and points are
// left out and told.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/scene/files.h"
#include "core/scene/import.h"
#include "core/scene/mtl_file.h"
#include "core/scene/text_lines.h"
#include "core/scene/triangulate.h"
#include "core/scene/units.h"

namespace lueur {

namespace {

constexpr std::size_t most_errors = 50; // a file of a million wrong lines is one mistake

struct ObjReader {
    const ImportRequest& request;
    std::string file;
    Diagnostics mine;
    std::size_t errors_left_out = 0;

    enum class Kind { position, texture, normal };
    struct LateIndex { // names an element that may still come
        std::int64_t index;
        Kind kind;
        Word word;
    };
    struct Corner {
        std::int64_t index[3]; // from 0; -1: none
    };
    struct Face {
        std::uint32_t first, count; // into `corners`
        std::uint32_t group, material;
        Place place;
    };

    std::vector<glm::dvec3> positions; // as written
    std::vector<glm::dvec2> coordinates;
    std::vector<glm::dvec3> normals;
    std::vector<Corner> corners;
    std::vector<Face> faces;
    std::vector<LateIndex> late;
    std::vector<std::string> groups, material_names;
    std::map<std::string, std::uint32_t> group_index, material_index;
    std::vector<Place> material_place;
    std::uint32_t group = 0, material = 0;
    std::vector<MtlMaterial> library;
    std::size_t lines_and_points = 0, curves = 0, crossing_faces = 0;
    std::vector<std::filesystem::path> libraries_read;
    std::map<std::string, std::filesystem::path> folder_of; // of each library material

    explicit ObjReader(const ImportRequest& requested)
        : request(requested)
        , file(requested.file.string()) {}

    void error(const Word& at, std::string_view what) {
        if (mine.errors.size() < most_errors)
            mine.error(file, {at.line, at.column}, what);
        else
            ++errors_left_out;
    }

    void read(std::string_view text);
    std::optional<ImportedModel> model();

private:
    template <int count>
    std::optional<glm::vec<count, double>> numbers(const std::vector<Word>& words, int needed);
    void face(const std::vector<Word>& words);
    void corner(const Word& word);
    void material_library(const std::vector<Word>& words);
    bool open_library(const std::string& name);
    std::vector<Material> materials(std::vector<Rgb>& emission);
};

template <int count>
std::optional<glm::vec<count, double>> ObjReader::numbers(const std::vector<Word>& words, int needed) {
    glm::vec<count, double> values(0.0);
    if (static_cast<int>(words.size()) - 1 < needed) {
        error(words[0], fmt::format("{} has {} numbers; {} are needed", words[0].text, words.size() - 1, needed));
        return {};
    }
    bool good = true;
    for (int i = 0; i < count && i + 1 < static_cast<int>(words.size()); ++i) {
        const Word& word = words[static_cast<std::size_t>(i) + 1];
        const auto number = number_from(word.text);
        if (!number)
            error(word, fmt::format("\"{}\" is not a number; a finite number is allowed", word.text));
        else if (!std::isfinite(*number) || std::abs(*number) > 1e30)
            error(word, fmt::format("{} is not a finite number; a finite number is allowed", word.text));
        else {
            values[i] = *number;
            continue;
        }
        good = false;
    }
    // A faulty line still counts, or every later face would name the wrong vertex and be told too.
    return good ? values : glm::vec<count, double>(0.0);
}

void ObjReader::corner(const Word& word) {
    Corner result{{-1, -1, -1}};
    const std::size_t sizes[3] = {positions.size(), coordinates.size(), normals.size()};
    std::string_view rest = word.text;
    for (int part = 0; part < 3; ++part) {
        const std::size_t slash = rest.find('/');
        const std::string_view number = rest.substr(0, slash);
        if (!number.empty() || part == 0) {
            const auto index = integer_from(number);
            if (!index) {
                error(word,
                      fmt::format("\"{}\" is not a corner of a face; v, v/vt, v//vn or v/vt/vn is allowed", word.text));
                break;
            }
            if (*index > 0) {
                result.index[part] = *index - 1;
                if (*index > static_cast<std::int64_t>(sizes[part]))
                    late.push_back({*index, static_cast<Kind>(part), word});
            } else if (*index < 0 && -*index <= static_cast<std::int64_t>(sizes[part]))
                result.index[part] = static_cast<std::int64_t>(sizes[part]) + *index;
            else
                late.push_back({*index, static_cast<Kind>(part), word});
        }
        if (slash == rest.npos) break;
        rest = rest.substr(slash + 1);
        if (part == 2)
            error(word, fmt::format("\"{}\" has too many slashes; v, v/vt, v//vn or v/vt/vn is allowed", word.text));
    }
    corners.push_back(result);
}

void ObjReader::face(const std::vector<Word>& words) {
    if (words.size() < 4) {
        error(words[0], fmt::format("a face of {} corners; at least 3 are needed", words.size() - 1));
        return;
    }
    if (group_index.empty()) {
        groups.push_back(request.file.stem().string());
        group_index[groups.back()] = 0;
    }
    if (material_names.empty()) {
        material_names.emplace_back(""); // none
        material_index[""] = 0;
        material_place.push_back({});
    }
    faces.push_back({static_cast<std::uint32_t>(corners.size()),
                     static_cast<std::uint32_t>(words.size() - 1),
                     group,
                     material,
                     {words[0].line, words[0].column}});
    for (std::size_t i = 1; i < words.size(); ++i) corner(words[i]);
}

bool ObjReader::open_library(const std::string& name) {
    std::string path = name;
    for (char& letter : path)
        if (letter == '\\') letter = '/';
    const std::filesystem::path full = request.file.parent_path() / path;
    if (why_unreadable(full)) return false;
    if (std::find(libraries_read.begin(), libraries_read.end(), full) != libraries_read.end()) return true;
    libraries_read.push_back(full);
    if (auto read = read_mtl(full, mine))
        for (MtlMaterial& entry : *read)
            if (folder_of.try_emplace(entry.name, std::filesystem::path(path).parent_path()).second)
                library.push_back(std::move(entry));
    return true;
}

void ObjReader::material_library(const std::vector<Word>& words) {
    if (words.size() < 2) {
        error(words[0], "mtllib names no file; a path is needed");
        return;
    }
    if (open_library(rest_of_line(words, 1))) return; // names with spaces
    for (std::size_t i = 1; i < words.size(); ++i)
        if (!open_library(std::string(words[i].text)))
            mine.warning(file, {words[i].line, words[i].column},
                         fmt::format("material file \"{}\" is not there; its materials become grey 0.5",
                                     words.size() == 2 ? rest_of_line(words, 1) : std::string(words[i].text)));
}

void ObjReader::read(std::string_view text) {
    TextLines lines(text);
    std::vector<Word> words;
    while (lines.next(words)) {
        const std::string_view key = words[0].text;
        if (key == "v") {
            if (const auto p = numbers<3>(words, 3))
                positions.push_back(*p);
            else
                positions.emplace_back(0);
        } else if (key == "vt") {
            if (const auto p = numbers<2>(words, 1))
                coordinates.push_back(*p);
            else
                coordinates.emplace_back(0);
        } else if (key == "vn") {
            if (const auto p = numbers<3>(words, 3))
                normals.push_back(*p);
            else
                normals.emplace_back(0);
        } else if (key == "f" || key == "fo") {
            face(words);
        } else if (key == "o" || key == "g") {
            std::string name = utf8_name(rest_of_line(words, 1));
            if (name.empty()) name = request.file.stem().string();
            const auto [found, fresh] = group_index.try_emplace(name, static_cast<std::uint32_t>(groups.size()));
            if (fresh) groups.push_back(name);
            group = found->second;
        } else if (key == "usemtl") {
            const std::string name = utf8_name(rest_of_line(words, 1));
            const auto [found, fresh] =
                material_index.try_emplace(name, static_cast<std::uint32_t>(material_names.size()));
            if (fresh) {
                material_names.push_back(name);
                material_place.push_back({words[0].line, words[0].column});
            }
            material = found->second;
        } else if (key == "mtllib") {
            material_library(words);
        } else if (key == "l" || key == "p") {
            ++lines_and_points;
        } else if (key == "curv" || key == "curv2" || key == "surf") {
            ++curves;
        }
    }
    const std::size_t sizes[3] = {positions.size(), coordinates.size(), normals.size()};
    const char* const names[3] = {"vertex", "texture coordinate", "normal"};
    for (const LateIndex& index : late) {
        const auto kind = static_cast<std::size_t>(index.kind);
        if (index.index > 0 && index.index <= static_cast<std::int64_t>(sizes[kind])) continue;
        const std::string allowed = sizes[kind] == 0
                                        ? "the file has none"
                                        : fmt::format("1..{} or -{}..-1 is allowed", sizes[kind], sizes[kind]);
        error(index.word, fmt::format("the face names {} {}; {}", names[kind], index.index, allowed));
    }
}

std::vector<Material> ObjReader::materials(std::vector<Rgb>& emission) {
    const std::filesystem::path written_folder = std::filesystem::path(request.written).parent_path();
    std::vector<Material> result;
    UniqueNames unique;
    for (std::size_t i = 0; i < material_names.size(); ++i) {
        Material made;
        made.name = unique.take(material_names[i].empty() ? "default" : material_names[i]);
        made.two_sided = true; // OBJ has no sides
        emission.emplace_back(0);
        const auto entry = std::find_if(library.begin(), library.end(),
                                        [&](const MtlMaterial& m) { return m.name == material_names[i]; });
        if (entry == library.end()) {
            if (!libraries_read.empty() && !material_names[i].empty())
                mine.warning(file, material_place[i],
                             fmt::format("material \"{}\" is in none of the material files; it becomes grey 0.5",
                                         material_names[i]));
        } else {
            if (!entry->kd && entry->map_kd.empty())
                mine.warning(file, material_place[i],
                             fmt::format("material \"{}\" has no Kd; its reflectance becomes 0.5", made.name));
            const Rgb kd = entry->kd.value_or(entry->map_kd.empty() ? Rgb(0.5) : Rgb(1));
            made.reflectance = kd;
            emission.back() = entry->ke;
            if (!entry->map_kd.empty()) {
                const std::filesystem::path path = folder_of[entry->name] / entry->map_kd;
                auto image = read_texture(request.file.parent_path() / path);
                if (image)
                    made.texture = Texture{(written_folder / path).lexically_normal().generic_string(),
                                           std::make_shared<const TextureImage>(std::move(*image)), Rgb(1)};
                else {
                    if (!entry->kd) made.reflectance = 0.5;
                    mine.warning(file, material_place[i],
                                 fmt::format("texture of material \"{}\" left out, its mean colour stays {}: {}",
                                             made.name, entry->kd ? "Kd" : "grey 0.5", image.error()));
                }
            }
        }
        result.push_back(std::move(made));
    }
    return result;
}

std::optional<ImportedModel> ObjReader::model() {
    ImportedModel result;
    std::vector<Rgb> emission;
    result.materials = materials(emission);

    std::map<std::uint32_t, std::map<std::uint32_t, ObjectIndex>> object_of; // group -> material -> object
    for (const Face& one : faces) object_of[one.group][one.material] = {};
    UniqueNames unique;
    for (auto& [group_number, by_material] : object_of)
        for (auto& [material_number, object] : by_material) {
            const std::string& material_name = result.materials[material_number].name;
            object = ObjectIndex{static_cast<std::uint32_t>(result.objects.size())};
            const std::string name =
                by_material.size() == 1 ? groups[group_number] : groups[group_number] + "." + material_name;
            result.objects.push_back({unique.take(name), MaterialIndex{material_number}});
            const Rgb& radiance = emission[material_number];
            if (std::max({radiance.r, radiance.g, radiance.b}) > 0)
                result.emission.push_back({object, radiance, EmitSide::front});
        }

    const UpAxis up = request.up;
    std::vector<glm::dvec3> polygon;
    for (const Face& one : faces) {
        polygon.clear();
        for (std::uint32_t i = 0; i < one.count; ++i)
            polygon.push_back(positions[static_cast<std::size_t>(corners[one.first + i].index[0])]);
        std::vector<glm::uvec3> triangles;
        if (one.count == 3)
            triangles = triangle_fan(3);
        else if (auto cut = triangulate(polygon))
            triangles = std::move(*cut);
        else {
            triangles = triangle_fan(one.count); // make_geometry tells what has no area
            if (cut.error().find("crosses") != std::string::npos) ++crossing_faces;
        }
        const auto base = static_cast<std::uint32_t>(result.soup.vertices.size());
        for (std::uint32_t i = 0; i < one.count; ++i) {
            const Corner& c = corners[one.first + i];
            Vertex vertex;
            vertex.position = glm::vec3(world_from_file(polygon[i], request.unit, up));
            if (c.index[1] >= 0) {
                const glm::dvec2& uv = coordinates[static_cast<std::size_t>(c.index[1])];
                vertex.uv = glm::vec2(uv.x, 1 - uv.y); // OBJ counts v upwards
            }
            if (c.index[2] >= 0) {
                const glm::dvec3 normal =
                    world_from_file(normals[static_cast<std::size_t>(c.index[2])], LengthUnit::metre, up);
                const double length = glm::length(normal);
                if (length > 0) vertex.normal = glm::vec3(normal / length);
            }
            result.soup.vertices.push_back(vertex);
        }
        for (const glm::uvec3& t : triangles) {
            result.soup.triangles.push_back(t + base);
            result.soup.triangle_object.push_back(object_of[one.group][one.material]);
        }
    }
    if (crossing_faces)
        mine.warning(file, {},
                     fmt::format("{} face{} whose border crosses itself, cut into fans", crossing_faces,
                                 crossing_faces == 1 ? "" : "s"));
    return result;
}

} // namespace

std::optional<ImportedModel> read_obj(const ImportRequest& request, Diagnostics& diagnostics) {
    const auto text = read_bytes(request.file);
    if (!text) {
        diagnostics.error(request.file.string(), {}, text.error());
        return {};
    }
    ObjReader reader(request);
    reader.read(*text);
    std::optional<ImportedModel> model;
    if (reader.mine.errors.empty()) {
        if (reader.lines_and_points)
            reader.mine.warning(
                reader.file, {},
                fmt::format("{} lines and points left out: they have no area", reader.lines_and_points));
        if (reader.curves)
            reader.mine.warning(reader.file, {},
                                fmt::format("{} free-form curves and surfaces left out", reader.curves));
        if (reader.faces.empty()) {
            const char* what = text->empty()              ? "is empty"
                               : reader.positions.empty() ? "has no vertices and no faces"
                                                          : "is a point cloud: vertices, but no faces";
            reader.mine.error(reader.file, {}, fmt::format("{}; at least one face (f) is needed", what));
        } else
            model = reader.model();
    }
    if (reader.errors_left_out)
        reader.mine.error(reader.file, {}, fmt::format("and {} more errors", reader.errors_left_out));
    for (std::string& line : reader.mine.errors) diagnostics.errors.push_back(std::move(line));
    for (std::string& line : reader.mine.warnings) diagnostics.warnings.push_back(std::move(line));
    if (!reader.mine.errors.empty()) return {};
    return model;
}

} // namespace lueur
