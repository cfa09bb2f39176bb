#include "ui/false_colour.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "core/transport/mesh.h"
#include "editor/false_colour_range.h"
#include "ui/widgets.h"

namespace lueur {

void fit_scales(FittedScales& fitted, const Snapshot& snapshot, DisplaySettings& display) {
    if (!snapshot.field || !snapshot.mesh) return;
    if (fitted.mesh != snapshot.mesh) {
        fitted.mesh = snapshot.mesh;
        fitted.areas = vertex_areas(*snapshot.mesh);
    }
    if (fitted.field != snapshot.field || !(fitted.luminance == display.luminance_scale) ||
        !(fitted.illuminance == display.illuminance_scale)) {
        fitted.field = snapshot.field;
        fitted.luminance = display.luminance_scale;
        fitted.illuminance = display.illuminance_scale;
        fitted.luminance_now =
            fitted_to(display.luminance_scale, *snapshot.field, fitted.areas, PictureQuantity::luminance);
        fitted.illuminance_now =
            fitted_to(display.illuminance_scale, *snapshot.field, fitted.areas, PictureQuantity::illuminance);
    }
    display.luminance_scale = fitted.luminance_now;
    display.illuminance_scale = fitted.illuminance_now;
}

std::string tick_text(double value) {
    if (value >= 1000 && value < 1e7 && value == std::round(value))
        return whole_number(static_cast<std::uint64_t>(value));
    return fmt::format("{:.4g}", value);
}

void draw_legend(const UiState& state, float left, float bottom, const char* title, const FalseColourSettings& scale) {
    const float unit = state.scale, width = 300 * unit, height = 12 * unit, margin = 12 * unit;
    const float size = state.fonts.small->FontSize, line = size + 4 * unit;
    const float x = left + margin, y = bottom - margin - line - height;
    auto* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled({left, y - line - 6 * unit}, {x + width + margin, bottom}, IM_COL32(20, 20, 20, 222), 5 * unit);
    const auto text_width = [&](const std::string& text) {
        return state.fonts.small->CalcTextSizeA(size, 1e6f, 0, text.c_str()).x;
    };
    const auto write = [&](float at_x, float at_y, const ImVec4& colour, const std::string& text) {
        draw->AddText(state.fonts.small, size, {std::floor(at_x), std::floor(at_y)}, packed(colour), text.c_str());
    };
    write(x, y - line, colours::text, title);
    const std::string kind = scale.logarithmic ? "logarithmic" : "linear";
    write(x + width - text_width(kind), y - line, colours::dim, kind);

    const int steps = static_cast<int>(width);
    for (int i = 0; i < steps; ++i) {
        const auto c = false_colour((i + 0.5) / steps);
        draw->AddRectFilled({x + static_cast<float>(i), y}, {x + static_cast<float>(i + 1), y + height},
                            packed({c.r, c.g, c.b, 1}));
    }
    const auto place = [&](double value) { return x + width * static_cast<float>(place_on_scale(scale, value)); };
    for (const double level : isoline_levels(scale)) {
        if (level < scale.low || level > scale.high) continue;
        const auto c = with_isoline(false_colour(place_on_scale(scale, level)), 1);
        draw->AddLine({place(level), y}, {place(level), y + height}, packed({c.r, c.g, c.b, 1}), 1.5f * unit);
    }
    // A number where there is room for it; the ends of the scale come first.
    const auto ticks = scale_ticks(scale);
    float taken_to = -1e9f;
    const std::string last = ticks.empty() ? "" : tick_text(ticks.back());
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        const std::string text = tick_text(ticks[i]);
        const float own = text_width(text);
        const float from = std::clamp(place(ticks[i]) - 0.5f * own, x, x + width - own);
        const float last_from =
            std::clamp(place(ticks.back()) - 0.5f * text_width(last), x, x + width - text_width(last));
        const bool is_last = i + 1 == ticks.size();
        if (from < taken_to + 8 * unit || (!is_last && from + own + 8 * unit > last_from)) continue;
        draw->AddLine({place(ticks[i]), y + height}, {place(ticks[i]), y + height + 3 * unit}, packed(colours::dim));
        write(from, y + height + 4 * unit, colours::text, text);
        taken_to = from + own;
    }
}

} // namespace lueur
