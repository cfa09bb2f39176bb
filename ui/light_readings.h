// What the colour panel says of a light: worked out when its spectrum changes, not in each frame.
#pragma once

#include <optional>
#include <vector>

#include "core/scene/scene.h"
#include "core/spectrum/colour.h"
#include "core/spectrum/rendering_index.h"

namespace lueur {

struct LightReading {
    Chromaticity xy;                              // (0,0) of no light
    std::optional<ColourTemperature> temperature; // none too far from the planckian locus
    std::optional<ColourRendering> rendering;     // none without a temperature or without a spectrum
    std::optional<double> scotopic_ratio;         // scotopic over photopic; none without a spectrum
};

class LightReadings {
public:
    // References stay until the next call.
    const LightReading& of(const EmissionSpectrum& emission);
    const LightReading& of_arriving(const Spectrum& spectrum);
    const LightReading& of_arriving(const Xyz& xyz); // where only the colour is known

    int computed = 0; // readings worked out so far, for tests

private:
    struct OfEmission {
        EmissionSpectrum emission;
        LightReading reading;
    };
    std::vector<OfEmission> emissions_; // the newest last
    std::optional<Spectrum> arriving_;
    std::optional<Xyz> arriving_xyz_;
    LightReading arriving_reading_;
};

} // namespace lueur
