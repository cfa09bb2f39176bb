// Everything between radiance and what the monitor is sent. Its numbers are those of core/display.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/display/false_colour.h"
#include "ui/display_rows.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

struct Words {
    const char *name, *tip;
};

Words words_of(ClipRule rule) {
    switch (rule) {
    case ClipRule::clamp:
        return {"Clamp each component",
                "Red, green and blue above the display's range are cut one by one; bright colours may change hue."};
    case ClipRule::keep_chromaticity:
        return {"Keep the chromaticity", "Too bright a colour is darkened until it fits; its hue and saturation stay."};
    case ClipRule::desaturate:
        return {"Keep the luminance", "Too bright a colour is mixed with grey of the same luminance until it fits."};
    case ClipRule::scale_all:
        return {"Scale the whole picture", "The picture is divided by its largest component: nothing is cut."};
    }
    return {"", ""};
}

Words words_of(ToneOperator tone_operator) {
    switch (tone_operator) {
    case ToneOperator::linear:
        return {"Linear", "Luminance / MAXDISPLAY: twice the light is shown twice as bright."};
    case ToneOperator::tumblin_rushmeier:
        return {"Tumblin & Rushmeier 1993",
                "Shows the brightness that an eye adapted to the scene would see. Absolute: MAXDISPLAY plays no part."};
    case ToneOperator::filmic:
        return {"Filmic (Hable 2010)",
                "A grey of 18 % stays where linear has it; highlights roll off up to White, shadows deepen."};
    }
    return {"", ""};
}

template <typename Enum, std::size_t N>
bool combo(UiState& state, const char* id, const std::array<Enum, N>& all, Enum& value) {
    bool changed = false;
    if (ImGui::BeginCombo((std::string("##") + id).c_str(), words_of(value).name)) {
        for (const Enum one : all) {
            if (ImGui::Selectable(words_of(one).name, one == value) && one != value) {
                value = one;
                changed = true;
            }
            tooltip(state, words_of(one).tip);
        }
        ImGui::EndCombo();
    }
    state.layout_log.widget(id);
    return changed;
}

void max_display_rows(UiState& state, DisplayDraft& draft) {
    const char* unused =
        draft.now.tone_operator == ToneOperator::tumblin_rushmeier
            ? "Luminance that is shown as full white, cd/m². This operator is absolute and does not use it."
            : "Luminance that is shown as full white, cd/m². Lower: a brighter picture. Ctrl-click to type.";
    value_row(state, "MAXDISPLAY", unused);
    double value = draft.now.max_display;
    if (log_slider("##max_display", value, 0.1, 100000, value < 10 ? "%.3g cd/m²" : "%.0f cd/m²")) {
        draft.changed.max_display = value;
        draft.changed.max_display_rule = MaxDisplayRule::by_hand; // from now on
        draft.any = true;
    }
    state.layout_log.widget("max_display");
    if (reset_button(state, "max_display", draft.stored.max_display_rule == MaxDisplayRule::by_hand,
                     "Back to what the picture asks for")) {
        draft.changed.max_display_rule = MaxDisplayRule::percentile;
        state.exposure.asked = true;
        draft.any = true;
    }

    value_row(state, "Chosen by");
    int rule = static_cast<int>(draft.stored.max_display_rule);
    if (segmented(
            state, "rule",
            {{"Hand", "The slider above"},
             {"Percent", "So that most of what the camera sees is not cut"},
             {"Lecture", "The lighting engineers' rule: twice the luminance that the floor would have if all light of "
                         "the lamps fell on it, with the scene's mean reflectance"}},
            rule)) {
        draft.changed.max_display_rule = static_cast<MaxDisplayRule>(rule);
        draft.changed.max_display = draft.now.max_display; // by hand goes on from where it was
        draft.any = true;
    }
    if (draft.stored.max_display_rule == MaxDisplayRule::percentile) {
        double percentile = draft.now.percentile;
        if (number_row(state,
                       {"percentile", "Percentile", "Share of the picture that is not cut, with a tenth of headroom.",
                        50, 100, "%.1f %%", false},
                       percentile, DisplaySettings{}.percentile)) {
            draft.changed.percentile = percentile;
            draft.any = true;
        }
    }
    row_label(state, "");
    const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button("Auto now", {half, 0})) {
        state.exposure.asked = true;
        if (draft.stored.max_display_rule == MaxDisplayRule::by_hand) {
            draft.changed.max_display_rule = MaxDisplayRule::percentile;
            draft.any = true;
        }
    }
    state.layout_log.widget("auto_now");
    tooltip(state, "Chooses MAXDISPLAY, and the adaptation, anew for what the camera sees now.");
    ImGui::SameLine();
    bool locked = draft.stored.max_display_locked;
    if (ImGui::Checkbox("Lock", &locked)) {
        draft.changed.max_display_locked = locked;
        if (!locked && draft.stored.max_display_rule == MaxDisplayRule::by_hand)
            draft.changed.max_display_rule = MaxDisplayRule::percentile;
        draft.any = true;
    }
    state.layout_log.widget("lock");
    tooltip(state, "On: an edit never rescales the picture, so that brighter looks brighter. Off: MAXDISPLAY follows "
                   "each solution.");
}

void operator_rows(UiState& state, DisplayDraft& draft) {
    const DisplaySettings usual{};
    value_row(state, "Operator", words_of(draft.now.tone_operator).tip);
    if (combo(state, "operator", all_tone_operators, draft.changed.tone_operator)) draft.any = true;
    switch (draft.now.tone_operator) {
    case ToneOperator::linear:
        return;
    case ToneOperator::tumblin_rushmeier: {
        double adaptation = draft.now.adaptation_luminance, white = draft.now.white_luminance,
               contrast = draft.now.display_contrast;
        value_row(state, "Adapted to",
                  "Luminance the eye is adapted to in the scene, cd/m²; automatic: the picture's geometric mean.");
        if (log_slider("##adaptation", adaptation, 0.01, 10000, "%.3g cd/m²")) {
            draft.changed.adaptation_luminance = adaptation;
            draft.changed.adaptation_automatic = false;
            draft.any = true;
        }
        state.layout_log.widget("adaptation");
        if (reset_button(state, "adaptation", !draft.stored.adaptation_automatic, "Back to automatic")) {
            draft.changed.adaptation_automatic = true;
            draft.any = true;
        }
        if (number_row(state,
                       {"white_luminance", "Display white", "Luminance of the monitor's white, cd/m².", 10, 2000,
                        "%.0f cd/m²"},
                       white, usual.white_luminance)) {
            draft.changed.white_luminance = white;
            draft.any = true;
        }
        if (number_row(state,
                       {"display_contrast", "Its contrast",
                        "White to black of the monitor in its room: 35 in office light, 1000 in the dark.", 5, 10000,
                        "%.0f : 1"},
                       contrast, usual.display_contrast)) {
            draft.changed.display_contrast = contrast;
            draft.any = true;
        }
        return;
    }
    case ToneOperator::filmic: {
        double white = draft.now.filmic_white;
        if (number_row(state,
                       {"filmic_white", "White", "Luminance that is shown as full white, in units of MAXDISPLAY.", 1,
                        50, "%.1f MAXDISPLAY"},
                       white, usual.filmic_white)) {
            draft.changed.filmic_white = white;
            draft.any = true;
        }
        return;
    }
    }
}

void mark_rows(UiState& state, DisplayDraft& draft) {
    state.shares_wanted = true;
    const auto row = [&](const char* id, const char* label, const char* tip, double share, bool& field) {
        row_label(state, label, tip);
        bool mark = field;
        if (ImGui::Checkbox((std::string("Mark##") + id).c_str(), &mark)) {
            field = mark;
            draft.any = true;
        }
        state.layout_log.widget(id);
        ImGui::SameLine();
        const std::string text = share > 0 && share < 0.0005 ? "< 0.1 % of the picture"
                                                             : fmt::format("{:.1f} % of the picture", 100 * share);
        ImGui::TextColored(share > 0 ? colours::text : colours::dim, "%s", text.c_str());
    };
    row("mark_clipped", "Clipped", "Red stripes where a pixel is brighter than the display.", state.shares.clipped,
        draft.changed.mark_clipped);
    row("mark_out_of_gamut", "Out of gamut",
        "Cyan stripes where a colour is more saturated than the primaries can show.", state.shares.out_of_gamut,
        draft.changed.mark_out_of_gamut);
}

void file_rows(UiState& state) {
    row_label(state, "Save picture");
    int bits = state.picture_bits == 16 ? 1 : 0;
    ImGui::SetNextItemWidth(0.55f * ImGui::GetContentRegionAvail().x);
    if (segmented(state, "bits", {{"8 bit", "A channel; PNG, JPEG, TIFF"}, {"16 bit", "A channel; PNG and TIFF"}},
                  bits))
        state.picture_bits = bits == 1 ? 16 : 8;
    ImGui::SameLine();
    if (ImGui::Button("Save as...", {ImGui::GetContentRegionAvail().x, 0}))
        state.commands.push_back(Command::screenshot_as);
    state.layout_log.widget("save_as");
    tooltip(state, ".png .jpg .tif: what you see; .exr .hdr: radiance as linear sRGB in cd/m².");
}

// Steps of luminance from 1/64 of MAXDISPLAY to all of it, a factor of two apart, as they are shown now.
void grey_steps(const DisplaySettings& display, const UiState& state) {
    constexpr int steps = 7;
    const float width = ImGui::GetContentRegionAvail().x / steps, height = 20 * state.scale;
    auto* draw = ImGui::GetWindowDrawList();
    const auto corner = ImGui::GetCursorScreenPos();
    const Xyz white = xyz_from_chromaticity(display.primaries.white, 1);
    const DisplayFunction function = make_display_function(display);
    for (int i = 0; i < steps; ++i) {
        const double luminance = display.max_display * std::exp2(i - steps + 1);
        const auto c = glm::vec3(display_pixel(luminance * white, function));
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
    DisplayDraft draft;
    draft.stored = draft.changed = document.scene().display;
    draft.now = display_in_use(draft.stored, state.exposure);
    if (state.view == ViewMode::luminance || state.view == ViewMode::illuminance) {
        section(state, state.view == ViewMode::luminance ? "False colours: luminance" : "False colours: illuminance");
        false_colour_rows(state, draft);
        section(state, "Colour");
    }
    max_display_rows(state, draft);
    operator_rows(state, draft);
    value_row(state, "Too bright", words_of(draft.now.clip).tip);
    if (combo(state, "clip", all_clip_rules, draft.changed.clip)) draft.any = true;
    monitor_rows(state, draft);
    mark_rows(state, draft);
    file_rows(state);
    ImGui::Dummy({0, 2 * state.scale});
    grey_steps(draft.now, state);
    if (!draft.any) return {};
    return SetDisplay{draft.changed};
}

} // namespace lueur
