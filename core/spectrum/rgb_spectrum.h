// A smooth spectrum bounded to 0..1 for a linear sRGB reflectance (Jakob & Hanika 2019, "A Low-Dimensional Function
// Space for Efficient Spectral Upsampling", eq. 1-3: sigmoid of a quadratic), fitted by Gauss-Newton so that under
// `D65` it gives the RGB back.
#pragma once

#include "core/spectrum/wavelengths.h"

namespace lueur {

Spectrum reflectance_from_rgb(const Rgb& rgb); // each 0..1; 380..780 nm at 5 nm

// The same for a scene lit by `illuminant` (any unit): the reflectance that looks like the RGB to an eye adapted to
// that light (its white is sRGB's by Bradford's transform). Where no reflectance can, the nearest in linear RGB of this
// family; a light without a white to adapt to (none, or a single line) counts as D65.
Spectrum reflectance_from_rgb(const Rgb& rgb, const Spectrum& illuminant);

const Spectrum& illuminant_d65(); // CIE standard illuminant D65, relative, 5 nm

} // namespace lueur
