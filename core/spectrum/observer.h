// The CIE 1931 2-degree standard observer at 1 nm, 360..830 nm (CIE 018:2019 table; also ISO/CIE 11664-1), and
// photometry.
#pragma once

#include "core/spectrum/wavelengths.h"

namespace lueur {

// lm/W; the lecture's 680 is the value before 1979 (corrections 1).
inline constexpr double luminous_efficacy_km = 683.0;
inline constexpr int observer_first_nm = 360, observer_last_nm = 830;

Xyz observer_xyz(int nm);    // 0 outside 360..830
Xyz observer_xyz(double nm); // linear between the 1 nm entries

// Km * integral of spectrum * (xbar, ybar, zbar): W m^-2 nm^-1 -> XYZ with Y in lm m^-2. Integrates piecewise exactly
// at 1 nm.
Xyz xyz_from_spectrum(const Spectrum& emission);

} // namespace lueur
