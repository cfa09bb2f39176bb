// Choosing and making the spectrum of a light or of a paint, in the panels.
#pragma once

#include <optional>

#include "core/scene/scene.h"
#include "ui/ui_state.h"

namespace lueur {

// What the user made of it, while he makes it. Another file is asked for in state.file_request.
std::optional<EmissionSpectrum> emission_editor(UiState& state, const Scene& scene, LuminaireIndex luminaire);
std::optional<Reflectance> reflectance_editor(UiState& state, const Scene& scene, MaterialIndex material);

// The curve of a reflectance that is not drawn by hand, and the button that makes it so.
std::optional<Reflectance> reflectance_plot(UiState& state, const Reflectance& reflectance);

} // namespace lueur
