// The wavelengths that a scene is solved in, and what they were chosen for.
#pragma once

#include <memory>
#include <string>

#include "core/scene/scene.h"
#include "core/solve/wavelength_error.h"
#include "core/spectrum/spectral_content.h"

namespace lueur {

struct WavelengthsChoice {
    std::shared_ptr<const Wavelengths> wavelengths;
    double predicted_error = -1;       // CIEDE2000 at worst, of auto and folded wavelengths; below 0: not predicted
    WavelengthError illuminance_error; // what they make of illuminance
    std::string words;                 // what the channels are, in a line
    std::shared_ptr<const Scene> scene;
    SpectralContent content; // of the scene
};

// The same as before where the scene's lights and paints have not changed, and where they have as long as the
// prediction holds. Planning takes some tenths of a second for a scene of many paints.
WavelengthsChoice choose_wavelengths(std::shared_ptr<const Scene> scene, const WavelengthsChoice& before);

// Neither a paint nor the spectrum of a lamp is another: what a dimmer leaves alone.
bool same_spectra(const Scene& a, const Scene& b);

} // namespace lueur
