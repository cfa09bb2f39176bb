#include "core/solve/wavelengths_choice.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/scene/spectral_content.h"
#include "core/spectrum/wavelengths_plan.h"

namespace lueur {

bool same_spectra(const Scene& a, const Scene& b) {
    return a.materials == b.materials &&
           std::ranges::equal(a.luminaires, b.luminaires, {}, &Luminaire::spectrum, &Luminaire::spectrum);
}

WavelengthsChoice choose_wavelengths(std::shared_ptr<const Scene> scene, const WavelengthsChoice& before) {
    const SolveSettings& solve = scene->solve;
    const bool same_rule = before.scene && before.scene->solve.wavelengths == solve.wavelengths;
    const bool same_settings = same_rule && before.scene->solve.colour_error == solve.colour_error;
    WavelengthsChoice choice = before;
    choice.scene = std::move(scene);
    if (same_settings && same_spectra(*before.scene, *choice.scene)) return choice;
    choice.content = spectral_content(*choice.scene);
    if (same_settings && choice.content == before.content) return choice;
    switch (solve.wavelengths.rule) {
    case WavelengthRule::automatic:
    case WavelengthRule::folded: {
        WavelengthsPlan plan = plan_wavelengths(solve.wavelengths, choice.content, solve.colour_error,
                                                same_rule ? before.wavelengths.get() : nullptr);
        choice.wavelengths = std::make_shared<const Wavelengths>(std::move(plan.wavelengths));
        choice.predicted_error = plan.prediction.worst;
        choice.words = std::move(plan.reason);
        break;
    }
    case WavelengthRule::uniform:
    case WavelengthRule::meyer:
    case WavelengthRule::gauss:
    case WavelengthRule::rgb:
        choice.wavelengths = std::make_shared<const Wavelengths>(make_wavelengths(solve.wavelengths, choice.content));
        choice.predicted_error = -1;
        choice.words = fmt::format("{} channels", choice.wavelengths->size());
        break;
    }
    choice.illuminance_error = wavelength_error(*choice.wavelengths, choice.content);
    return choice;
}

} // namespace lueur
