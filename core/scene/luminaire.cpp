#include "core/scene/luminaire.h"

#include <algorithm>

#include "core/spectrum/observer.h"

namespace lueur {

namespace {

constexpr double pi = 3.14159265358979323846;

// What counts as watts (scene.h): the range of all channels.
constexpr double first_watt_nm = 380, last_watt_nm = 780;

double own_integral(const Spectrum& spectrum) {
    return integral(spectrum, first_watt_nm, last_watt_nm, Outside::zero);
}

double ratio(double numerator, double denominator) {
    return denominator > 0 ? numerator / denominator : 0;
}

// Lumens and watts of the relative spectrum, taken as an exitance, a square metre.
struct Fluxes {
    double lumens = 0, watts = 0;
};
Fluxes relative_fluxes(const EmissionSpectrum& emission) {
    if (const auto spectrum = spectrum_of(emission)) return {xyz_from_spectrum(*spectrum).y, own_integral(*spectrum)};
    const Wavelengths rgb = make_wavelengths({WavelengthRule::rgb, 3});
    const std::vector<double> channels = emission_channels(rgb, std::get<Rgb>(emission));
    return {xyz_from_channels(rgb, channels).y, watts_from_channels(rgb, channels)};
}

// What the relative spectrum is multiplied by to become W m^-2 nm^-1, at dimmer 1, for a unit that counts emitted
// energy itself.
double exitance_scale(const Luminaire& luminaire, double exitance) {
    const auto spectrum = spectrum_of(luminaire.spectrum);
    return spectrum ? ratio(exitance, own_integral(*spectrum)) : exitance;
}

double flux(const Scene& scene, const Luminaire& luminaire, double Fluxes::*wanted) {
    const Fluxes relative = relative_fluxes(luminaire.spectrum);
    const double area = emitting_area(scene, luminaire);
    switch (luminaire.unit) {
    case PowerUnit::lumen:
        return area > 0 ? luminaire.dimmer * luminaire.power * ratio(relative.*wanted, relative.lumens) : 0;
    case PowerUnit::watt:
        return area > 0 ? luminaire.dimmer * luminaire.power * ratio(relative.*wanted, relative.watts) : 0;
    case PowerUnit::exitance:
        return luminaire.dimmer * area * exitance_scale(luminaire, luminaire.power) * relative.*wanted;
    case PowerUnit::radiance:
        return luminaire.dimmer * area * exitance_scale(luminaire, pi * luminaire.power) * relative.*wanted;
    }
    return 0;
}

} // namespace

double emitting_area(const Scene& scene, const Luminaire& luminaire) {
    const Geometry& geometry = *scene.geometry;
    std::vector<std::uint8_t> emits(scene.objects.size(), 0);
    for (const ObjectIndex object : luminaire.objects)
        if (at(object) < emits.size()) emits[at(object)] = 1;
    double area = 0;
    for (std::size_t i = 0; i < geometry.surfaces.size(); ++i)
        if (emits[at(geometry.surfaces[i].object)]) area += geometry.surface_area[i];
    switch (luminaire.side) {
    case EmitSide::front:
    case EmitSide::back:
        return area;
    case EmitSide::both:
        return 2 * area;
    }
    return area;
}

std::vector<double> exitance_channels(const Scene& scene, const Luminaire& luminaire, const Wavelengths& wavelengths) {
    const auto spectrum = spectrum_of(luminaire.spectrum);
    std::vector<double> channels = spectrum ? emission_channels(wavelengths, *spectrum)
                                            : emission_channels(wavelengths, std::get<Rgb>(luminaire.spectrum));
    const auto per_square_metre = [&] { return ratio(luminaire.power, emitting_area(scene, luminaire)); };
    double scale = 0;
    switch (luminaire.unit) {
    case PowerUnit::lumen:
        scale = ratio(per_square_metre(), xyz_from_channels(wavelengths, channels).y);
        break;
    case PowerUnit::watt:
        scale = ratio(per_square_metre(), watts_from_channels(wavelengths, channels));
        break;
    case PowerUnit::exitance:
        scale = spectrum ? ratio(luminaire.power, watts_from_channels(wavelengths, channels)) : luminaire.power;
        break;
    case PowerUnit::radiance:
        scale = pi * (spectrum ? ratio(luminaire.power, watts_from_channels(wavelengths, channels)) : luminaire.power);
        break;
    }
    for (double& channel : channels) channel *= scale * luminaire.dimmer;
    return channels;
}

std::vector<double> reflectance_channels(const Reflectance& reflectance, const Wavelengths& wavelengths) {
    if (const double* grey = std::get_if<double>(&reflectance))
        return std::vector<double>(static_cast<std::size_t>(wavelengths.size()), *grey);
    if (const Rgb* rgb = std::get_if<Rgb>(&reflectance)) return reflectance_channels(wavelengths, *rgb);
    return reflectance_channels(wavelengths, spectrum_of(reflectance));
}

std::vector<std::optional<LuminaireIndex>> luminaire_of_objects(const Scene& scene) {
    std::vector<std::optional<LuminaireIndex>> result(scene.objects.size());
    for (std::size_t i = 0; i < scene.luminaires.size(); ++i)
        for (const ObjectIndex object : scene.luminaires[i].objects)
            if (at(object) < result.size()) result[at(object)] = LuminaireIndex{static_cast<std::uint32_t>(i)};
    return result;
}

double luminous_flux(const Scene& scene, const Luminaire& luminaire) {
    return flux(scene, luminaire, &Fluxes::lumens);
}

double radiant_flux(const Scene& scene, const Luminaire& luminaire) {
    return flux(scene, luminaire, &Fluxes::watts);
}

} // namespace lueur
