// A picture of a field from a camera, by ray casting: the radiance that leaves the seen surface towards the eye.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>

#include "core/display/display.h"
#include "core/scene/scene.h"
#include "core/solve/field.h"
#include "core/transport/mesh.h"
#include "core/transport/world.h"

namespace lueur {

// All that is needed to look at a solution; immutable, any thread.
struct FieldView {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const World> world;
    std::shared_ptr<const Field> field;
    bool trichromatic = false; // radiance by the trichromatic approach, where the field has it
};

struct FieldPoint { // the field where a ray meets the scene
    glm::vec3 position, normal;
    glm::vec2 uv;
    std::uint32_t surface;
    bool back_face;
    Xyz irradiance, radiance;       // lx and cd m^-2 in Y; radiance with texture and emission
    Xyz emitted;                    // the part of the radiance that the surface emits itself
    std::optional<glm::vec3> texel; // linear RGB, of a textured surface
    float unshot;
    float error;               // lx, one standard deviation of the illuminance
    float relative_error;      // in per cent of it
    float colour_difference;   // CIEDE2000 of the two approaches, of the mean texel; 0 where they are not compared
    std::uint32_t vertices[3]; // of the mesh, and what each counts: irradiance in channels is read there
    float weights[3];
};

// Irradiance at the point per channel of field.wavelengths; empty where the field has none.
std::vector<double> irradiance_channels(const Field& field, const FieldPoint& point);

std::optional<FieldPoint> field_along_ray(const FieldView& view, const Ray& ray);

// The first thing a ray from the eye meets, looking through surfaces from behind, as the window does; a back face or
// nothing where there is none.
Hit seen_hit(const World& world, Ray ray);

// Linear RGB, bilinear and repeating, as the window's sampler.
glm::vec3 sample_texture(const TextureImage& image, glm::vec2 uv);

struct PictureParams {
    int width = 1280, height = 800;
    int samples_per_axis = 3; // of a pixel: 3 -> 9 rays; at least 1
};

// All but colour: grey pictures, Y being cd m^-2, lx, or the CIEDE2000 of the field's trichromatic approach.
enum class PictureQuantity { colour, luminance, illuminance, colour_difference, error };

// Progress goes from 0 to 1. Cancelled: an empty picture.
RadianceImage render_picture(const FieldView& view, const Camera& camera, const PictureParams& params,
                             PictureQuantity quantity, const std::atomic<bool>& cancel,
                             const std::function<void(double)>& progress = {});

// The ray through image coordinates (x, y) in 0..1 from the top left, for a picture of that width/height ratio.
// Direction is unit.
Ray camera_ray(const Camera& camera, double aspect, double x, double y);
// The same camera for OpenGL: clip_from_world, near and far in metres.
glm::dmat4 clip_from_world(const Camera& camera, double aspect, double near_plane, double far_plane);

} // namespace lueur
