#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/panels.h"
#include "ui/spectrum_editor.h"
#include "ui/swatch.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

bool contains(const std::string& text, const std::string& part) {
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    };
    return part.empty() || std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

int users(const Scene& scene, MaterialIndex material) {
    return static_cast<int>(std::ranges::count(scene.objects, material, &Object::material));
}

std::string reflectance_text(const Material& material) {
    return fmt::format("{:.2f}", luminous_reflectance(material.reflectance));
}

// One material a row: swatch, name, luminous reflectance.
void material_list(const Scene& scene, UiState& state) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (contains(scene.materials[i].name, state.material_filter)) rows.push_back(i);
    const float row_height = ImGui::GetTextLineHeight() + 8 * state.scale;
    const float wanted = row_height * static_cast<float>(std::clamp<std::size_t>(rows.size(), 2, 7)) + 8 * state.scale;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImVec4(0.125f, 0.125f, 0.125f, 1));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {4 * state.scale, 4 * state.scale});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8 * state.scale, 0});
    ImGui::BeginChild("##materials", {0, wanted}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()), row_height);
    while (clipper.Step()) {
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
            const auto index = rows[static_cast<std::size_t>(row)];
            const auto& material = scene.materials[index];
            ImGui::PushID(row);
            const auto corner = ImGui::GetCursorScreenPos();
            const bool open = state.material && at(*state.material) == index;
            if (ImGui::Selectable("##row", open, 0, {0, row_height})) state.material = MaterialIndex(index);
            state.layout_log.widget("material:" + material.name);
            const float right = ImGui::GetItemRectMax().x;
            auto* draw = ImGui::GetWindowDrawList();
            const auto colour = encoded(linear_rgb(material.reflectance));
            const float edge = row_height - 8 * state.scale;
            const ImVec2 low{corner.x + 4 * state.scale, corner.y + 4 * state.scale};
            draw->AddRectFilled(low, {low.x + edge, low.y + edge}, packed({colour.r, colour.g, colour.b, 1}),
                                3 * state.scale);
            draw->AddRect(low, {low.x + edge, low.y + edge}, IM_COL32(255, 255, 255, 46), 3 * state.scale);
            const float text_y = corner.y + 4 * state.scale;
            const auto figure = reflectance_text(material);
            const float figure_x = right - ImGui::CalcTextSize(figure.c_str()).x - 8 * state.scale;
            ImGui::PushClipRect({corner.x, corner.y}, {figure_x - 8 * state.scale, corner.y + row_height}, true);
            const auto shown = material.name + (material.texture ? "  (texture)" : "");
            draw->AddText({low.x + edge + 9 * state.scale, text_y}, packed(colours::text), shown.c_str());
            ImGui::PopClipRect();
            draw->AddText({figure_x, text_y}, packed(colours::dim), figure.c_str());
            ImGui::PopID();
        }
    }
    clipper.End();
    if (rows.empty()) ImGui::TextDisabled("No material of that name.");
    ImGui::EndChild();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
}

std::optional<Edit> rgb_controls(MaterialIndex index, const Rgb& rgb, UiState& state) {
    std::optional<Edit> edit;
    const auto paint = [&](const Rgb& value) {
        edit = SetReflectance{index, Reflectance(glm::clamp(value, 0.0, 1.0))};
    };
    row_label(
        state, "Colour",
        "As seen under daylight (CIE D65). The picker works in the display's own encoding; the three sliders below "
        "are the linear reflectances that the solver is given.");
    auto shown = encoded(rgb);
    if (ImGui::ColorEdit3("##colour", &shown.x,
                          ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_DisplayHex |
                              ImGuiColorEditFlags_PickerHueWheel))
        paint(decoded(shown));
    state.layout_log.widget("reflectance:picker");
    static constexpr const char* names[] = {"Red", "Green", "Blue"};
    for (int c = 0; c < 3; ++c) {
        row_label(state, names[c], "Linear reflectance of this primary, 0 to 1. Ctrl-click to type.");
        auto value = static_cast<float>(rgb[c]);
        ImGui::PushID(c);
        if (ImGui::SliderFloat("##component", &value, 0, 1, "%.3f", ImGuiSliderFlags_AlwaysClamp)) {
            Rgb changed = rgb;
            changed[c] = value;
            paint(changed);
        }
        ImGui::PopID();
        state.layout_log.widget(std::string("reflectance:") + names[c]);
    }
    return edit;
}

std::optional<Edit> reflectance_controls(const Scene& scene, MaterialIndex index, UiState& state) {
    std::optional<Edit> edit;
    const Material& material = scene.materials[at(index)];
    if (auto changed = reflectance_editor(state, scene, index)) edit = SetReflectance{index, std::move(*changed)};
    if (const auto* number = std::get_if<double>(&material.reflectance)) {
        row_label(state, "Share reflected", "0 is black, 1 reflects everything. Ctrl-click to type.");
        auto value = static_cast<float>(*number);
        if (ImGui::SliderFloat("##number", &value, 0, 1, "%.3f", ImGuiSliderFlags_AlwaysClamp))
            edit = SetReflectance{index, Reflectance(static_cast<double>(value))};
        state.layout_log.widget("reflectance:number");
    } else if (const auto* rgb = std::get_if<Rgb>(&material.reflectance)) {
        if (auto changed = rgb_controls(index, *rgb, state)) edit = changed;
    }
    if (auto drawn = reflectance_plot(state, material.reflectance)) edit = SetReflectance{index, std::move(*drawn)};
    return edit;
}

std::optional<Edit> material_controls(const Scene& scene, MaterialIndex index, UiState& state) {
    std::optional<Edit> edit;
    const auto& material = scene.materials[at(index)];
    section(state, material.name.c_str());
    const int count = users(scene, index);
    ImGui::PushFont(state.fonts.small);
    ImGui::TextColored(colours::dim, "reflects %.1f %% of daylight   used by %d object%s",
                       100 * luminous_reflectance(material.reflectance), count, count == 1 ? "" : "s");
    ImGui::PopFont();
    if (state.selected && at(*state.selected) < scene.objects.size() &&
        scene.objects[at(*state.selected)].material == index && count > 1) {
        const auto text = "Give " + scene.objects[at(*state.selected)].name + " its own paint";
        if (ImGui::Button(text.c_str(), {-1, 0})) edit = GiveOwnMaterial{*state.selected};
        state.layout_log.widget("own_material");
        tooltip(
            state,
            "Copies this material for the selected object alone, so that repainting it leaves the others as they are.");
    }

    ImGui::BeginDisabled(material.texture.has_value());
    if (auto changed = reflectance_controls(scene, index, state)) edit = changed;
    ImGui::EndDisabled();
    if (material.texture) tooltip(state, "The mean of the texture. Take the texture off to paint.");

    row_label(
        state, "Texture",
        "A picture whose texels multiply the light that falls on them. Drop a picture file on a surface to use it.");
    const auto name = material.texture ? material.texture->path : std::string("none");
    const float button = 76 * state.scale;
    const auto edge = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
    ImGui::TextUnformatted(name.c_str());
    if (material.texture) {
        row_label(state, "");
        if (ImGui::Button("Change...", {button, 0}))
            state.file_request = FileRequest{FilePurpose::texture, index, {}, {}};
        ImGui::SameLine();
        if (ImGui::Button("Take off", {button, 0})) edit = SetTexture{index, std::nullopt};
    } else {
        ImGui::SameLine(std::max(edge - button, ImGui::GetCursorPosX()));
        if (ImGui::Button("Choose...", {button, 0}))
            state.file_request = FileRequest{FilePurpose::texture, index, {}, {}};
    }
    row_label(state, "Two-sided", "Off: the back is black and does not reflect.");
    bool two_sided = material.two_sided;
    if (ImGui::Checkbox("##two_sided", &two_sided)) edit = SetTwoSided{index, two_sided};
    state.layout_log.widget("two_sided");
    return edit;
}

} // namespace

std::optional<Edit> materials_panel(const Document& document, const Snapshot&, UiState& state) {
    const auto& scene = document.scene();
    if (scene.materials.empty()) {
        ImGui::TextDisabled("The scene has no materials.");
        return {};
    }
    if (state.material && at(*state.material) >= scene.materials.size()) state.material.reset();
    if (state.material) state.spectrum_target = *state.material;
    const auto list = [&] {
        ImGui::SetNextItemWidth(-1);
        ImGui::InputTextWithHint("##search", "Search materials", &state.material_filter);
        material_list(scene, state);
    };
    if (state.selected && at(*state.selected) < scene.objects.size()) { // what was picked comes first
        const auto& object = scene.objects[at(*state.selected)];
        if (!state.material) state.material = object.material;
        ImGui::TextColored(colours::accent, "%s", object.name.c_str());
        ImGui::SameLine();
        ImGui::TextColored(colours::dim, "%s",
                           object.material == *state.material ? "selected" : "selected, of another material");
        auto edit = material_controls(scene, *state.material, state);
        section(state, "All materials");
        list();
        return edit;
    }
    list();
    if (state.material) return material_controls(scene, *state.material, state);
    ImGui::TextWrapped("Click a surface in the picture, or a material in the list, to repaint it.");
    return {};
}

} // namespace lueur
