// A measured spectrum: values on their own wavelength grid, linear in between or constant over bins.
//
// Units: wavelengths in nm (vacuum/air difference ignored); values in the unit the name of the owner says
// (reflectance 0..1, spectral exitance W m^-2 nm^-1, relative power...).
// Outside its grid an emission is zero and a reflectance keeps its end value (CIE 15:2018, 7.2.2.1). What lies in the
// ultraviolet and the infrared is kept; only 380..780 nm counts as watts of a luminaire (core/scene/luminaire.h).
// A narrow line is never lost because every integral cuts at the spectrum's own grid() (quadrature.h): cut there and
// not at `nm`, which are the middles of the bins of a bin spectrum.
// Errors: make_spectrum refuses fewer than two, unsorted, duplicate, non-finite or not-positive-wavelength samples.
// Missing wavelengths are allowed: the value goes straight across the gap. Files are read in read_spectrum.h, sums and
// products are in operations.h.
#pragma once

#include <expected>
#include <string>
#include <vector>

namespace lueur {

// linear: straight from sample to sample.
// bin: a value is the mean over its bin, as a spectrometer gives it. Bins meet halfway between neighbouring samples;
// the first and the last are symmetric about theirs.
enum class Interpolation { linear, bin };

struct Spectrum {
    std::vector<double> nm;    // strictly increasing
    std::vector<double> value; // one a wavelength
    Interpolation interpolation = Interpolation::linear;

    bool operator==(const Spectrum&) const = default;
};

enum class Outside { zero, constant }; // what a spectrum is outside its grid: emission -> zero, reflectance -> constant

// The checked way to make one. The error text says which sample is wrong and what is allowed.
std::expected<Spectrum, std::string> make_spectrum(std::vector<double> nm, std::vector<double> value,
                                                   Interpolation interpolation = Interpolation::linear);

// Where its pieces meet, from its first to its last wavelength: the samples, or the edges of the bins. Between
// neighbours it is one straight line; at the edge of a bin it jumps.
std::vector<double> grid(const Spectrum& spectrum);
double first_nm(const Spectrum& spectrum); // of its grid; 0 when it is empty
double last_nm(const Spectrum& spectrum);

// At the edge between two bins: the upper one's value.
double value_at(const Spectrum& spectrum, double nm, Outside outside);

// Exact integral over [from, to] nm: narrow lines are never lost between samples.
double integral(const Spectrum& spectrum, double from_nm, double to_nm, Outside outside);

// Planck's law (CIE 15:2018), relative, 1 at 560 nm, each 5 nm from 300 to 830 nm. temperature in kelvin, > 0.
Spectrum blackbody(double kelvin);

} // namespace lueur
