// The display panel's part about the monitor: its primaries, its curve, and a picture to set gamma by.
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "core/display/calibration.h"
#include "core/display/display_fields.h"
#include "ui/display_rows.h"
#include "ui/widgets.h"

namespace lueur {

namespace {

const char* title_of(std::string_view name) {
    if (name == "srgb") return "sRGB, Rec. 709";
    if (name == "rec2020") return "Rec. 2020";
    if (name == "display_p3") return "Display P3";
    if (name == "lecture") return "The lecture's monitor (Hall)";
    return name.data();
}

bool known(const RgbSpace& space) {
    for (const auto& preset : rgb_spaces)
        if (preset.space == space) return true;
    return false;
}

bool chromaticity_row(UiState& state, const char* name, Chromaticity& c) {
    row_label(state, name, "CIE 1931 x and y. What no display can have is refused with the reason.");
    auto xy = std::array{static_cast<float>(c.x), static_cast<float>(c.y)};
    const bool changed = ImGui::DragFloat2((std::string("##") + name).c_str(), xy.data(), 0.0005f, -0.2f, 1.0f, "%.4f");
    state.layout_log.widget(std::string("primary:") + name);
    if (changed)
        c = {std::round(1e4 * static_cast<double>(xy[0])) / 1e4, std::round(1e4 * static_cast<double>(xy[1])) / 1e4};
    return changed;
}

void primaries_rows(UiState& state, DisplayDraft& draft) {
    const RgbSpace& now = draft.now.primaries;
    const bool own = state.own_primaries || !known(now);
    value_row(state, "Primaries",
              "Chromaticities of the monitor's red, green and blue and of its white. Right when "
              "they are those of the monitor you look at.");
    const char* title = own ? "Own numbers" : title_of(to_string(now));
    for (const auto& preset : rgb_spaces)
        if (!own && preset.space == now) {
            title = title_of(preset.name);
            break;
        }
    if (ImGui::BeginCombo("##primaries", title)) {
        for (const auto& preset : rgb_spaces) {
            if (preset.name == "rec709") continue; // the same primaries as sRGB
            if (ImGui::Selectable(title_of(preset.name), !own && preset.space == now)) {
                draft.changed.primaries = preset.space;
                state.own_primaries = false;
                draft.any = true;
            }
        }
        if (ImGui::Selectable("Own numbers", own)) state.own_primaries = true;
        ImGui::EndCombo();
    }
    state.layout_log.widget("primaries");
    if (reset_button(state, "primaries", !(now == srgb), "Back to sRGB")) {
        draft.changed.primaries = srgb;
        state.own_primaries = false;
        draft.any = true;
    }
    if (!own) return;
    RgbSpace wanted = now;
    bool any = chromaticity_row(state, "Red x, y", wanted.red);
    any |= chromaticity_row(state, "Green x, y", wanted.green);
    any |= chromaticity_row(state, "Blue x, y", wanted.blue);
    any |= chromaticity_row(state, "White x, y", wanted.white);
    if (any && make_rgb_space(wanted)) { // a drag through what no display can have stops at its edge
        draft.changed.primaries = wanted;
        draft.any = true;
    }
}

void gamma_rows(UiState& state, DisplayDraft& draft) {
    const glm::dvec3 now = draft.now.gamma;
    const double usual = DisplaySettings{}.gamma.g;
    const bool each = state.each_gamma || now.r != now.g || now.g != now.b;
    ImGui::BeginDisabled(draft.now.curve != TransferCurve::gamma);
    const auto slider = [&](const char* id, const char* label, double& value) {
        NumberRow row{id,   label, "Shown value = (luminance / MAXDISPLAY)^(1/gamma). Ctrl-click to type 0.1 to 10.",
                      1,    3,     "%.2f",
                      false};
        return number_row(state, row, value, usual);
    };
    if (each) {
        const char* const ids[] = {"gamma:red", "gamma:green", "gamma:blue"};
        const char* const labels[] = {"Gamma, red", "Gamma, green", "Gamma, blue"};
        for (int c = 0; c < 3; ++c) {
            double value = now[c];
            if (slider(ids[c], labels[c], value)) {
                draft.changed.gamma[c] = value;
                draft.any = true;
            }
        }
    } else {
        double value = now.g;
        if (slider("gamma", "Gamma", value)) {
            draft.changed.gamma = glm::dvec3(value);
            draft.any = true;
        }
    }
    ImGui::EndDisabled();
    row_label(state, "");
    bool wanted = each;
    if (ImGui::Checkbox("Each channel", &wanted)) {
        state.each_gamma = wanted;
        if (!wanted && each) {
            draft.changed.gamma = glm::dvec3(now.g);
            draft.any = true;
        }
    }
    state.layout_log.widget("each_gamma");
    tooltip(state, "A gamma of its own for red, green and blue; off: green's for all.");
    ImGui::SameLine();
    const float left = ImGui::GetContentRegionAvail().x;
    if (ImGui::Button(state.calibrating ? "Fold away" : "Calibrate", {left, 0})) state.calibrating = !state.calibrating;
    state.layout_log.widget("calibrate");
    tooltip(state, "A picture to set gamma by eye.");
}

} // namespace

void monitor_rows(UiState& state, DisplayDraft& draft) {
    value_row(state, "Curve");
    int curve = draft.now.curve == TransferCurve::srgb ? 0 : 1;
    if (segmented(state, "curve",
                  {{"sRGB", "IEC 61966-2-1, for monitors that are set to sRGB"}, {"Gamma", "A plain power law"}},
                  curve)) {
        draft.changed.curve = curve == 0 ? TransferCurve::srgb : TransferCurve::gamma;
        draft.any = true;
    }
    gamma_rows(state, draft);
    if (state.calibrating) calibration_rows(state, draft.now);
    primaries_rows(state, draft);
}

// Pixel for pixel: each run of one code along a row is a rectangle.
void calibration_rows(UiState& state, const DisplaySettings& display) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextColored(colours::dim,
                       "Step back, or half close your eyes: where the curve is that of your monitor, each "
                       "plain patch has the brightness of the lines around it.");
    ImGui::PopTextWrapPos();
    auto corner = ImGui::GetCursorScreenPos();
    corner = {std::floor(corner.x), std::floor(corner.y)};
    const int width = std::max(8, static_cast<int>(ImGui::GetContentRegionAvail().x));
    const int height = 4 * static_cast<int>(33 * state.scale);
    const DisplayImage picture = calibration_picture(width, height, display.curve, display.gamma);
    auto* draw = ImGui::GetWindowDrawList();
    for (int y = 0; y < height; ++y) {
        const auto* row = picture.rgb.data() + static_cast<std::ptrdiff_t>(y) * width;
        for (int x = 0; x < width;) {
            int end = x + 1;
            while (end < width && row[end] == row[x]) ++end;
            draw->AddRectFilled({corner.x + static_cast<float>(x), corner.y + static_cast<float>(y)},
                                {corner.x + static_cast<float>(end), corner.y + static_cast<float>(y + 1)},
                                IM_COL32(row[x][0], row[x][1], row[x][2], 255));
            x = end;
        }
    }
    ImGui::Dummy({static_cast<float>(width), static_cast<float>(height)});
    state.layout_log.widget("calibration");
    tooltip(state,
            "Rows: a quarter, a half and three quarters of the light of white. Columns: red, green, blue, grey.");
    if (ImGui::Button("Save the picture..."))
        state.file_request = FileRequest{FilePurpose::save_calibration_picture, {}, {}, {}};
    state.layout_log.widget("save_calibration");
    tooltip(state, "1920 x 1080 pixels, for a screen of its own: to be shown pixel for pixel.");
}

} // namespace lueur
