#include "core/scene/spectral_content.h"

#include <algorithm>

#include "core/scene/luminaire.h"
#include "core/spectrum/rgb_basis.h"

namespace lueur {

namespace {

void add_distinct(std::vector<Spectrum>& spectra, const Spectrum& spectrum) {
    if (!spectrum.nm.empty() && std::ranges::find(spectra, spectrum) == spectra.end()) spectra.push_back(spectrum);
}

bool textured(const Material& material) {
    return material.texture && material.texture->image;
}

} // namespace

Spectrum spectrum_of(const Luminaire& luminaire) {
    const auto spectrum = spectrum_of(luminaire.spectrum);
    return spectrum ? *spectrum : light_from_rgb(std::get<Rgb>(luminaire.spectrum));
}

SpectralContent spectral_content(const Scene& scene) {
    SpectralContent content;
    for (const Luminaire& luminaire : scene.luminaires) add_distinct(content.lights, spectrum_of(luminaire));
    for (const Material& material : scene.materials) {
        const Rgb* rgb = std::get_if<Rgb>(&material.reflectance);
        add_distinct(content.reflectances,
                     rgb && textured(material) ? reflectance_from_texel(*rgb) : spectrum_of(material.reflectance));
        if (!textured(material)) continue;
        for (const Spectrum& basis : rgb_reflectance_basis()) add_distinct(content.reflectances, basis);
    }
    return content;
}

std::vector<double> reflectance_channels(const Material& material, const Wavelengths& wavelengths) {
    const Rgb* rgb = std::get_if<Rgb>(&material.reflectance);
    if (!rgb || !textured(material) || wavelengths.spec.rule == WavelengthRule::rgb)
        return reflectance_channels(material.reflectance, wavelengths);
    return reflectance_channels(wavelengths, reflectance_from_texel(*rgb));
}

std::array<std::vector<double>, 3> texel_channels(const Material& material, const Wavelengths& wavelengths) {
    const Rgb mean = material.texture ? material.texture->mean : Rgb(1);
    const std::vector<double> rho = reflectance_channels(material, wavelengths);
    std::array<std::vector<double>, 3> channels = basis_channels(wavelengths);
    for (std::size_t k = 0; k < rho.size(); ++k) {
        const double of_mean = mean.r * channels[0][k] + mean.g * channels[1][k] + mean.b * channels[2][k];
        for (auto& channel : channels) channel[k] = of_mean > 0 ? channel[k] * rho[k] / of_mean : 0;
    }
    return channels;
}

} // namespace lueur
