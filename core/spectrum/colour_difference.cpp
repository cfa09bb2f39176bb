#include "core/spectrum/colour_difference.h"

#include <cmath>
#include <numbers>

namespace lueur {

namespace {

constexpr double degree = std::numbers::pi / 180;

double power7(double x) {
    const double x2 = x * x;
    return x2 * x2 * x2 * x;
}

// h' in degrees, 0..360; 0 for a grey (eq. 7).
double hue_angle(double a, double b) {
    if (a == 0 && b == 0) return 0;
    const double h = std::atan2(b, a) / degree;
    return h < 0 ? h + 360 : h;
}

} // namespace

double delta_e_ab(const Lab& first, const Lab& second) {
    return std::hypot(first.L - second.L, first.a - second.a, first.b - second.b);
}

double delta_e_uv(const Luv& first, const Luv& second) {
    return std::hypot(first.L - second.L, first.u - second.u, first.v - second.v);
}

// Sharma, Wu & Dalal 2005, "The CIEDE2000 Color-Difference Formula: Implementation Notes, Supplementary Test Data, and
// Mathematical Observations", eq. 2-22.
double delta_e_2000(const Lab& first, const Lab& second) {
    constexpr double power25 = 6103515625.0; // 25^7
    const double C_ab = (std::hypot(first.a, first.b) + std::hypot(second.a, second.b)) / 2;
    const double G = 0.5 * (1 - std::sqrt(power7(C_ab) / (power7(C_ab) + power25)));
    const double a1 = (1 + G) * first.a, a2 = (1 + G) * second.a;
    const double C1 = std::hypot(a1, first.b), C2 = std::hypot(a2, second.b);
    const double h1 = hue_angle(a1, first.b), h2 = hue_angle(a2, second.b);
    const bool grey = C1 * C2 == 0;

    const double dL = second.L - first.L, dC = C2 - C1;
    double dh = grey ? 0 : h2 - h1;
    if (dh > 180) dh -= 360;
    if (dh < -180) dh += 360;
    const double dH = 2 * std::sqrt(C1 * C2) * std::sin(dh / 2 * degree);

    const double L = (first.L + second.L) / 2, C = (C1 + C2) / 2;
    double h = h1 + h2; // mean hue: half the sum on the shorter arc (eq. 14)
    if (!grey) {
        if (std::abs(h1 - h2) > 180) h += h < 360 ? 360 : -360;
        h /= 2;
    }
    const double T = 1 - 0.17 * std::cos((h - 30) * degree) + 0.24 * std::cos(2 * h * degree) +
                     0.32 * std::cos((3 * h + 6) * degree) - 0.20 * std::cos((4 * h - 63) * degree);
    const double d_theta = 30 * std::exp(-std::pow((h - 275) / 25, 2));
    const double R_C = 2 * std::sqrt(power7(C) / (power7(C) + power25));
    const double S_L = 1 + 0.015 * (L - 50) * (L - 50) / std::sqrt(20 + (L - 50) * (L - 50));
    const double S_C = 1 + 0.045 * C, S_H = 1 + 0.015 * C * T;
    const double R_T = -std::sin(2 * d_theta * degree) * R_C;
    const double l = dL / S_L, c = dC / S_C, H = dH / S_H;
    return std::sqrt(l * l + c * c + H * H + R_T * c * H);
}

} // namespace lueur
