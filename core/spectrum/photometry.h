// A radiometric quantity and its luminous twin: the same light counted in watts and as the eye sees it.
#pragma once

#include <string_view>

#include "core/spectrum/observer.h"

namespace lueur {

// lm/W at the peak of the scotopic V' of 1951, 507 nm (CIE 018:2019; the photopic 683 is luminous_efficacy_km).
inline constexpr double scotopic_efficacy_km = 1700.0;

// Integrals of one spectral quantity, whose unit per nm decides theirs.
struct LightQuantity {
    double radiant = 0;  // over the whole of the spectrum's own grid, UV and IR too
    double luminous = 0; // 683 lm/W * V
    double scotopic = 0; // 1700 lm/W * V', dark-adapted eye
};
LightQuantity light_quantity(const Spectrum& spectral);

// Luminous efficacy of the radiation, lm/W; 0 of no light.
double luminous_efficacy(const LightQuantity& light);
// Scotopic over photopic ("S/P ratio"); 0 of no light.
double scotopic_ratio(const LightQuantity& light);

enum class LightKind { flux, intensity, irradiance, exitance, radiance };

struct LightKindNames {
    std::string_view radiant, radiant_unit, luminous, luminous_unit;
};
LightKindNames light_kind_names(LightKind kind);

} // namespace lueur
