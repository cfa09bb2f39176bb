#include "core/display/tone_operator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lueur {

namespace {

constexpr double lamberts_per_candela = std::numbers::pi * 1e-4; // cd m^-2 -> lamberts
constexpr double least_luminance = 1e-36;                        // of MAXDISPLAY: single precision holds no less
constexpr double most_doublings = 100;                           // 1e30 times the display's white

// k with f(k 0.18) / f(k W) = 0.18. The quotient goes from 0.18 / W (less at the toe) to 1 as k grows, and f is
// monotone: bisection on log k.
double exposure_of(double white) {
    constexpr double grey = 0.18;
    double low = -12, high = 12; // log10 k
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high), k = std::pow(10.0, middle);
        (hable_curve(k * grey) / hable_curve(k * white) < grey ? low : high) = middle;
    }
    return std::pow(10.0, 0.5 * (low + high));
}

} // namespace

double tumblin_rushmeier_alpha(double lamberts) {
    return 0.4 * std::log10(lamberts) + 2.92;
}

double tumblin_rushmeier_beta(double lamberts) {
    const double l = std::log10(lamberts);
    return -0.4 * l * l - 2.584 * l + 2.0208;
}

double hable_curve(double x) {
    constexpr double a = 0.15, b = 0.50, c = 0.10, d = 0.20, e = 0.02, f = 0.30;
    // The published difference of two fractions, on one denominator: exact for small x, where it cancels.
    return x * (a * (1 - e / f) * x + b * (c - e / f)) / (x * (a * x + b) + d * f);
}

ToneCurve make_tone_curve(const DisplaySettings& settings) {
    ToneCurve curve;
    curve.tone_operator = settings.tone_operator;
    switch (settings.tone_operator) {
    case ToneOperator::linear:
        break;
    case ToneOperator::tumblin_rushmeier: {
        const double world = settings.adaptation_luminance * lamberts_per_candela;
        const double display = settings.white_luminance / std::sqrt(settings.display_contrast) * lamberts_per_candela;
        const double alpha_w = tumblin_rushmeier_alpha(world), alpha_d = tumblin_rushmeier_alpha(display);
        const double beta_w = tumblin_rushmeier_beta(world), beta_d = tumblin_rushmeier_beta(display);
        curve.exponent = alpha_w / alpha_d;
        const double log10_scale = (beta_w - beta_d) / alpha_d +
                                   curve.exponent * std::log10(settings.max_display * lamberts_per_candela) -
                                   std::log10(settings.white_luminance * lamberts_per_candela);
        curve.log2_scale = log10_scale * std::numbers::ln10 / std::numbers::ln2;
        curve.ambient = 1 / settings.display_contrast;
        break;
    }
    case ToneOperator::filmic:
        curve.white = settings.filmic_white;
        curve.exposure = exposure_of(curve.white);
        curve.divisor = hable_curve(curve.exposure * curve.white);
        break;
    }
    return curve;
}

double shown_luminance(const ToneCurve& curve, double y) {
    switch (curve.tone_operator) {
    case ToneOperator::linear:
        return y;
    case ToneOperator::tumblin_rushmeier: {
        if (!(y > 0)) return 0;
        const double doublings = curve.log2_scale + curve.exponent * std::log2(std::max(y, least_luminance));
        return std::max(std::exp2(std::clamp(doublings, -most_doublings, most_doublings)) - curve.ambient, 0.0);
    }
    case ToneOperator::filmic:
        if (!(y > 0)) return 0;
        return hable_curve(curve.exposure * std::min(y, curve.white)) / curve.divisor;
    }
    return 0;
}

Rgb toned(const ToneCurve& curve, const Rgb& rgb, const glm::dvec3& luminance_weights) {
    if (curve.tone_operator == ToneOperator::linear) return rgb;
    const double y = glm::dot(luminance_weights, rgb);
    if (!(y > 0)) return Rgb(0);
    return rgb * (shown_luminance(curve, y) / std::max(y, least_luminance));
}

} // namespace lueur
