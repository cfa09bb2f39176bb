// CIELUV (CIE 1976; ISO/CIE 11664-5:2016) and the uniform chromaticity scales u'v' of 1976 and uv of 1960.
#pragma once

#include "core/spectrum/colour.h"

namespace lueur {

struct Uv1976 { // u', v'
    double u = 0, v = 0;
    bool operator==(const Uv1976&) const = default;
};
struct Uv1960 { // u, v: what colour temperatures and CIE 13.3 are reckoned in; u = u', v = 2/3 v'
    double u = 0, v = 0;
    bool operator==(const Uv1960&) const = default;
};
struct Luv {
    double L = 0, u = 0, v = 0; // L*, u*, v*
    bool operator==(const Luv&) const = default;
};

// Black, whose chromaticity is not defined, has (0,0).
Uv1976 uv1976_from_xyz(const Xyz& xyz);
Uv1960 uv1960_from_xyz(const Xyz& xyz);
Uv1976 uv1976_from_chromaticity(const Chromaticity& xy);
Uv1960 uv1960_from_chromaticity(const Chromaticity& xy);
Chromaticity chromaticity_from_uv(const Uv1976& uv);
Chromaticity chromaticity_from_uv(const Uv1960& uv);

// `white` is the tristimulus of the perfect reflector, Y above 0, in the unit of `xyz`.
Luv luv_from_xyz(const Xyz& xyz, const Xyz& white);
Xyz xyz_from_luv(const Luv& luv, const Xyz& white);

} // namespace lueur
