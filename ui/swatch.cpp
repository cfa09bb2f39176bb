#include "ui/swatch.h"

#include <algorithm>
#include <optional>

#include "core/spectrum/colour.h"
#include "core/spectrum/observer.h"
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
    if (const double* grey = std::get_if<double>(&reflectance)) return Rgb(*grey);
    if (const Rgb* rgb = std::get_if<Rgb>(&reflectance)) return *rgb;
    return srgb_from_xyz(xyz_under_d65(spectrum_of(reflectance)));
}

double luminous_reflectance(const Reflectance& reflectance) {
    static const glm::dmat3 to_xyz = xyz_from_rgb(srgb);
    if (const double* grey = std::get_if<double>(&reflectance)) return *grey;
    if (const Rgb* rgb = std::get_if<Rgb>(&reflectance)) return (to_xyz * *rgb).y;
    return xyz_under_d65(spectrum_of(reflectance)).y;
}

Rgb linear_rgb(const EmissionSpectrum& emission) {
    const std::optional<Spectrum> spectrum = spectrum_of(emission);
    const Rgb rgb = glm::max(spectrum ? srgb_from_xyz(xyz_from_spectrum(*spectrum)) : std::get<Rgb>(emission), 0.0);
    const double largest = std::max({rgb.r, rgb.g, rgb.b});
    return largest > 0 ? rgb / largest : Rgb(0);
}

Spectrum curve_of(const Reflectance& reflectance) {
    return spectrum_of(reflectance);
}

Spectrum curve_of(const EmissionSpectrum& emission) {
    if (const Rgb* rgb = std::get_if<Rgb>(&emission)) return light_from_rgb(*rgb);
    return *spectrum_of(emission);
}

glm::vec3 encoded(const Rgb& linear) {
    const auto c = glm::clamp(linear, 0.0, 1.0);
    return {srgb_encode(c.r), srgb_encode(c.g), srgb_encode(c.b)};
}

Rgb decoded(const glm::vec3& encoded_srgb) {
    return {srgb_decode(encoded_srgb.r), srgb_decode(encoded_srgb.g), srgb_decode(encoded_srgb.b)};
}

} // namespace lueur
