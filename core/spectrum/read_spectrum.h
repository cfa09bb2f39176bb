// Spectra from files. All errors of a file come in one go, each `FILE:LINE:COLUMN: what is wrong; what is allowed`.
//
//     .csv         comment lines '#', a header line whose first name is wavelength_nm, then rows of numbers
//     .spd         one `wavelength value` a line, in nm, parted by blanks, tabs, a comma or a semicolon; '#' starts a
//                  comment (as pbrt and Mitsuba have it)
//     .sp .cmf     the CGATS text of Argyll CMS: SPECTRAL_BANDS, SPECTRAL_START_NM, SPECTRAL_END_NM, optional
//                  SPECTRAL_NORM (values are divided by it), then one or more sets between BEGIN_DATA and END_DATA
//
// A file that is not .csv is told apart by what is in it, whatever it is called. UTF-8, with or without byte order
// mark; lines end in LF or CR LF. Wavelengths must increase from row to row; their number has no limit.
#pragma once

#include <filesystem>

#include "core/spectrum/spectrum.h"

namespace lueur {

using SpectrumErrors = std::vector<std::string>;

// `column`: of a .csv the column's name; of a CGATS file the set's SAMPLE_NAME or SAMPLE_ID, or its number from 1, or
// X, Y, Z of a .cmf of three sets. Empty: the first.
std::expected<Spectrum, SpectrumErrors> read_spectrum(const std::filesystem::path& file, const std::string& column,
                                                      Interpolation interpolation = Interpolation::linear);

std::expected<Spectrum, SpectrumErrors> read_spectrum_csv(const std::filesystem::path& file, const std::string& column);

// The names that `column` may have, in their order; one empty name for a file of one nameless spectrum. Reads no
// numbers of a .csv.
std::expected<std::vector<std::string>, SpectrumErrors> spectrum_columns(const std::filesystem::path& file);

// The lower-case extensions of files that hold spectra, with the dot.
std::vector<std::string> spectrum_extensions();

} // namespace lueur
