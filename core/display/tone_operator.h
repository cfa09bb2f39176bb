// From the luminance of the scene to the luminance of the display. An operator changes the luminance of a colour and
// keeps its chromaticity; each is monotone in luminance and finite for whatever comes in.
//
// linear             n = L / MAXDISPLAY.
//
// tumblin_rushmeier  Tumblin & Rushmeier 1993, "Tone Reproduction for Realistic Images", IEEE Computer Graphics and
//                    Applications 13(6), 42-48. The display is to evoke the brightness B (in brils; Stevens & Stevens
//                    1963) that the scene would, for an eye adapted to L_a there and to L_da at the display, all
//                    luminances in lamberts (1 lambert = 10^4/pi cd m^-2):
//                        B = 10^beta(L_a) L^alpha(L_a)
//                        alpha(L_a) = 0.4 log10(L_a) + 2.92
//                        beta(L_a)  = -0.4 (log10 L_a)^2 - 2.584 log10(L_a) + 2.0208
//                    Equal brightness gives L_d = 10^((beta_w - beta_d) / alpha_d) L^(alpha_w / alpha_d), and what is
//                    sent to the display is n = L_d / L_dmax - 1 / C_max: its contrast C_max in its room says how much
//                    light it always gives. L_da = L_dmax / sqrt(C_max), the geometric middle of the display's range;
//                    its counterpart in the scene, the geometric mean luminance of the picture, is the automatic L_a
//                    (the paper counts 0.84 decades more, for the scene's white; with the middle of the display's range
//                    on the other side that would show the mean as black). MAXDISPLAY plays no part: the luminances are
//                    absolute.
//
// filmic             Hable 2010, "Uncharted 2: HDR Lighting", Game Developers Conference: the curve
//                        f(x) = ((x (A x + C B) + D E) / (x (A x + B) + D F)) - E / F
//                        A 0.15, B 0.50, C 0.10, D 0.20, E 0.02, F 0.30 (shoulder, linear, angle, toe)
//                    f(k L) / f(k W), white at W = filmic_white * MAXDISPLAY and k such that 18 % grey stays where the
//                    linear operator has it. Of the filmic curves in use it is the one that is published with the
//                    meaning of each constant and with a white of one's own; Narkowicz' ACES fit of 2015 reaches white
//                    at a place of its own, and AgX is a table. Applied to the luminance, so that hues stay.
#pragma once

#include "core/display/display_settings.h"

namespace lueur {

// The settings of the operator, worked out for many pixels. The window's shader takes the same numbers.
struct ToneCurve {
    ToneOperator tone_operator = ToneOperator::linear;
    // tumblin_rushmeier, y = L / MAXDISPLAY: n = 2^(log2_scale + exponent log2 y) - ambient
    double log2_scale = 0, exponent = 1, ambient = 0;
    // filmic: n = f(exposure min(y, white)) / f(exposure white)
    double exposure = 1, white = 1, divisor = 1;
};
ToneCurve make_tone_curve(const DisplaySettings& settings);

// L / MAXDISPLAY -> share of the display's white; may be above 1. Nothing for luminances of 0 and less.
double shown_luminance(const ToneCurve& curve, double y);

// The same for a colour; luminance of 0 and less gives black, but with the linear operator.
Rgb toned(const ToneCurve& curve, const Rgb& rgb, const glm::dvec3& luminance_weights);

double tumblin_rushmeier_alpha(double lamberts);
double tumblin_rushmeier_beta(double lamberts);
double hable_curve(double x);

} // namespace lueur
