// The emission of a luminaire in channels.
#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace lueur {

// Area that emits, m^2 (both sides counted when it emits from both).
double emitting_area(const Scene& scene, const Luminaire& luminaire);

// Exitance of the luminaire's surface per channel, W m^-2 nm^-1 (rgb: units of the scene's emission), dimmer included.
// Lumens and watts (of exitance and radiance too) are met exactly in the channels' own quadrature.
std::vector<double> exitance_channels(const Scene& scene, const Luminaire& luminaire, const Wavelengths& wavelengths);

std::vector<double> reflectance_channels(const Reflectance& reflectance, const Wavelengths& wavelengths);

// Luminaire that lights each object, or none.
std::vector<std::optional<LuminaireIndex>> luminaire_of_objects(const Scene& scene);

double luminous_flux(const Scene& scene, const Luminaire& luminaire); // lm, dimmer included
double radiant_flux(const Scene& scene, const Luminaire& luminaire);  // W within 380..780 nm

} // namespace lueur
