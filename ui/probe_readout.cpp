#include <fmt/format.h>

#include "core/spectrum/colour.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

void row(const UiState& state, const char* name, const std::string& value) {
    const float start = ImGui::GetCursorPosX();
    ImGui::TextColored(colours::dim, "%s", name);
    ImGui::SameLine(start + 76 * state.scale);
    ImGui::TextUnformatted(value.c_str());
}

std::string three(const glm::dvec3& v) {
    return short_number(v.x) + "   " + short_number(v.y) + "   " + short_number(v.z);
}

} // namespace

std::string plus_minus(const Probe& probe) {
    const double half = probe.interval_factor * static_cast<double>(probe.error);
    if (!(half > 0) || !(probe.irradiance.y > 0)) return {};
    const double percent = 100 * half / probe.irradiance.y;
    return percent < 100 ? fmt::format(" ± {} %", short_number(std::max(percent, 0.01))) : " ± over 100 %";
}

void probe_readout(const Document& document, UiState& state) {
    const auto& scene = document.scene();
    if (!state.hovered || at(state.hovered->object) >= scene.objects.size() ||
        at(state.hovered->material) >= scene.materials.size()) {
        ImGui::TextColored(colours::dim, "Point at a surface to read its light.");
        return;
    }
    const auto& probe = *state.hovered;
    ImGui::PushFont(state.fonts.heading);
    ImGui::Text("%s lx%s", short_number(probe.irradiance.y).c_str(), plus_minus(probe).c_str());
    ImGui::SameLine(0, 16 * state.scale);
    ImGui::Text("%s cd/m²", short_number(probe.radiance.y).c_str());
    ImGui::PopFont();
    ImGui::PushFont(state.fonts.small);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 2 * state.scale});
    auto what = scene.objects[at(probe.object)].name;
    if (probe.luminaire && at(*probe.luminaire) < scene.luminaires.size())
        what += "  (" + scene.luminaires[at(*probe.luminaire)].name + ")";
    row(state, "Object", what);
    row(state, "Material", scene.materials[at(probe.material)].name);
    if (!probe.irradiance_spectrum.nm.empty())
        row(state, "In watts",
            fmt::format("{} W/m²   {} W/(m² sr)", short_number(probe.irradiance_watts),
                        short_number(probe.radiance_watts)));
    row(state, "RGB cd/m²", three(probe.rgb));
    row(state, "XYZ cd/m²", three(probe.radiance));
    const auto xy = chromaticity(probe.radiance);
    row(state, "x  y", fmt::format("{:.4f}   {:.4f}", xy.x, xy.y));
    row(state, "Position m",
        fmt::format("{:.3f}   {:.3f}   {:.3f}", probe.position.x, probe.position.y, probe.position.z));
    if (probe.colour_difference > 0)
        row(state, "From RGB", fmt::format("{:.2f} dE2000", static_cast<double>(probe.colour_difference)));
    row(state, "Unshot", short_number(static_cast<double>(probe.unshot)) + " lm/m²");
    ImGui::PopStyleVar();
    ImGui::PopFont();
}

} // namespace lueur
