// What a luminaire emits and what a material reflects, as a person chose it: values that copy, compare and save.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/spectrum/spectrum.h"
#include "core/spectrum/wavelengths.h"

namespace lueur {

// A spectrum read from a file. `path` is as written in the scene file; `spectrum` what was read.
struct SpectrumFile {
    std::string path;
    std::string column; // empty: the file's first
    Spectrum spectrum;
    bool operator==(const SpectrumFile&) const = default;
};
struct LibrarySpectrum { // of the program's own library (spectrum_library.h), so that it is found from any scene
    std::string name;
    Spectrum spectrum;
    bool operator==(const LibrarySpectrum&) const = default;
};
struct Drawn { // points set by hand, straight lines between them; kept in the scene file itself
    Spectrum spectrum;
    bool operator==(const Drawn&) const = default;
};
struct Blackbody {
    double kelvin = 2700; // 1000..25000
    bool operator==(const Blackbody&) const = default;
};
struct Daylight {         // CIE daylight (core/spectrum/colour_temperature.h)
    double kelvin = 6504; // 4000..25000
    bool operator==(const Daylight&) const = default;
};
struct Flat { // equal energy at every wavelength of 380..780 nm (CIE illuminant E there)
    bool operator==(const Flat&) const = default;
};
struct SpectralLine { // power spread evenly over a width: a laser, a line of a discharge
    double nm = 589.3;
    double width = 1; // nm
    double power = 1; // relative to the other lines
    bool operator==(const SpectralLine&) const = default;
};
struct Lines {
    std::vector<SpectralLine> lines; // at least one; they may overlap
    bool operator==(const Lines&) const = default;
};

// Each has a curve of its own and may be part of a mixture.
using SimpleEmission = std::variant<Flat, SpectrumFile, LibrarySpectrum, Blackbody, Daylight, Lines, Drawn>;

struct Mix { // the sum of two spectral power distributions
    std::array<SimpleEmission, 2> lights;
    double share = 0.5; // of the luminous flux, that the second light gives: 0..1
    bool operator==(const Mix&) const = default;
};

using Reflectance = std::variant<double, Rgb, SpectrumFile, LibrarySpectrum, Drawn>; // each 0..1; Rgb is linear sRGB
using EmissionSpectrum = std::variant<Flat, Rgb, SpectrumFile, LibrarySpectrum, Blackbody, Daylight, Lines, Drawn,
                                      Mix>; // relative, see PowerUnit

// The light as linear pieces, relative; 0 outside them. None for an Rgb, which has no spectrum but its channels.
Spectrum spectrum_of(const SimpleEmission& emission);
std::optional<Spectrum> spectrum_of(const EmissionSpectrum& emission);

// The reflectance as linear pieces; its end values go on outside them.
Spectrum spectrum_of(const Reflectance& reflectance);

// The same light as part of a mixture, and back; nothing for an Rgb or a Mix.
std::optional<SimpleEmission> simple_emission(const EmissionSpectrum& emission);
EmissionSpectrum emission(const SimpleEmission& simple);

// What is wrong, each in one line that ends in what is allowed; nothing when it is fine.
std::vector<std::string> faults_of(const EmissionSpectrum& emission);
std::vector<std::string> faults_of(const Reflectance& reflectance);

} // namespace lueur
