// The spectra of a scene: what its wavelengths have to stand for.
#pragma once

#include "core/scene/scene.h"
#include "core/spectrum/spectral_content.h"

namespace lueur {

Spectrum spectrum_of(const Luminaire& luminaire); // relative

// Distinct spectra of all luminaires (dimmed to nothing or not: a dimmer never asks for other wavelengths) and distinct
// reflectances of all materials; of a textured one, its mean and the three that its texels are mixed of.
SpectralContent spectral_content(const Scene& scene);

// Reflectance of a material in channels. With a texture an Rgb is mixed of the texels' three reflectances, so that the
// mean of the texels is the reflectance of their mean.
std::vector<double> reflectance_channels(const Material& material, const Wavelengths& wavelengths);

// What the texel (1,0,0), (0,1,0), (0,0,1) of a textured material reflects of each channel, so that a texel t reflects
// sum_c t_c * channels[c]: its own reflectance (texel / mean) * rho where the material's rho is not the mean of the
// texels. A channel in which the mean is 0 reflects nothing.
std::array<std::vector<double>, 3> texel_channels(const Material& material, const Wavelengths& wavelengths);

} // namespace lueur
