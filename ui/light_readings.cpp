#include "ui/light_readings.h"

#include <algorithm>

#include "core/spectrum/observer.h"
#include "core/spectrum/photometry.h"

namespace lueur {
namespace {

LightReading reading_of(const Xyz& xyz) {
    LightReading reading;
    reading.xy = chromaticity(xyz);
    reading.temperature = colour_temperature(xyz);
    return reading;
}

LightReading reading_of(const Spectrum& spectrum) {
    LightReading reading = reading_of(xyz_from_spectrum(spectrum));
    reading.rendering = colour_rendering(spectrum);
    const LightQuantity light = light_quantity(spectrum);
    if (light.luminous > 0) reading.scotopic_ratio = scotopic_ratio(light);
    return reading;
}

} // namespace

const LightReading& LightReadings::of(const EmissionSpectrum& emission) {
    const auto known = std::ranges::find(emissions_, emission, &OfEmission::emission);
    if (known != emissions_.end()) return known->reading;
    constexpr std::size_t most = 1024; // a dragged temperature leaves one behind in each frame
    if (emissions_.size() >= most) emissions_.erase(emissions_.begin());
    ++computed;
    const auto spectrum = spectrum_of(emission);
    const auto reading = spectrum ? reading_of(*spectrum) : reading_of(xyz_from_rgb(srgb) * std::get<Rgb>(emission));
    return emissions_.emplace_back(emission, reading).reading;
}

const LightReading& LightReadings::of_arriving(const Spectrum& spectrum) {
    if (arriving_ != spectrum) {
        ++computed;
        arriving_reading_ = reading_of(spectrum);
        arriving_ = spectrum;
        arriving_xyz_.reset();
    }
    return arriving_reading_;
}

const LightReading& LightReadings::of_arriving(const Xyz& xyz) {
    if (arriving_xyz_ != xyz) {
        ++computed;
        arriving_reading_ = reading_of(xyz);
        arriving_xyz_ = xyz;
        arriving_.reset();
    }
    return arriving_reading_;
}

} // namespace lueur
