#include "core/spectrum/cielab.h"

#include <cmath>

namespace lueur {

namespace {

// ISO/CIE 11664-4: (6/29)^3 and (29/3)^3, of which the often printed 0.008856 and 903.3 are roundings that do not join.
constexpr double epsilon = 216.0 / 24389.0;
constexpr double kappa = 24389.0 / 27.0;

double f(double t) {
    return t > epsilon ? std::cbrt(t) : (kappa * t + 16) / 116;
}
double inverse_f(double f_t) {
    return f_t > 6.0 / 29.0 ? f_t * f_t * f_t : (116 * f_t - 16) / kappa;
}

} // namespace

Lab lab_from_xyz(const Xyz& xyz, const Xyz& white) {
    const double fx = f(xyz.x / white.x), fy = f(xyz.y / white.y), fz = f(xyz.z / white.z);
    return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

Xyz xyz_from_lab(const Lab& lab, const Xyz& white) {
    const double fy = (lab.L + 16) / 116;
    return white * Xyz(inverse_f(fy + lab.a / 500), inverse_f(fy), inverse_f(fy - lab.b / 200));
}

double lightness(double relative_luminance) {
    return 116 * f(relative_luminance) - 16;
}
double relative_luminance(double lightness) {
    return inverse_f((lightness + 16) / 116);
}

} // namespace lueur
