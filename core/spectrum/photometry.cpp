#include "core/spectrum/photometry.h"

#include <utility>
#include <vector>

#include "core/spectrum/quadrature.h"

namespace lueur {

namespace {

constexpr double scotopic_table[] = {
#include "core/spectrum/scotopic_table.inc"
};

const Spectrum& scotopic_observer() {
    static const Spectrum v = [] {
        Spectrum spectrum;
        for (const double value : scotopic_table) {
            spectrum.nm.push_back(380 + static_cast<double>(spectrum.nm.size()));
            spectrum.value.push_back(value);
        }
        return spectrum;
    }();
    return v;
}

} // namespace

LightQuantity light_quantity(const Spectrum& spectral) {
    const Spectrum& v = scotopic_observer();
    const std::vector<double> points = breakpoints(v.nm.front(), v.nm.back(), {grid(spectral), v.nm});
    return {
        integral(spectral, first_nm(spectral), last_nm(spectral), Outside::zero),
        xyz_from_spectrum(spectral).y,
        scotopic_efficacy_km * integrate<double>(points,
                                                 [&](double nm) {
                                                     return value_at(spectral, nm, Outside::zero) *
                                                            value_at(v, nm, Outside::zero);
                                                 }),
    };
}

double luminous_efficacy(const LightQuantity& light) {
    return light.radiant == 0 ? 0 : light.luminous / light.radiant;
}

double scotopic_ratio(const LightQuantity& light) {
    return light.luminous == 0 ? 0 : light.scotopic / light.luminous;
}

LightKindNames light_kind_names(LightKind kind) {
    switch (kind) {
    case LightKind::flux:
        return {"radiant flux", "W", "luminous flux", "lm"};
    case LightKind::intensity:
        return {"radiant intensity", "W/sr", "luminous intensity", "cd"};
    case LightKind::irradiance:
        return {"irradiance", "W/m²", "illuminance", "lx"};
    case LightKind::exitance:
        return {"radiant exitance", "W/m²", "luminous exitance", "lm/m²"};
    case LightKind::radiance:
        return {"radiance", "W/(sr m²)", "luminance", "cd/m²"};
    }
    std::unreachable();
}

} // namespace lueur
