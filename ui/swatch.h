// The colour of a reflectance under daylight and of a light by itself, for swatches and curves in the panels.
#pragma once

#include "core/scene/scene.h"

namespace lueur {

// Linear sRGB under CIE D65, white reflects (1, 1, 1). May leave 0..1 where the colour is outside the sRGB gamut.
Rgb linear_rgb(const Reflectance& reflectance);
double luminous_reflectance(const Reflectance& reflectance); // under D65

// Linear sRGB of the light's chromaticity, the largest component 1, negatives cut.
Rgb linear_rgb(const EmissionSpectrum& spectrum);

// What is drawn as a curve; of an Rgb emission the spectrum that it is taken for.
Spectrum curve_of(const Reflectance& reflectance);
Spectrum curve_of(const EmissionSpectrum& spectrum);

glm::vec3 encoded(const Rgb& linear); // sRGB 0..1, clamped
Rgb decoded(const glm::vec3& encoded_srgb);

} // namespace lueur
