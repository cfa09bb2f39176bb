// The spectrum of the light that leaves a point of the field towards the eye.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/view/picture.h"

namespace lueur {

// W m^-2 sr^-1 nm^-1 per channel of field.wavelengths, with the texel and with what the surface emits itself; empty
// where the field has no channels. `scene` and `field` are those of the point.
std::vector<double> radiance_channels(const Scene& scene, const Field& field, const FieldPoint& point);

// The same for many points: the channels of every material and luminaire are kept.
class RadianceChannels {
public:
    RadianceChannels(const Scene& scene, const Wavelengths& wavelengths);
    std::vector<double> at(const Scene& scene, const Field& field, const FieldPoint& point) const;

private:
    std::vector<std::vector<double>> rho_, exitance_; // of each material, of each luminaire
    std::vector<std::array<std::vector<double>, 3>> by_texel_;
    std::vector<std::optional<LuminaireIndex>> luminaire_of_object_;
};

} // namespace lueur
