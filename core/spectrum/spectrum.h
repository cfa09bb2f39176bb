// A measured spectrum: values on their own wavelength grid, linear in between.
//
// Units: wavelengths in nm (vacuum/air difference ignored); values in the unit the name of the owner says
// (reflectance 0..1, spectral exitance W m^-2 nm^-1, relative power...).
// Outside its grid an emission is zero and a reflectance keeps its end value (CIE 15:2018, 7.2.2.1).
// Errors: make_spectrum refuses fewer than two, unsorted, duplicate, non-finite or not-positive-wavelength samples.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

namespace lueur {

struct Spectrum {
    std::vector<double> nm;    // strictly increasing
    std::vector<double> value; // one a wavelength

    bool operator==(const Spectrum&) const = default;
};

enum class Outside { zero, constant }; // what a spectrum is outside its grid: emission -> zero, reflectance -> constant

// The checked way to make one. The error text says which sample is wrong and what is allowed.
std::expected<Spectrum, std::string> make_spectrum(std::vector<double> nm, std::vector<double> value);

double value_at(const Spectrum& spectrum, double nm, Outside outside);

// Exact integral of the piecewise linear spectrum over [from, to] nm: narrow lines are never lost between samples.
double integral(const Spectrum& spectrum, double from_nm, double to_nm, Outside outside);

// Planck's law (CIE 15:2018), relative, 1 at 560 nm, each 5 nm from 300 to 830 nm. temperature in kelvin, > 0.
Spectrum blackbody(double kelvin);

// Reads column `column` of a .csv spectrum file: comment lines '#', a header line whose first name is wavelength_nm,
// then rows of numbers. An empty column name means the first column after the wavelength. All errors of the file in one
// go, each `FILE:LINE:COLUMN: what is wrong; what is allowed`.
std::expected<Spectrum, std::vector<std::string>> read_spectrum_csv(const std::filesystem::path& file,
                                                                    const std::string& column);

} // namespace lueur
