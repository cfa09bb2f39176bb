// The display panel's part about false colours: range, scale and contours of the quantity that is in view.
#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/display/display_fields.h"
#include "core/display/false_colour.h"
#include "ui/display_rows.h"
#include "ui/false_colour.h"
#include "ui/widgets.h"

namespace lueur {

namespace {

// "100, 200 500" -> levels; nothing where something else stands there.
std::optional<std::vector<double>> levels_from_text(std::string_view text) {
    std::vector<double> levels;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        while (at != end && (*at == ' ' || *at == ',')) ++at;
        if (at == end) break;
        double value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc() || !allowed_scale_end.contains(value)) return {};
        levels.push_back(value);
        at = next;
    }
    if (levels.size() > most_isolines) return {};
    return levels;
}

} // namespace

void false_colour_rows(UiState& state, DisplayDraft& draft) {
    const bool lux = state.view == ViewMode::illuminance;
    const FalseColourSettings& used = lux ? state.scales_in_use.illuminance : state.scales_in_use.luminance;
    FalseColourSettings& stored = lux ? draft.changed.illuminance_scale : draft.changed.luminance_scale;
    const char* unit = lux ? "lx" : "cd/m²";

    value_row(state, "Scale");
    int kind = used.logarithmic ? 0 : 1;
    if (segmented(
            state, "scale",
            {{"Logarithmic", "Equal ratios have equal lengths"}, {"Linear", "Equal differences have equal lengths"}},
            kind)) {
        stored.logarithmic = kind == 0;
        draft.any = true;
    }
    row_label(state, "Range");
    bool automatic = stored.automatic;
    if (ImGui::Checkbox("From the scene", &automatic)) {
        stored.automatic = automatic;
        stored.low = used.low; // by hand goes on from where it was
        stored.high = used.high;
        draft.any = true;
    }
    state.layout_log.widget("range_auto");
    tooltip(state, "Round numbers around all but the extremes of the whole scene, lamps left out.");
    const auto format = fmt::format("%.4g {}", unit);
    double low = used.low, high = used.high;
    ImGui::BeginDisabled(automatic);
    bool moved = number_row(state, {"range_low", "From", "Where the scale begins.", 0.01, 1e5, format.c_str()}, low,
                            automatic ? low : used.low);
    moved |= number_row(state, {"range_high", "To", "Where the scale ends.", 0.01, 1e5, format.c_str()}, high,
                        automatic ? high : used.high);
    ImGui::EndDisabled();
    if (moved && low < high) {
        stored.automatic = false;
        stored.low = low;
        stored.high = high;
        draft.any = true;
    }
    row_label(state, lux ? "Isolux lines" : "Contours");
    bool lines = stored.isolines;
    if (ImGui::Checkbox("##isolines", &lines)) {
        stored.isolines = lines;
        draft.any = true;
    }
    state.layout_log.widget("isolines");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    std::string text = fmt::format("{}", fmt::join(stored.levels, ", "));
    ImGui::BeginDisabled(!stored.isolines);
    if (ImGui::InputTextWithHint("##levels", "the legend's numbers", &text, ImGuiInputTextFlags_EnterReturnsTrue)) {
        if (const auto levels = levels_from_text(text)) {
            stored.levels = *levels;
            draft.any = true;
        } else {
            state.messages.add(Severity::error,
                               fmt::format("Contours: '{}' cannot be read; at most {} numbers of {} are allowed", text,
                                           most_isolines, unit),
                               ImGui::GetTime());
        }
    }
    ImGui::EndDisabled();
    state.layout_log.widget("levels");
    tooltip(state, "Levels, like 100, 200, 500, then Enter; empty: the numbers of the legend.");
}

} // namespace lueur
