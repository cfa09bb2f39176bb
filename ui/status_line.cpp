#include <fmt/format.h>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace lueur {

void status_line(const Document& document, const Snapshot& snapshot, UiState& state) {
    const auto& status = snapshot.status;
    ImVec4 colour = colours::accent;
    std::string text;
    if (status.stage == SolveStage::failed) {
        colour = colours::error;
        text = "Failed: " + status.message;
    } else if (state.paused && !status.settled) {
        colour = colours::warning;
        text = "Paused";
    } else if (status.settled) {
        colour = ImVec4(0.50f, 0.74f, 0.52f, 1);
        text = fmt::format("Settled in {} s", short_number(status.seconds));
    } else
        text = to_string(status.stage);
    if (status.estimated_error > 0 && status.estimated_error < 1)
        text += fmt::format("  ·  error {:.2g} %", 100 * status.estimated_error);
    if (state.hovered)
        text += fmt::format("  ·  {} lx{}", short_number(state.hovered->irradiance.y), plus_minus(*state.hovered));
    const float scale = state.scale, height = ImGui::GetTextLineHeight();
    auto* draw = ImGui::GetWindowDrawList();
    const auto corner = ImGui::GetCursorScreenPos();
    draw->AddCircleFilled({corner.x + 5 * scale, corner.y + 0.5f * height}, 4 * scale, packed(colour));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 16 * scale);
    ImGui::TextUnformatted(text.c_str());
    if (!status.settled && status.stage != SolveStage::failed && status.progress > 0 && status.progress < 1) {
        ImGui::SameLine();
        const auto place = ImGui::GetCursorScreenPos();
        const float width = 90 * scale, y = place.y + 0.5f * height - 2 * scale;
        draw->AddRectFilled({place.x, y}, {place.x + width, y + 4 * scale}, packed(colours::frame), 2 * scale);
        draw->AddRectFilled({place.x, y}, {place.x + width * static_cast<float>(status.progress), y + 4 * scale},
                            packed(colours::accent), 2 * scale);
        ImGui::Dummy({width, height});
    }
    if (!status.message.empty() && status.stage != SolveStage::failed) {
        ImGui::SameLine(0, 18 * scale);
        ImGui::TextColored(colours::warning, "%s", status.message.c_str());
        tooltip(state, status.message.c_str());
    }
    const auto& scene = document.scene();
    const auto lamps = scene.luminaires.size();
    const auto right = fmt::format("{}  ·  {} triangles  ·  {} luminaire{}",
                                   scene.name.empty() ? document.file().filename().string() : scene.name,
                                   whole_number(scene.geometry->triangles.size()), lamps, lamps == 1 ? "" : "s");
    const float x = ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(right.c_str()).x;
    ImGui::SameLine();
    if (ImGui::GetCursorPosX() + 10 * scale < x) {
        ImGui::SetCursorPosX(x);
        ImGui::TextColored(colours::dim, "%s", right.c_str());
    } else
        ImGui::NewLine();
}

} // namespace lueur
