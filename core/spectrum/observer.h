// The CIE standard observers at 1 nm, 360..830 nm (ISO/CIE 11664-1:2019): 1931 2-degree, which is meant wherever no
// observer is named, and 1964 10-degree. Luminous quantities are defined by the 1931 observer; Y10 is relative.
#pragma once

#include "core/spectrum/wavelengths.h"

namespace lueur {

// lm/W; the lecture's 680 is the value before 1979 (corrections 1).
inline constexpr double luminous_efficacy_km = 683.0;
inline constexpr int observer_first_nm = 360, observer_last_nm = 830;

enum class Observer { cie1931_2degree, cie1964_10degree };

Xyz observer_xyz(int nm, Observer observer = Observer::cie1931_2degree);    // 0 outside 360..830
Xyz observer_xyz(double nm, Observer observer = Observer::cie1931_2degree); // linear between the 1 nm entries

// Km * integral of spectrum * (xbar, ybar, zbar): W m^-2 nm^-1 -> XYZ with Y in lm m^-2. Integrates piecewise exactly
// at 1 nm.
Xyz xyz_from_spectrum(const Spectrum& emission, Observer observer = Observer::cie1931_2degree);

} // namespace lueur
