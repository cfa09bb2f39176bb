// The scene as a value: copy, compare, save and undo it freely.
//
// Units: metres, world axes right-handed with Y up whatever the file said (units and up axis of the file are kept for
// saving). References are typed indices into the vectors of the same scene; there are no pointers into it. Geometry is
// immutable and shared, so a copy of a scene costs its materials and luminaires only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "core/display/display.h"
#include "core/display/image_file.h"
#include "core/scene/spectra.h"
#include "core/spectrum/wavelengths.h"

namespace lueur {

enum class MaterialIndex : std::uint32_t {};
enum class ObjectIndex : std::uint32_t {};
enum class SurfaceIndex : std::uint32_t {};
enum class LuminaireIndex : std::uint32_t {};

template <typename Index>
constexpr std::size_t at(Index index) {
    return static_cast<std::size_t>(index);
}

struct Texture {
    std::string path; // as written in the scene file; "office.glb*0" is the first picture inside that file
    std::shared_ptr<const TextureImage> image; // linear RGB reflectance
    Rgb mean{1}; // over the texels its triangles use (uv area), linear: what a texel is divided by;
                 // a pixel shows reflectance * texel / mean (set by set_texture)
    bool operator==(const Texture& other) const { return path == other.path; }
};

struct Material {
    std::string name;
    Reflectance reflectance =
        0.5; // used by the solve; with a texture: its mean over the surface, by default the mean of its texels
    std::optional<Texture> texture;
    bool two_sided = false; // false: the back is black and opaque
    bool operator==(const Material&) const = default;
};

// What `power` counts. With lumen and watt the spectrum is a shape only, scaled so that the luminaire emits that flux
// in total. With exitance [W m^-2] a spectrum is scaled to that integral; an Rgb is power * rgb, channel by channel.
// radiance [W m^-2 sr^-1] is exitance / pi (OBJ Ke, glTF emissive). Watts are those of 380..780 nm: what a spectrum has
// in the ultraviolet and the infrared is kept, and counts in no figure.
enum class PowerUnit { lumen, watt, exitance, radiance };
enum class EmitSide { front, back, both };

struct Luminaire {
    std::string name;
    std::vector<ObjectIndex> objects; // every surface of these objects emits
    EmissionSpectrum spectrum = Flat{};
    PowerUnit unit = PowerUnit::lumen;
    double power = 1000; // >= 0, at dimmer 1
    double dimmer = 1;   // 0..1 is usual; > 1 allowed
    EmitSide side = EmitSide::front;
    bool operator==(const Luminaire&) const = default;
};

// A named thing of one material, as the file names it. Picked, repainted and lit as one.
struct Object {
    std::string name; // unique in the scene
    MaterialIndex material{};
    bool operator==(const Object&) const = default;
};

// A patch that is refined as one: coplanar neighbouring triangles of an object (a wall), or neighbours that share
// smooth normals.
struct Surface {
    ObjectIndex object{};
    bool planar = true;
    bool operator==(const Surface&) const = default;
};

struct Vertex {
    glm::vec3 position{0};
    glm::vec3 normal{0}; // unit, or zero: flat
    glm::vec2 uv{0};     // v down (image rows), as texture files
    bool operator==(const Vertex&) const = default;
};

struct Geometry {
    std::vector<Vertex> vertices;
    std::vector<glm::uvec3> triangles; // counter-clockwise seen from the front
    std::vector<SurfaceIndex> triangle_surface;
    std::vector<Surface> surfaces;
    std::vector<double> surface_area; // m^2, one a surface (one side)
    bool operator==(const Geometry&) const = default;
};

enum class LengthUnit { metre, centimetre, millimetre, foot, inch };
enum class UpAxis { y, z };
double metres_per(LengthUnit unit);

// What a geometry file says by itself; a saved scene writes down only what differs from it.
struct ImportedFacts {
    bool emissive = false;                              // some of its materials emit
    std::map<std::string, std::string> object_material; // names
    std::set<std::string> textured_materials;           // names
};

// Where geometry came from, kept so that a saved scene names it again.
struct GeometryFile {
    std::string path;                              // as written
    std::optional<LengthUnit> unit;                // .obj only; none: the scene's
    std::optional<UpAxis> up;                      // .obj only; none: the scene's
    std::shared_ptr<const ImportedFacts> imported; // null before it is loaded
    bool operator==(const GeometryFile& other) const {
        return path == other.path && unit == other.unit && up == other.up;
    }
};
struct InlinePolygon { // vertices in the file's own units and axes, as written
    std::string name;
    std::string material;
    std::vector<glm::dvec3> vertices; // at least 3, counter-clockwise from the front; convex or concave
    std::vector<glm::dvec2> uv;       // none, or one a vertex
    bool operator==(const InlinePolygon&) const = default;
};
using GeometrySource = std::variant<GeometryFile, InlinePolygon>;

struct Camera {
    glm::dvec3 position{0, 1.6, 4};
    glm::dvec3 target{0, 1.2, 0};
    glm::dvec3 up{0, 1, 0};
    double vertical_fov_degrees = 50; // 1..170
    bool mirrored = false;            // +x drawn to the left: the measured Cornell box
    bool operator==(const Camera&) const = default;
};

// Words of these: core/scene/solver_words.h.
enum class SolverKind {
    automatic, // core/solve/choose_solver.h
    gathering, // direct light apart, kept rays, truncated conjugate residuals
    shooting,  // progressive refinement, form factors made anew for each shot
    overshooting,
    jacobi,       // these three on the full matrix of form factors
    gauss_seidel, //
    hierarchical, // links between elements of a quadtree
    reference,    // traced paths, without radiosity
};
// How form factors between patches are found, by the solvers that keep a matrix or links
// (core/transport/form_factor.h).
enum class FormFactorMethod { automatic, analytic, point_to_disk, area_sampled, monte_carlo, hemicube, hemisphere };
// What a link of the hierarchical solver is refined by.
enum class RefinementOracle {
    form_factor, // the lecture's Oracle1: F alone
    flux,        // the lecture's Oracle2: F times the radiosity it carries
    error,       // the estimated error of the flux it carries, visibility included
};

struct SolveSettings {
    SolverKind solver = SolverKind::automatic;
    FormFactorMethod form_factors = FormFactorMethod::automatic;
    int form_factor_samples = 0; // sub-elements, rays, or edge of the hemicube; 0: the method's default
    RefinementOracle oracle = RefinementOracle::error;
    double link_tolerance = 0; // of the oracle; 0: from target_error
    int matrix_memory = 1024;  // MiB that a full matrix of form factors may take
    WavelengthsSpec wavelengths{WavelengthRule::automatic, 0};
    double colour_error = 0.5;         // CIEDE2000: the worst colour difference that auto wavelengths may be predicted
    bool compare_trichromatic = false; // the lecture's RGB approach is solved beside, on the same rays
    double target_error = 0.02;        // relative RMS error of irradiance at which the worker sleeps
    double element_size = 0;           // largest coarse element edge in metres; 0: chosen from the scene's area
    int max_rays = 512;                // gather rays a receiver, at most
    std::uint32_t seed = 1;
    bool operator==(const SolveSettings&) const = default;
};
inline constexpr int most_form_factor_samples = 1 << 20;
inline constexpr int most_matrix_memory = 1 << 20; // MiB

struct Scene {
    std::string name;
    std::filesystem::path folder; // relative paths of the file are seen from here
    LengthUnit unit = LengthUnit::metre;
    UpAxis up = UpAxis::y;
    std::vector<GeometrySource> sources;
    std::shared_ptr<const Geometry> geometry = std::make_shared<Geometry>();
    std::vector<Object> objects;
    std::vector<Material> materials;
    std::vector<Luminaire> luminaires;
    Camera camera;
    DisplaySettings display;
    SolveSettings solve;
    bool operator==(const Scene&) const = default; // geometry by identity: two loads of one file differ
};

} // namespace lueur
