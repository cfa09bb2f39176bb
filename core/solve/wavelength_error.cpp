#include "core/solve/wavelength_error.h"

#include <cmath>

#include "core/spectrum/observer.h"
#include "core/spectrum/operations.h"

namespace lueur {

namespace {

double luminous(const Wavelengths& wavelengths, const std::vector<double>& light, const std::vector<double>* paint) {
    double y = 0;
    for (std::size_t k = 0; k < light.size(); ++k)
        y += wavelengths.xyz_weight[k].y * light[k] * (paint ? (*paint)[k] : 1.0);
    return y;
}

// Sums of squared differences and of squares.
struct Squares {
    double difference = 0, all = 0;
    void add(double found, double exact) {
        difference += (found - exact) * (found - exact);
        all += exact * exact;
    }
    double relative() const { return all > 0 ? std::sqrt(difference / all) : 0; }
};

} // namespace

WavelengthError wavelength_error(const Wavelengths& wavelengths, const SpectralContent& content) {
    std::vector<std::vector<double>> paints;
    for (const Spectrum& paint : content.reflectances) paints.push_back(reflectance_channels(wavelengths, paint));
    Squares direct, reflected;
    for (const Spectrum& light : content.lights) {
        const double whole = xyz_from_spectrum(light).y;
        if (!(whole > 0)) continue;
        // Lights are relative: each counts as much as any other.
        std::vector<double> channels = emission_channels(wavelengths, light);
        for (double& e : channels) e /= whole;
        direct.add(luminous(wavelengths, channels, nullptr), 1);
        for (std::size_t p = 0; p < paints.size(); ++p)
            reflected.add(luminous(wavelengths, channels, &paints[p]),
                          xyz_from_spectrum(product(light, content.reflectances[p])).y / whole);
    }
    return {direct.relative(), reflected.relative()};
}

} // namespace lueur
