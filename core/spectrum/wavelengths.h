// The channels a solution is computed in: K numbers stand for a spectrum everywhere between scene and picture.
//
// uniform:N  N wavelengths evenly from 400 to 700 nm (N = 31: each 10 nm; the lecture's 31 samples, which do not span
//            380..780 as it says: LECTURE corrections 3); above 31 from 380 to 780 nm (81: each 5 nm, the truth that
//            the others are compared with). A channel is the mean of an emission under a hat function as wide as its
//            spacing, so that a narrow line keeps its power, and a reflectance at its middle. The end channels stand
//            for the rest of the visible range. The observer is averaged under the hats with the content's own lights.
// meyer:N, gauss:N  light and reflectance at N unequal wavelengths (point_samples.h): the lecture's, for comparison.
// folded:N   reflectances at N wavelengths fitted to the scene, once for each distinct lamp spectrum, which is in
//            the weights to XYZ (folded_samples.h). Channel light * N + k; a lamp shines in its own light's channels.
// auto       folded with the fewest samples whose predicted colour difference is small enough (wavelengths_plan.h).
// rgb        the lecture's trichromatic approach: three channels, linear sRGB. One unit of RGB white is 1 W spread
//            evenly over 380..780 nm, hence 182.46 lm (Km * 106.857 nm / 400 nm); each channel carries a third of it.
#pragma once

#include <expected>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/spectrum/spectral_content.h"
#include "core/spectrum/spectrum.h"

namespace lueur {

using Rgb = glm::dvec3; // linear, sRGB primaries unless a name says otherwise
using Xyz = glm::dvec3; // CIE 1931, Y photometric (cd m^-2, lx or lm m^-2) unless a name says relative

inline constexpr int max_channels = 96; // solver rows are padded to a multiple of 8 up to this

enum class WavelengthRule { uniform, meyer, gauss, folded, automatic, rgb };

struct WavelengthsSpec {
    WavelengthRule rule = WavelengthRule::uniform;
    int count = 31; // as the rule allows; 0 with automatic, 3 with rgb
    bool operator==(const WavelengthsSpec&) const = default;
};

// "uniform:31", "meyer:4", "gauss:10", "folded:8", "8" (folded), "auto", "rgb". The error lists what is allowed.
std::expected<WavelengthsSpec, std::string> parse_wavelengths(std::string_view text);
std::string to_string(const WavelengthsSpec& spec);

struct Wavelengths {
    WavelengthsSpec asked; // what they were made for
    WavelengthsSpec spec;  // what they are: the same, but for auto and for what did not fit
    // One a channel; for rgb 611, 549, 464 (dominant wavelengths of the sRGB primaries, for plots only).
    std::vector<double> nm;
    // XYZ = sum_k xyz_weight[k] * channel[k]; channel in W m^-2 (sr^-1) nm^-1 -> Y in lx (cd m^-2). Folded: the channel
    // counts lm m^-2 of its light as it is emitted (W m^-2 for a light that nobody sees).
    std::vector<Xyz> xyz_weight;
    // W m^-2 = sum_k watt_weight[k] * channel[k].
    std::vector<double> watt_weight;

    // Folded only: the lights, each with `samples` channels, and what a channel of 1 is worth in the light's own unit.
    std::vector<Spectrum> lights;
    std::vector<double> light_norm;
    int samples = 0;

    int size() const { return static_cast<int>(nm.size()); }
    bool folded() const { return !lights.empty(); }
};

// `content` matters to uniform (its lights) and folded; auto is for wavelengths_plan.h and is taken as folded:8 here.
Wavelengths make_wavelengths(const WavelengthsSpec& spec, const SpectralContent& content = {});
// Folded samples at these wavelengths (on the 5 nm grid), with weights of the fit of this content.
class FoldedFit;
Wavelengths make_folded(const WavelengthsSpec& spec, const std::vector<double>& nm, const SpectralContent& content,
                        const FoldedFit& fit);

// Spectrum -> channels. A reflectance becomes K numbers (uniform clamps them nowhere: the caller has checked it); an
// emission keeps its power per channel. In rgb the reflectance is seen under equal-energy light: f^R = int f rbar / int
// rbar (LECTURE corrections 16), then clamped to 0..1, since rbar has negative lobes and a saturated paint may leave
// that range; an emission keeps its XYZ, so that a channel of a light outside the sRGB gamut (a sodium lamp's blue) is
// negative. Folded: a reflectance is read at the wavelengths, an emission is its light's share of 1 in that light's
// channels, and nothing when it is none of the lights.
std::vector<double> reflectance_channels(const Wavelengths& wavelengths, const Spectrum& reflectance);
std::vector<double> emission_channels(const Wavelengths& wavelengths, const Spectrum& emission);

// Linear RGB -> channels: rgb takes the three numbers as they are; the others go through a smooth bounded spectrum
// (rgb_spectrum.h), for an emission times D65 and its largest number, scaled so that white (1,1,1) has 182.46 lm in
// these channels' own quadrature.
std::vector<double> reflectance_channels(const Wavelengths& wavelengths, const Rgb& reflectance); // each 0..1
std::vector<double> emission_channels(const Wavelengths& wavelengths, const Rgb& emission); // each >= 0, any scale

// The light of an RGB emission divided by its largest number: D65 through the reflectance of that colour, W m^-2 nm^-1,
// so that white has 182.46 lm m^-2.
Spectrum light_from_rgb(const Rgb& emission);

Xyz xyz_from_channels(const Wavelengths& wavelengths, std::span<const float> channels);
Xyz xyz_from_channels(const Wavelengths& wavelengths, std::span<const double> channels);
double watts_from_channels(const Wavelengths& wavelengths, std::span<const double> channels);

// The spectrum that channels stand for, 380..780 nm, to be looked at: linear between the channels; with folded samples
// each light's own spectrum times what the samples say was left of it. Empty for rgb.
Spectrum spectrum_from_channels(const Wavelengths& wavelengths, std::span<const double> channels);

} // namespace lueur
