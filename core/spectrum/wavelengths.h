// The channels a solution is computed in: K numbers stand for a spectrum everywhere between scene and picture.
//
// uniform:N  N wavelengths evenly from 400 to 700 nm (N = 31: each 10 nm; the lecture's 31 samples, which do not span
//            380..780 as it says: LECTURE corrections 3). A channel is the mean of the spectrum under a hat function as
//            wide as its spacing, so that a narrow line keeps its power. The end channels stand for the rest of the
//            visible range too, 380..400 and 700..780 nm.
// rgb        the lecture's trichromatic approach: three channels, linear sRGB. One unit of RGB white is 1 W spread
//            evenly over 380..780 nm, hence 182.46 lm (Km * 106.857 nm / 400 nm); each channel carries a third of it.
#pragma once

#include <expected>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/spectrum/spectrum.h"

namespace lueur {

using Rgb = glm::dvec3; // linear, sRGB primaries unless a name says otherwise
using Xyz = glm::dvec3; // CIE 1931, Y photometric (cd m^-2, lx or lm m^-2) unless a name says relative

inline constexpr int max_channels = 32; // solver rows are padded to a multiple of 8 up to this

enum class WavelengthRule { uniform, rgb };

struct WavelengthsSpec {
    WavelengthRule rule = WavelengthRule::uniform;
    int count = 31; // 4..31 with uniform, 3 with rgb
    bool operator==(const WavelengthsSpec&) const = default;
};

// "uniform:31", "rgb". The error lists what is allowed.
std::expected<WavelengthsSpec, std::string> parse_wavelengths(std::string_view text);
std::string to_string(const WavelengthsSpec& spec);

struct Wavelengths {
    WavelengthsSpec spec;
    // K; for rgb 611, 549, 464 (dominant wavelengths of the sRGB primaries, for plots only).
    std::vector<double> nm;
    // XYZ = sum_k xyz_weight[k] * channel[k]; channel in W m^-2 (sr^-1) nm^-1 -> Y in lx (cd m^-2).
    std::vector<Xyz> xyz_weight;
    // W m^-2 = sum_k watt_weight[k] * channel[k].
    std::vector<double> watt_weight;
    int size() const { return static_cast<int>(nm.size()); }
};

Wavelengths make_wavelengths(const WavelengthsSpec& spec);

// Spectrum -> channels. A reflectance becomes K numbers (uniform clamps them nowhere: the caller has checked it); an
// emission keeps its power per channel. In rgb the reflectance is seen under equal-energy light: f^R = int f rbar / int
// rbar (LECTURE corrections 16), then clamped to 0..1, since rbar has negative lobes and a saturated paint may leave
// that range; an emission keeps its XYZ, so that a channel of a light outside the sRGB gamut (a sodium lamp's blue) is
// negative.
std::vector<double> reflectance_channels(const Wavelengths& wavelengths, const Spectrum& reflectance);
std::vector<double> emission_channels(const Wavelengths& wavelengths, const Spectrum& emission);

// Linear RGB -> channels: rgb takes the three numbers as they are; uniform goes through a smooth bounded spectrum
// (rgb_spectrum.h), for an emission times D65 and its largest number, scaled so that white (1,1,1) has 182.46 lm in
// these channels' own quadrature.
std::vector<double> reflectance_channels(const Wavelengths& wavelengths, const Rgb& reflectance); // each 0..1
std::vector<double> emission_channels(const Wavelengths& wavelengths, const Rgb& emission); // each >= 0, any scale

Xyz xyz_from_channels(const Wavelengths& wavelengths, std::span<const float> channels);
Xyz xyz_from_channels(const Wavelengths& wavelengths, std::span<const double> channels);
double watts_from_channels(const Wavelengths& wavelengths, std::span<const double> channels);

} // namespace lueur
