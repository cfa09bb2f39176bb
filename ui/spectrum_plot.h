// Curves of spectra: in a panel, in a list, and as one that is drawn by hand.
#pragma once

#include <optional>

#include <imgui.h>

#include "core/spectrum/spectrum.h"
#include "ui/ui_state.h"

namespace lueur {

// A light ends with its grid and has no unit; a reflectance goes on and is 0..1.
enum class CurveKind { light, reflectance };

// A curve over 380..780 nm, and over what it has beside that within 300..830 nm, filled with the colours of the
// wavelengths.
void spectrum_plot(UiState& state, const char* id, const Spectrum& spectrum, CurveKind kind);

// The same with points that can be dragged, added by a click and taken away by a right click or Delete; Escape takes a
// drag back. The changed curve while it changes.
std::optional<Spectrum> curve_editor(UiState& state, const char* id, const Spectrum& spectrum, CurveKind kind);

// Filled with its colours, without axes.
void spectrum_thumbnail(ImDrawList& draw, const ImVec2& low, const ImVec2& high, const Spectrum& spectrum,
                        CurveKind kind);

// Few points whose curve is near the spectrum's within 380..780 nm (Ramer 1972; Douglas & Peucker 1973), a light's
// largest value 1: something to draw on.
Spectrum points_near(const Spectrum& spectrum, CurveKind kind);

} // namespace lueur
