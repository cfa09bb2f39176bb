// Three reflectances whose mixtures are the colours of sRGB: a texel's spectrum is a sum of three.
//
// Mallett & Yuksel 2019, "Spectral Primary Decomposition for Rendering with sRGB Reflectance": the smoothest three
// spectra that are nowhere negative, sum to 1 at every wavelength and have, under D65, the colours (1,0,0), (0,1,0) and
// (0,0,1). So every RGB within 0..1 gives a reflectance within 0..1 with exactly that colour, and the light that a
// textured point reflects is a 3x3 matrix (of the light that arrives) times its texel.
#pragma once

#include <array>

#include "core/spectrum/wavelengths.h"

namespace lueur {

const std::array<Spectrum, 3>& rgb_reflectance_basis(); // 380..780 nm at 5 nm; computed at its first use

Spectrum reflectance_from_texel(const Rgb& rgb); // the sum of the three

// The three in channels; for the rgb rule each is its own channel.
std::array<std::vector<double>, 3> basis_channels(const Wavelengths& wavelengths);

} // namespace lueur
