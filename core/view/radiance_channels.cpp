#include "core/view/radiance_channels.h"

#include <numbers>

#include "core/scene/luminaire.h"
#include "core/scene/spectral_content.h"

namespace lueur {

namespace {

std::vector<double> radiance_of(std::vector<double> irradiance, const FieldPoint& point, const std::vector<double>& rho,
                                const std::array<std::vector<double>, 3>& by_texel,
                                const std::vector<double>& exitance) {
    for (std::size_t k = 0; k < irradiance.size(); ++k) {
        double reflectance = rho[k];
        if (point.texel) {
            reflectance = 0;
            for (std::size_t c = 0; c < 3; ++c)
                reflectance += double((*point.texel)[static_cast<int>(c)]) * by_texel[c][k];
        }
        irradiance[k] *= reflectance / std::numbers::pi;
        if (!exitance.empty() && point.emitted.y > 0) irradiance[k] += exitance[k] / std::numbers::pi;
    }
    return irradiance;
}

ObjectIndex object_of(const Scene& scene, const FieldPoint& point) {
    return scene.geometry->surfaces[point.surface].object;
}

} // namespace

std::vector<double> radiance_channels(const Scene& scene, const Field& field, const FieldPoint& point) {
    std::vector<double> irradiance = irradiance_channels(field, point);
    if (irradiance.empty()) return {};
    const ObjectIndex object = object_of(scene, point);
    const Material& material = scene.materials[at(scene.objects[at(object)].material)];
    const auto luminaire = luminaire_of_objects(scene)[at(object)];
    return radiance_of(std::move(irradiance), point, reflectance_channels(material, *field.wavelengths),
                       texel_channels(material, *field.wavelengths),
                       luminaire ? exitance_channels(scene, scene.luminaires[at(*luminaire)], *field.wavelengths)
                                 : std::vector<double>{});
}

RadianceChannels::RadianceChannels(const Scene& scene, const Wavelengths& wavelengths)
    : luminaire_of_object_(luminaire_of_objects(scene)) {
    for (const Material& material : scene.materials) {
        rho_.push_back(reflectance_channels(material, wavelengths));
        by_texel_.push_back(texel_channels(material, wavelengths));
    }
    for (const Luminaire& luminaire : scene.luminaires)
        exitance_.push_back(exitance_channels(scene, luminaire, wavelengths));
}

std::vector<double> RadianceChannels::at(const Scene& scene, const Field& field, const FieldPoint& point) const {
    static const std::vector<double> dark;
    const ObjectIndex object = object_of(scene, point);
    const std::size_t material = lueur::at(scene.objects[lueur::at(object)].material);
    const auto luminaire = luminaire_of_object_[lueur::at(object)];
    return radiance_of(irradiance_channels(field, point), point, rho_[material], by_texel_[material],
                       luminaire ? exitance_[lueur::at(*luminaire)] : dark);
}

} // namespace lueur
