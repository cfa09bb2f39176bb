#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/scene/luminaire.h"
#include "ui/panels.h"
#include "ui/spectrum_editor.h"
#include "ui/swatch.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

std::string unit_text(PowerUnit unit) {
    switch (unit) {
    case PowerUnit::lumen:
        return "lm";
    case PowerUnit::watt:
        return "W";
    case PowerUnit::exitance:
        return "W/m²";
    case PowerUnit::radiance:
        return "W/m²sr";
    }
    return {};
}

// The power in another unit that gives the same light: dimmer and spectrum stay.
std::optional<double> converted_power(const Scene& scene, LuminaireIndex index, PowerUnit unit) {
    Scene trial = scene;
    auto& luminaire = trial.luminaires[at(index)];
    if (luminaire.dimmer <= 0) luminaire.dimmer = 1;
    const double before = luminous_flux(trial, luminaire);
    luminaire.unit = unit;
    luminaire.power = 1;
    const double of_one = luminous_flux(trial, luminaire);
    if (!(of_one > 0) || !std::isfinite(before)) return {};
    return before / of_one;
}

std::optional<Edit> luminaire_controls(const Scene& scene, LuminaireIndex index, UiState& state) {
    std::optional<Edit> edit;
    const auto& luminaire = scene.luminaires[at(index)];
    const double lumens = luminous_flux(scene, luminaire), watts = radiant_flux(scene, luminaire);
    ImGui::TextColored(colours::dim, "%s lm   %s W   %s lm/W", short_number(lumens).c_str(),
                       short_number(watts).c_str(), watts > 0 ? short_number(lumens / watts).c_str() : "-");
    tooltip(state,
            "Light given now, dimmer included. Watts are radiated watts; lm/W is the efficacy of the radiation.");

    row_label(state, "Power",
              "At 100 % of the dimmer. lm and W count the whole luminaire; W/m² each square metre that emits.");
    const float unit_width = 84 * state.scale;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - unit_width - ImGui::GetStyle().ItemInnerSpacing.x);
    double power = luminaire.power;
    const double nothing = 0, speed_scale = std::max(std::abs(power), 1e-3) * 0.005;
    if (ImGui::DragScalar("##power", ImGuiDataType_Double, &power, static_cast<float>(speed_scale), &nothing, nullptr,
                          "%.5g") &&
        power >= 0 && std::isfinite(power))
        edit = SetPower{index, luminaire.unit, power};
    state.layout_log.widget("power:" + luminaire.name);
    tooltip(state, "Drag, or double-click to type.");
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::SetNextItemWidth(unit_width);
    if (ImGui::BeginCombo("##unit", unit_text(luminaire.unit).c_str())) {
        for (const auto unit : {PowerUnit::lumen, PowerUnit::watt, PowerUnit::exitance, PowerUnit::radiance})
            if (ImGui::Selectable(unit_text(unit).c_str(), unit == luminaire.unit) && unit != luminaire.unit)
                if (const auto same_light = converted_power(scene, index, unit))
                    edit = SetPower{index, unit, *same_light};
        ImGui::EndCombo();
    }
    if (auto changed = emission_editor(state, scene, index)) edit = SetEmissionSpectrum{index, std::move(*changed)};

    row_label(state, "Emits from");
    int side = static_cast<int>(luminaire.side);
    if (segmented(state, "emit_side", {{"Front", ""}, {"Back", ""}, {"Both", "The power is shared by both sides"}},
                  side))
        edit = SetEmitSide{index, static_cast<EmitSide>(side)};
    if (ImGui::Button("Select its surface", {-1, 0}) && !luminaire.objects.empty())
        state.selected = luminaire.objects.front();
    return edit;
}

// Dims all luminaires by one factor. While it is dragged the solver sees a preview; letting go makes it one step of
// undo.
std::optional<Edit> master_dimmer(const Scene& scene, UiState& state) {
    row_label(state, "All", "Dims every luminaire by the same factor. Let go to keep it.");
    float percent = 100 * state.master;
    ImGui::SliderFloat("##all", &percent, 0, 200, "%.0f %%", ImGuiSliderFlags_AlwaysClamp);
    state.layout_log.widget("dimmer:*");
    const bool active = ImGui::IsItemActive(), done = ImGui::IsItemDeactivatedAfterEdit();
    if (active && percent != 100 * state.master) {
        state.master = percent / 100;
        state.preview = scene;
        for (auto& luminaire : state.preview->luminaires) luminaire.dimmer *= static_cast<double>(state.master);
    }
    std::optional<Edit> edit;
    if (done && percent != 100) {
        Scene changed = scene;
        for (auto& luminaire : changed.luminaires) luminaire.dimmer *= static_cast<double>(percent / 100);
        edit = ReplaceScene{std::move(changed)};
    }
    if (!active) {
        state.master = 1;
        state.preview.reset();
    }
    return edit;
}

bool small_toggle(const char* id, const char* text, bool down, const ImVec4& colour, float width) {
    ImGui::PushID(id);
    ImGui::PushStyleColor(ImGuiCol_Button, down ? colour : colours::frame);
    ImGui::PushStyleColor(ImGuiCol_Text, down ? ImVec4(0.08f, 0.08f, 0.08f, 1) : colours::dim);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, ImGui::GetStyle().FramePadding.y});
    const bool pressed = ImGui::Button(text, {width, 0});
    ImGui::PopStyleVar();
    ImGui::PopStyleColor(2);
    ImGui::PopID();
    return pressed;
}

// All others dark, or back as they were when this one is alone already.
Edit solo(const Scene& scene, std::size_t alone, UiState& state) {
    Scene changed = scene;
    bool is_alone = true;
    for (std::size_t i = 0; i < scene.luminaires.size(); ++i)
        is_alone = is_alone && (i == alone || scene.luminaires[i].dimmer == 0);
    for (std::size_t i = 0; i < changed.luminaires.size(); ++i) {
        auto& dimmer = changed.luminaires[i].dimmer;
        const bool dark = i != alone && !is_alone;
        if (dark && dimmer > 0) {
            state.muted[i] = dimmer;
            dimmer = 0;
        } else if (!dark && dimmer == 0 && state.muted.contains(i)) {
            dimmer = state.muted[i];
            state.muted.erase(i);
        }
    }
    return ReplaceScene{std::move(changed)};
}

std::optional<Edit> luminaire_row(const Scene& scene, std::size_t i, UiState& state) {
    std::optional<Edit> edit;
    const auto& luminaire = scene.luminaires[i];
    const LuminaireIndex index{static_cast<std::uint32_t>(i)};
    const bool open = state.luminaire && at(*state.luminaire) == i;
    const float scale = state.scale, height = ImGui::GetFrameHeight();

    // Name, dimmer, mute and solo in a row; a click on the name unfolds the rest.
    const auto corner = ImGui::GetCursorScreenPos();
    const float small = 24 * scale, gap = 3 * scale, name_width = 112 * scale;
    if (ImGui::Selectable("##name", open, ImGuiSelectableFlags_AllowItemOverlap, {name_width, height}))
        state.luminaire = open ? std::nullopt : std::optional(index);
    state.layout_log.widget("luminaire:" + luminaire.name);
    auto* draw = ImGui::GetWindowDrawList();
    const auto light = encoded(linear_rgb(luminaire.spectrum) * std::clamp(0.15 + 0.85 * luminaire.dimmer, 0.0, 1.0));
    const ImVec2 centre{corner.x + 12 * scale, corner.y + 0.5f * height};
    draw->AddCircleFilled(centre, 6.5f * scale, packed({light.r, light.g, light.b, 1}));
    draw->AddCircle(centre, 6.5f * scale, IM_COL32(255, 255, 255, 60));
    draw->PushClipRect(corner, {corner.x + name_width - 4 * scale, corner.y + height}, true);
    const ImVec2 text_place{corner.x + 28 * scale, corner.y + 0.5f * (height - ImGui::GetTextLineHeight())};
    draw->AddText(open ? state.fonts.heading : state.fonts.regular, ImGui::GetFontSize(), text_place,
                  packed(colours::text), luminaire.name.c_str());
    draw->PopClipRect();
    if (ImGui::CalcTextSize(luminaire.name.c_str()).x > name_width - 32 * scale) tooltip(state, luminaire.name.c_str());
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 2 * (small + gap));
    auto percent = static_cast<float>(100 * luminaire.dimmer);
    if (ImGui::SliderFloat("##dimmer", &percent, 0, 100, "%.1f %%") && percent >= 0)
        edit = SetDimmer{index, static_cast<double>(percent) / 100};
    state.layout_log.widget("dimmer:" + luminaire.name);
    tooltip(state, "Dimmer. Ctrl-click to type; more than 100 % is allowed there.");
    const bool dark = luminaire.dimmer == 0;
    ImGui::SameLine(0, gap);
    if (small_toggle("mute", "M", dark, colours::dim, small)) {
        if (!dark) {
            state.muted[i] = luminaire.dimmer;
            edit = SetDimmer{index, 0};
        } else {
            edit = SetDimmer{index, state.muted.contains(i) ? state.muted[i] : 1.0};
            state.muted.erase(i);
        }
    }
    state.layout_log.widget("mute:" + luminaire.name);
    tooltip(state, "Mute: off, and back to where it was");
    ImGui::SameLine(0, gap);
    const bool alone = !dark && scene.luminaires.size() > 1 &&
                       std::ranges::count_if(scene.luminaires, [](const Luminaire& l) { return l.dimmer > 0; }) == 1;
    ImGui::BeginDisabled(scene.luminaires.size() < 2);
    if (small_toggle("solo", "S", alone, colours::accent, small)) edit = solo(scene, i, state);
    ImGui::EndDisabled();
    tooltip(state, "Solo: all others off, and back");

    if (open) {
        if (auto changed = luminaire_controls(scene, index, state)) edit = changed;
        ImGui::Dummy({0, 4 * scale});
    }
    return edit;
}

} // namespace

std::optional<Edit> luminaires_panel(const Document& document, const Snapshot&, UiState& state) {
    const auto& scene = document.scene();
    if (scene.luminaires.empty()) {
        ImGui::TextWrapped("The scene has no luminaires: nothing in it gives light.");
        return {};
    }
    if (state.luminaire && at(*state.luminaire) >= scene.luminaires.size()) state.luminaire.reset();
    if (state.luminaire) state.spectrum_target = *state.luminaire;
    std::optional<Edit> edit;
    if (scene.luminaires.size() > 1) {
        edit = master_dimmer(scene, state);
        if (scene.luminaires.size() > 8) {
            ImGui::SetNextItemWidth(-1);
            ImGui::InputTextWithHint("##search", "Search luminaires", &state.luminaire_filter);
        }
        ImGui::Separator();
    }
    for (std::size_t i = 0; i < scene.luminaires.size(); ++i) {
        if (!state.luminaire_filter.empty() &&
            scene.luminaires[i].name.find(state.luminaire_filter) == std::string::npos)
            continue;
        ImGui::PushID(static_cast<int>(i));
        if (auto changed = luminaire_row(scene, i, state)) edit = changed;
        ImGui::PopID();
    }
    return edit;
}

} // namespace lueur
