// What a set of wavelengths has to stand for: the lights and the paints that meet.
#pragma once

#include <array>
#include <vector>

#include "core/spectrum/spectrum.h"

namespace lueur {

struct SpectralContent {
    std::vector<Spectrum> lights;       // distinct, relative
    std::vector<Spectrum> reflectances; // distinct, 0..1
    bool operator==(const SpectralContent&) const = default;
};

// A scene without a light is solved under equal energy, 380..780 nm.
SpectralContent with_a_light(SpectralContent content);

// The reflectances, and, where there is more than one, what is left of light that was reflected by all of them any
// number of times: m + m^2 + m^3... with m their mean, scaled to end at m. Such light is nearly grey, where colour
// differences are seen best.
std::vector<Spectrum> with_interreflection(std::vector<Spectrum> reflectances);

// A colour that light may have after up to three reflections: indices of reflectances; -1 where there was none.
using ReflectanceProduct = std::array<int, 3>;

// All products of one, two and three of `count` reflectances, or, above `most`, every single reflectance, cube and
// square (what is reflected by the same paint again and again has the most saturated colours) and an even choice among
// the others. The same for the same numbers.
std::vector<ReflectanceProduct> reflectance_products(int count, std::size_t most);

} // namespace lueur
