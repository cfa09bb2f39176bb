#include "editor/snapshot.h"

#include "core/scene/luminaire.h"
#include "core/spectrum/colour.h"
#include "core/view/picture.h"
#include "core/view/radiance_channels.h"

namespace lueur {

std::optional<Probe> probe(const Snapshot& snapshot, glm::vec3 origin, glm::vec3 direction) {
    if (!snapshot.scene || !snapshot.mesh || !snapshot.world || !snapshot.field) return {};
    const FieldView view{snapshot.scene, snapshot.mesh, snapshot.world, snapshot.field};
    const auto point = field_along_ray(view, Ray{origin, direction});
    if (!point) return {};

    const Scene& scene = *snapshot.scene;
    if (point->surface >= scene.geometry->surfaces.size()) return {};
    Probe result;
    result.position = point->position;
    result.normal = point->normal;
    result.surface = SurfaceIndex(point->surface);
    result.object = scene.geometry->surfaces[point->surface].object;
    result.material = scene.objects[at(result.object)].material;
    result.luminaire = luminaire_of_objects(scene)[at(result.object)];
    result.irradiance = point->irradiance;
    result.radiance = point->radiance;
    result.rgb = rgb_from_xyz(srgb) * point->radiance;
    result.error = point->error;
    result.interval_factor = snapshot.field->interval_factor;
    result.unshot = point->unshot;
    result.colour_difference = point->colour_difference;
    if (const auto channels = irradiance_channels(*snapshot.field, *point); !channels.empty()) {
        result.irradiance_spectrum = spectrum_from_channels(*snapshot.field->wavelengths, channels);
        result.irradiance_watts = watts_from_channels(*snapshot.field->wavelengths, channels);
        result.radiance_watts =
            watts_from_channels(*snapshot.field->wavelengths, radiance_channels(scene, *snapshot.field, *point));
    }
    return result;
}

} // namespace lueur
