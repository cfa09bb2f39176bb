// Spectra and RGB colours -> the channels of a solution.
#include <algorithm>
#include <cmath>

#include "core/spectrum/channel_hat.h"
#include "core/spectrum/colour.h"
#include "core/spectrum/observer_integral.h"
#include "core/spectrum/quadrature.h"
#include "core/spectrum/rgb_spectrum.h"

namespace lueur {

namespace {

// Mean of the spectrum under a hat.
double mean_under(const Spectrum& hat, const Spectrum& spectrum, Outside outside) {
    double from = hat.nm.front(), to = hat.nm.back();
    if (outside == Outside::zero && !spectrum.nm.empty()) { // keep the jump to zero out of the intervals
        from = std::max(from, spectrum.nm.front());
        to = std::min(to, spectrum.nm.back());
    }
    const double under = integrate<double>(breakpoints(from, to, {spectrum.nm, hat.nm}), [&](double nm) {
        return value_at(spectrum, nm, outside) * value_at(hat, nm, Outside::zero);
    });
    return under / integral(hat, hat.nm.front(), hat.nm.back(), Outside::zero);
}

std::vector<double> reflectance_means(const Wavelengths& wavelengths, const Spectrum& reflectance) {
    std::vector<double> means;
    for (int k = 0; k < wavelengths.size(); ++k)
        means.push_back(mean_under(channel_hat(wavelengths, k), reflectance, Outside::constant));
    return means;
}

// Narrow lines keep their power: sum_k watt_weight[k] * mean_k is the emission's integral over 380..780 nm.
std::vector<double> emission_means(const Wavelengths& wavelengths, const Spectrum& emission) {
    std::vector<double> means;
    for (int k = 0; k < wavelengths.size(); ++k)
        means.push_back(mean_under(emission_hat(wavelengths, k), emission, Outside::zero));
    return means;
}

std::vector<double> as_vector(const Rgb& rgb) {
    return {rgb.r, rgb.g, rgb.b};
}

} // namespace

std::vector<double> reflectance_channels(const Wavelengths& wavelengths, const Spectrum& reflectance) {
    switch (wavelengths.spec.rule) {
    case WavelengthRule::uniform:
        return reflectance_means(wavelengths, reflectance);
    case WavelengthRule::rgb: {
        // rbar, gbar, bbar have negative lobes: a saturated reflectance within 0..1 may leave that range here, and a
        // channel above 1 would make light out of nothing.
        const glm::dmat3 rgb_from = rgb_from_xyz(srgb);
        const Spectrum flat{{observer_first_nm, observer_last_nm}, {1, 1}};
        const Rgb mean = rgb_from * observer_integral(reflectance, Outside::constant) /
                         (rgb_from * observer_integral(flat, Outside::constant));
        return as_vector(glm::clamp(mean, 0.0, 1.0));
    }
    }
    return {};
}

std::vector<double> emission_channels(const Wavelengths& wavelengths, const Spectrum& emission) {
    switch (wavelengths.spec.rule) {
    case WavelengthRule::uniform:
        return emission_means(wavelengths, emission);
    case WavelengthRule::rgb: {
        const auto& weight = wavelengths.xyz_weight;
        return as_vector(glm::inverse(glm::dmat3(weight[0], weight[1], weight[2])) * xyz_from_spectrum(emission));
    }
    }
    return {};
}

std::vector<double> reflectance_channels(const Wavelengths& wavelengths, const Rgb& reflectance) {
    switch (wavelengths.spec.rule) {
    case WavelengthRule::uniform:
        return reflectance_means(wavelengths, reflectance_from_rgb(reflectance));
    case WavelengthRule::rgb:
        return as_vector(reflectance);
    }
    return {};
}

std::vector<double> emission_channels(const Wavelengths& wavelengths, const Rgb& emission) {
    switch (wavelengths.spec.rule) {
    case WavelengthRule::uniform: {
        const double largest = std::max({emission.r, emission.g, emission.b});
        if (!(largest > 0)) return std::vector<double>(static_cast<std::size_t>(wavelengths.size()), 0.0);
        const Spectrum filter = reflectance_from_rgb(emission / largest);
        Spectrum filtered = illuminant_d65();
        for (std::size_t i = 0; i < filtered.nm.size(); ++i)
            filtered.value[i] *= value_at(filter, filtered.nm[i], Outside::constant);
        // One unit of white has the luminous exitance of the rgb rule, met exactly in these channels' own quadrature.
        const std::vector<double> white = emission_means(wavelengths, illuminant_d65());
        const double scale = largest * rgb_white_lumens() / xyz_from_channels(wavelengths, white).y;
        std::vector<double> channels = emission_means(wavelengths, filtered);
        for (double& channel : channels) channel *= scale;
        return channels;
    }
    case WavelengthRule::rgb:
        return as_vector(emission);
    }
    return {};
}

} // namespace lueur
