#include "ui/swatch.h"

#include <algorithm>
#include <utility>

#include "core/spectrum/colour.h"
#include "core/spectrum/observer.h"
#include "core/spectrum/overload.h"
#include "core/spectrum/rgb_spectrum.h"

namespace lueur {
namespace {

// Y = 1 for the perfect white.
Xyz xyz_under_d65(const Spectrum& reflectance) {
    static const Xyz white = xyz_from_spectrum(illuminant_d65());
    Spectrum light = illuminant_d65();
    for (std::size_t i = 0; i < light.nm.size(); ++i)
        light.value[i] *= value_at(reflectance, light.nm[i], Outside::constant);
    return xyz_from_spectrum(light) / white.y;
}

Rgb srgb_from_xyz(const Xyz& xyz) {
    static const glm::dmat3 matrix = rgb_from_xyz(srgb);
    return matrix * xyz;
}

} // namespace

Rgb linear_rgb(const Reflectance& reflectance) {
    return std::visit(Overload{[](double value) { return Rgb(value); }, [](const Rgb& rgb) { return rgb; },
                               [](const SpectrumFile& file) { return srgb_from_xyz(xyz_under_d65(file.spectrum)); }},
                      reflectance);
}

double luminous_reflectance(const Reflectance& reflectance) {
    static const glm::dmat3 to_xyz = xyz_from_rgb(srgb);
    return std::visit(Overload{[](double value) { return value; }, [](const Rgb& rgb) { return (to_xyz * rgb).y; },
                               [](const SpectrumFile& file) { return xyz_under_d65(file.spectrum).y; }},
                      reflectance);
}

Rgb linear_rgb(const EmissionSpectrum& spectrum) {
    const auto of_xyz = [](const Xyz& xyz) { return srgb_from_xyz(xyz); };
    Rgb rgb =
        std::visit(Overload{[&](const Flat&) { return of_xyz(xyz_from_spectrum(curve_of(Flat{}))); },
                            [](const Rgb& colour) { return colour; },
                            [&](const SpectrumFile& file) { return of_xyz(xyz_from_spectrum(file.spectrum)); },
                            [&](const Blackbody& body) { return of_xyz(xyz_from_spectrum(blackbody(body.kelvin))); }},
                   spectrum);
    rgb = glm::max(rgb, 0.0);
    const double largest = std::max({rgb.r, rgb.g, rgb.b});
    return largest > 0 ? rgb / largest : Rgb(0);
}

Spectrum curve_of(const Reflectance& reflectance) {
    return std::visit(Overload{[](double value) {
                                   return Spectrum{{380, 780}, {value, value}};
                               },
                               [](const Rgb& rgb) { return reflectance_from_rgb(glm::clamp(rgb, 0.0, 1.0)); },
                               [](const SpectrumFile& file) { return file.spectrum; }},
                      reflectance);
}

Spectrum curve_of(const EmissionSpectrum& spectrum) {
    return std::visit(Overload{[](const Flat&) {
                                   return Spectrum{{380, 780}, {1, 1}};
                               },
                               [](const Rgb&) { return Spectrum{}; },
                               [](const SpectrumFile& file) { return file.spectrum; },
                               [](const Blackbody& body) { return blackbody(body.kelvin); }},
                      spectrum);
}

glm::vec3 encoded(const Rgb& linear) {
    const auto c = glm::clamp(linear, 0.0, 1.0);
    return {srgb_encode(c.r), srgb_encode(c.g), srgb_encode(c.b)};
}

Rgb decoded(const glm::vec3& encoded_srgb) {
    return {srgb_decode(encoded_srgb.r), srgb_decode(encoded_srgb.g), srgb_decode(encoded_srgb.b)};
}

} // namespace lueur
