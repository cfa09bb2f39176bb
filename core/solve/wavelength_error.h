// The share of the wavelengths in the error of illuminance.
#pragma once

#include "core/spectrum/wavelengths.h"

namespace lueur {

// Relative error that the channels make of the content's lights as they arrive, and after one reflection: RMS over all
// pairs of a light and a paint, by the luminous flux that is left, against integration.
struct WavelengthError {
    double direct = 0, reflected = 0;
};
WavelengthError wavelength_error(const Wavelengths& wavelengths, const SpectralContent& content);

} // namespace lueur
