#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

const char* name_of(ClipRule rule) {
    switch (rule) {
    case ClipRule::clamp:
        return "Clamp each component";
    case ClipRule::keep_chromaticity:
        return "Keep the chromaticity";
    case ClipRule::desaturate:
        return "Keep the luminance";
    case ClipRule::scale_all:
        return "Scale the whole picture";
    }
    return "";
}

const char* explanation(ClipRule rule) {
    switch (rule) {
    case ClipRule::clamp:
        return "Red, green and blue above MAXDISPLAY are cut one by one; bright colours may change hue.";
    case ClipRule::keep_chromaticity:
        return "Too bright a colour is darkened until it fits; its hue and saturation stay.";
    case ClipRule::desaturate:
        return "Too bright a colour is mixed with grey of the same luminance until it fits.";
    case ClipRule::scale_all:
        return "MAXDISPLAY is raised to the largest component in the picture: nothing is cut.";
    }
    return "";
}

// Steps of luminance from 1/64 of MAXDISPLAY to all of it, a factor of two apart, as they are shown now.
void grey_steps(const DisplaySettings& display, const UiState& state) {
    constexpr int steps = 7;
    const float width = ImGui::GetContentRegionAvail().x / steps, height = 20 * state.scale;
    auto* draw = ImGui::GetWindowDrawList();
    const auto corner = ImGui::GetCursorScreenPos();
    for (int i = 0; i < steps; ++i) {
        const double luminance = display.max_display * std::exp2(i - steps + 1);
        const Xyz white = luminance * Xyz(0.9505, 1.0, 1.0890); // D65
        const auto c = glm::vec3(display_pixel(white, display));
        const float x = corner.x + static_cast<float>(i) * width;
        draw->AddRectFilled({x, corner.y}, {x + width, corner.y + height}, packed({c.r, c.g, c.b, 1}));
        const auto text = short_number(luminance);
        const auto size = state.fonts.small->CalcTextSizeA(state.fonts.small->FontSize, 1e6f, 0, text.c_str());
        draw->AddText(state.fonts.small, state.fonts.small->FontSize,
                      {x + 0.5f * (width - size.x), corner.y + height + 2 * state.scale}, packed(colours::dim),
                      text.c_str());
    }
    ImGui::Dummy({width * steps, height + state.fonts.small->FontSize + 3 * state.scale});
    tooltip(state, "Grey of these luminances, cd/m², as it is shown now.");
}

} // namespace

std::optional<Edit> display_panel(const Document& document, const Snapshot&, UiState& state) {
    const auto& stored = document.scene().display;
    auto display = display_in_use(stored, state.exposure);
    auto changed = stored;
    bool any = false;

    row_label(state, "MAXDISPLAY", "Luminance that is shown as full white, cd/m². Lower: a brighter picture.");
    double value = display.max_display;
    if (log_slider("##max_display", value, 0.1, 100000, value < 10 ? "%.2f cd/m²" : "%.0f cd/m²") && value > 0) {
        changed.max_display = value;
        changed.max_display_auto = false; // set by hand from now on
        any = true;
    }
    state.layout_log.widget("max_display");

    row_label(state, "");
    const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button("Auto now", {half, 0})) {
        state.exposure.asked = true;
        if (!stored.max_display_auto) {
            changed.max_display_auto = true;
            any = true;
        }
    }
    state.layout_log.widget("auto_now");
    tooltip(state, "Chooses MAXDISPLAY so that 98 % of what the camera sees now is shown unclipped.");
    ImGui::SameLine();
    bool locked = stored.max_display_locked;
    if (ImGui::Checkbox("Lock", &locked)) {
        changed.max_display_locked = locked;
        if (!locked) changed.max_display_auto = true;
        any = true;
    }
    state.layout_log.widget("lock");
    tooltip(state, "On: an edit never rescales the picture, so that brighter looks brighter. Off: MAXDISPLAY follows "
                   "each solution.");

    row_label(state, "Curve");
    int curve = display.curve == TransferCurve::srgb ? 0 : 1;
    if (segmented(state, "curve",
                  {{"sRGB", "IEC 61966-2-1, for monitors that are set to sRGB"}, {"Gamma", "A plain power law"}},
                  curve)) {
        changed.curve = curve == 0 ? TransferCurve::srgb : TransferCurve::gamma;
        any = true;
    }
    row_label(state, "Gamma", "Shown value = (luminance / MAXDISPLAY)^(1/gamma). Ctrl-click to type 0.1 to 10.");
    ImGui::BeginDisabled(display.curve != TransferCurve::gamma);
    auto gamma = static_cast<float>(display.gamma);
    if (ImGui::SliderFloat("##gamma", &gamma, 1, 3, "%.2f") && gamma >= 0.1f && gamma <= 10) {
        changed.gamma = static_cast<double>(gamma);
        any = true;
    }
    ImGui::EndDisabled();
    state.layout_log.widget("gamma");

    row_label(state, "Too bright", explanation(display.clip));
    if (ImGui::BeginCombo("##clip", name_of(display.clip))) {
        for (const auto rule :
             {ClipRule::clamp, ClipRule::keep_chromaticity, ClipRule::desaturate, ClipRule::scale_all}) {
            if (ImGui::Selectable(name_of(rule), rule == display.clip)) {
                changed.clip = rule;
                any = true;
            }
            tooltip(state, explanation(rule));
        }
        ImGui::EndCombo();
    }
    state.layout_log.widget("clip");
    ImGui::Dummy({0, 2 * state.scale});
    grey_steps(display, state);
    if (!any) return {};
    return SetDisplay{changed};
}

} // namespace lueur
