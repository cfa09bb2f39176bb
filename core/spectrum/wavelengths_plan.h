// How many wavelengths a scene needs, and how far off its colours will be.
#pragma once

#include "core/spectrum/wavelengths.h"

namespace lueur {

// CIEDE2000 between the colours of the content's products (one to three reflections, by single paints and by their
// mean, under each of its lights) in these channels and by integration at 1 nm, white being the light itself. Lights
// that nobody sees do not count.
struct ColourPrediction {
    double mean = 0, worst = 0;
};
ColourPrediction predict_difference(const Wavelengths& wavelengths, const SpectralContent& content);

struct WavelengthsPlan {
    Wavelengths wavelengths;
    ColourPrediction prediction;
    std::string reason; // in one line: what was chosen and why
};

// auto: folded with the fewest samples whose predicted worst difference is at most `target`, or uniform when that takes
// fewer channels or the scene has too many different lamps. Other rules are made as they are, and predicted. `before`:
// what is in use; its wavelengths are kept (with new weights) while their prediction still holds.
WavelengthsPlan plan_wavelengths(const WavelengthsSpec& spec, const SpectralContent& content, double target,
                                 const Wavelengths* before = nullptr);

} // namespace lueur
