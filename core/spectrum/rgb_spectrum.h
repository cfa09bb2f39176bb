// A smooth spectrum bounded to 0..1 for a linear sRGB reflectance (Jakob & Hanika 2019, "A Low-Dimensional Function
// Space for Efficient Spectral Upsampling", eq. 1-3: sigmoid of a quadratic), fitted by Gauss-Newton so that under
// `D65` it gives the RGB back.
#pragma once

#include "core/spectrum/wavelengths.h"

namespace lueur {

Spectrum reflectance_from_rgb(const Rgb& rgb); // each 0..1; 380..780 nm at 5 nm
const Spectrum& illuminant_d65();              // CIE standard illuminant D65, relative, 5 nm

} // namespace lueur
