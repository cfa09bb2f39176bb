// CIELAB (CIE 1976; ISO/CIE 11664-4:2019) with CIE's own constants, where the lecture's slide rounds the exponent to
// 0.33 and drops the linear branch (corrections 14).
#pragma once

#include "core/spectrum/wavelengths.h"

namespace lueur {

struct Lab {
    double L = 0, a = 0, b = 0;
    bool operator==(const Lab&) const = default;
};

// `white` is the tristimulus of the perfect reflector, each number above 0, in the unit of `xyz`.
Lab lab_from_xyz(const Xyz& xyz, const Xyz& white);
Xyz xyz_from_lab(const Lab& lab, const Xyz& white);

// L* of CIELAB and of CIELUV: 0 at black, 100 at the white.
double lightness(double relative_luminance);
double relative_luminance(double lightness);

} // namespace lueur
