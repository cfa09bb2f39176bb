#include <algorithm>
#include <cmath>

#include "core/spectrum/spectrum.h"

namespace lueur {

Spectrum blackbody(double kelvin) {
    // Second radiation constant hc/k in nm K, exact since the SI of 2019 (CIE 15:2018 rounds it to 1.4388e7).
    constexpr double c2 = 1.438776877e7;
    constexpr double reference_nm = 560;
    const double x_reference = c2 / (reference_nm * kelvin);
    Spectrum spectrum;
    for (int nm = 300; nm <= 830; nm += 5) {
        // lambda^-5 / (exp(c2 / (lambda T)) - 1) over its value at 560 nm, written so that no exponential of a cold
        // body overflows.
        const double x = c2 / (nm * kelvin);
        const double exponential = std::exp(std::min(x_reference - x, 700.0));
        spectrum.nm.push_back(nm);
        spectrum.value.push_back(std::pow(reference_nm / nm, 5) * exponential * std::expm1(-x_reference) /
                                 std::expm1(-x));
    }
    return spectrum;
}

} // namespace lueur
