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

// Mean of an emission under a hat.
double mean_under(const Spectrum& hat, const Spectrum& emission) {
    const std::vector<double> own = grid(emission);
    if (own.empty()) return 0;
    const double from = std::max(hat.nm.front(), own.front()), to = std::min(hat.nm.back(), own.back());
    const double under = integrate<double>(breakpoints(from, to, {own, hat.nm}), [&](double nm) {
        return value_at(emission, nm, Outside::zero) * value_at(hat, nm, Outside::zero);
    });
    return under / integral(hat, hat.nm.front(), hat.nm.back(), Outside::zero);
}

// Narrow lines keep their power: sum_k watt_weight[k] * mean_k is the emission's integral over 380..780 nm.
std::vector<double> emission_means(const Wavelengths& wavelengths, const Spectrum& emission) {
    std::vector<double> means;
    for (int k = 0; k < wavelengths.size(); ++k) means.push_back(mean_under(emission_hat(wavelengths, k), emission));
    return means;
}

std::vector<double> reflectance_at_samples(const Wavelengths& wavelengths, const Spectrum& reflectance) {
    std::vector<double> values;
    for (const double nm : wavelengths.nm) values.push_back(value_at(reflectance, nm, Outside::constant));
    return values;
}

std::vector<double> emission_at_samples(const Wavelengths& wavelengths, const Spectrum& emission) {
    std::vector<double> values;
    for (const double nm : wavelengths.nm) values.push_back(value_at(emission, nm, Outside::zero));
    return values;
}

std::vector<double> in_its_own_channels(const Wavelengths& wavelengths, const Spectrum& emission) {
    std::vector<double> values(static_cast<std::size_t>(wavelengths.size()), 0.0);
    const auto light = std::ranges::find(wavelengths.lights, emission);
    if (light == wavelengths.lights.end()) return values;
    const std::size_t index = static_cast<std::size_t>(light - wavelengths.lights.begin());
    const std::size_t samples = static_cast<std::size_t>(wavelengths.samples);
    std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(index * samples), samples, wavelengths.light_norm[index]);
    return values;
}

std::vector<double> as_vector(const Rgb& rgb) {
    return {rgb.r, rgb.g, rgb.b};
}

} // namespace

std::vector<double> reflectance_channels(const Wavelengths& wavelengths, const Spectrum& reflectance) {
    switch (wavelengths.spec.rule) {
    case WavelengthRule::uniform:
    case WavelengthRule::meyer:
    case WavelengthRule::gauss:
    case WavelengthRule::folded:
    case WavelengthRule::automatic:
        return reflectance_at_samples(wavelengths, reflectance);
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
    case WavelengthRule::meyer:
    case WavelengthRule::gauss:
        return emission_at_samples(wavelengths, emission);
    case WavelengthRule::folded:
    case WavelengthRule::automatic:
        return in_its_own_channels(wavelengths, emission);
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
    case WavelengthRule::meyer:
    case WavelengthRule::gauss:
    case WavelengthRule::folded:
    case WavelengthRule::automatic:
        return reflectance_at_samples(wavelengths, reflectance_from_rgb(reflectance));
    case WavelengthRule::rgb:
        return as_vector(reflectance);
    }
    return {};
}

Spectrum light_from_rgb(const Rgb& emission) {
    const double largest = std::max({emission.r, emission.g, emission.b});
    Spectrum light = illuminant_d65();
    if (!(largest > 0)) return light;
    const Spectrum filter = reflectance_from_rgb(emission / largest);
    static const double unit = rgb_white_lumens() / xyz_from_spectrum(illuminant_d65()).y;
    for (std::size_t i = 0; i < light.nm.size(); ++i)
        light.value[i] *= unit * value_at(filter, light.nm[i], Outside::constant);
    return light;
}

std::vector<double> emission_channels(const Wavelengths& wavelengths, const Rgb& emission) {
    const double largest = std::max({emission.r, emission.g, emission.b});
    if (wavelengths.spec.rule == WavelengthRule::rgb) return as_vector(emission);
    std::vector<double> channels(static_cast<std::size_t>(wavelengths.size()), 0.0);
    if (!(largest > 0)) return channels;
    channels = emission_channels(wavelengths, light_from_rgb(emission));
    double scale = largest;
    if (!wavelengths.folded()) { // white has its lumens in these channels' own quadrature
        const std::vector<double> white = emission_channels(wavelengths, illuminant_d65());
        static const double exact = xyz_from_spectrum(illuminant_d65()).y;
        scale *= exact / xyz_from_channels(wavelengths, white).y;
    }
    for (double& channel : channels) channel *= scale;
    return channels;
}

} // namespace lueur
