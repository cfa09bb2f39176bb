#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/solve/form_factor_matrix.h"
#include "ui/panels.h"
#include "ui/solver_rows.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

constexpr std::array<WavelengthsSpec, 11> offered_wavelengths{{{WavelengthRule::automatic, 0},
                                                               {WavelengthRule::folded, 4},
                                                               {WavelengthRule::folded, 8},
                                                               {WavelengthRule::folded, 12},
                                                               {WavelengthRule::uniform, 16},
                                                               {WavelengthRule::uniform, 31},
                                                               {WavelengthRule::uniform, 81},
                                                               {WavelengthRule::meyer, 4},
                                                               {WavelengthRule::meyer, 10},
                                                               {WavelengthRule::gauss, 10},
                                                               {WavelengthRule::rgb, 3}}};

std::string wavelengths_name(const WavelengthsSpec& spec) {
    switch (spec.rule) {
    case WavelengthRule::automatic:
        return "Automatic";
    case WavelengthRule::folded:
        return fmt::format("{} fitted, lamp folded in", spec.count);
    case WavelengthRule::uniform:
        return fmt::format("{} evenly, {} nm", spec.count, spec.count > 31 ? "380-780" : "400-700");
    case WavelengthRule::meyer:
        return fmt::format("{} after Meyer", spec.count);
    case WavelengthRule::gauss:
        return fmt::format("{} Gauss points", spec.count);
    case WavelengthRule::rgb:
        return "RGB";
    }
    return {};
}

void figure(const UiState& state, const char* name, const std::string& value, const char* tip) {
    ImGui::TableNextColumn();
    ImGui::TextColored(colours::dim, "%s", name);
    tooltip(state, tip);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
}

std::string count(std::uint64_t n) {
    if (n >= 10'000'000) return fmt::format("{:.1f} M", static_cast<double>(n) * 1e-6);
    return whole_number(n);
}

void status_figures(const SolveStatus& status, const UiState& state) {
    ImGui::PushFont(state.fonts.small);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {2 * state.scale, 1 * state.scale});
    if (ImGui::BeginTable("##figures", 4, ImGuiTableFlags_SizingStretchSame)) {
        const bool linked = status.links > 0; // the hierarchical solver has no rows
        if (linked)
            figure(state, "Links", count(status.links), "Between elements and clusters, one way each (L shows them)");
        else
            figure(state, "Receivers", count(status.receivers), "Points that gather indirect light");
        figure(state, "Rays", count(status.rays), "Traced since the mesh was made");
        figure(state, "Elements", count(status.elements), "Triangles that are drawn and interpolated");
        if (linked)
            figure(state, "Leaves", count(status.link_elements),
                   fmt::format("Elements that are cut no further, in levels 0 to {} (V shows them)", status.link_levels)
                       .c_str());
        else
            figure(state, "a receiver", count(status.rays_per_receiver), "Hemisphere rays a receiver");
        figure(state, "Vertices", count(status.vertices), "Of the fine mesh");
        if (linked)
            figure(state, "Rounds", count(status.link_rounds), "Of refinement, with a solution between two");
        else
            figure(state, "Row entries", count(status.row_entries), "Kept: who sees whom, and how much");
        figure(state, "Sweeps", count(status.sweeps), "Over all rows");
        figure(state, "Shots", count(status.shots), "Patches that have shot their light");
        figure(state, "Residual", status.residual > 0 ? fmt::format("{:.1e}", status.residual) : "0",
               "Of the equations, of what is emitted, in the worst channel");
        std::string matrix =
            "Memory of the full matrix of form factors of this scene; taken by the solvers that keep one";
        if (status.form_factor_pairs > 0)
            matrix += fmt::format(". Of {} pairs of patches that face each other {} are outside the region of the "
                                  "method, and {} were missed by its pixels",
                                  count(status.form_factor_pairs), count(status.form_factors_warned),
                                  count(status.form_factors_missed));
        figure(state, "Matrix", bytes_text(status.matrix_bytes), matrix.c_str());
        figure(state, "Emitted", short_number(status.emitted_lumens) + " lm", "By all luminaires");
        figure(state, "Last edit",
               status.last_edit_seconds > 0 ? fmt::format("{:.0f} ms", 1000 * status.last_edit_seconds) : "-",
               "Solve time from the last edit to the first settled picture");
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::PopFont();
}

} // namespace

std::optional<Edit> solver_panel(const Document& document, const Snapshot& snapshot, UiState& state) {
    const auto& stored = document.scene().solve;
    auto solve = state.solve_draft.value_or(stored);
    bool any = false;      // changed for good
    bool dragging = false; // still changing

    any = solver_rows(snapshot, state, solve) || any;
    row_label(state, "");
    const float third = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2 * state.scale, ImGui::GetStyle().FramePadding.y});
    if (ImGui::Button(state.paused ? "Go on" : "Pause", {third, 0})) state.commands.push_back(Command::pause);
    state.layout_log.widget("pause");
    ImGui::SameLine();
    ImGui::BeginDisabled(!state.paused);
    if (ImGui::Button("Step", {third, 0})) state.commands.push_back(Command::step);
    ImGui::EndDisabled();
    state.layout_log.widget("step");
    tooltip(state, "One sweep or one shot, while paused");
    ImGui::SameLine();
    if (ImGui::Button("Restart", {third, 0})) state.commands.push_back(Command::restart);
    state.layout_log.widget("restart");
    tooltip(state, "From black again; the rays are kept");
    ImGui::PopStyleVar();

    row_label(state, "Wavelengths",
              "Channels that the light is computed in. Automatic takes the fewest that keep the predicted colour "
              "difference below the limit. RGB is fast and wrong for lamps with lines.");
    if (ImGui::BeginCombo("##wavelengths", wavelengths_name(solve.wavelengths).c_str())) {
        for (const WavelengthsSpec& spec : offered_wavelengths)
            if (ImGui::Selectable(wavelengths_name(spec).c_str(), solve.wavelengths == spec)) {
                solve.wavelengths = spec;
                any = true;
            }
        ImGui::EndCombo();
    }
    state.layout_log.widget("wavelengths");
    tooltip(state, snapshot.status.wavelengths.c_str());
    if (solve.wavelengths.rule == WavelengthRule::automatic) {
        row_label(state, "Colour error", "Worst colour difference (CIEDE2000) that the wavelengths may be predicted.");
        if (log_slider("##colour_error", solve.colour_error, 0.05, 10, "%.2g dE") && !(solve.colour_error > 0))
            solve.colour_error = stored.colour_error;
        dragging = dragging || ImGui::IsItemActive();
        any = any || ImGui::IsItemDeactivatedAfterEdit();
    }
    if (solve.wavelengths.rule != WavelengthRule::rgb) {
        row_label(state, "Compare RGB",
                  "Solve the lecture's trichromatic approach beside, on the same rays, and see how far apart they are: "
                  "View, Side by side and Colour difference.");
        any = ImGui::Checkbox("##compare", &solve.compare_trichromatic) || any;
        state.layout_log.widget("compare_trichromatic");
    }

    // Applied when the hand lets go: each value on the way would cost rays.
    const auto released = [&] {
        dragging = dragging || ImGui::IsItemActive();
        any = any || ImGui::IsItemDeactivatedAfterEdit();
    };
    row_label(state, "Target error", "Estimated relative RMS error of irradiance at which the solver rests.");
    double percent = 100 * solve.target_error;
    if (log_slider("##target", percent, 0.1, 20, "%.2g %%") && percent > 0) solve.target_error = percent / 100;
    released();
    row_label(state, "Rays at most", "Hemisphere rays of a receiver.");
    static constexpr std::array rays{64, 128, 256, 512, 1024, 2048, 4096};
    if (ImGui::BeginCombo("##rays", fmt::format("{}", solve.max_rays).c_str())) {
        for (const int n : rays)
            if (ImGui::Selectable(fmt::format("{}", n).c_str(), n == solve.max_rays)) {
                solve.max_rays = n;
                any = true;
            }
        ImGui::EndCombo();
    }
    row_label(state, "Element size", "Largest edge of a coarse element in metres; 0: chosen from the scene's area.");
    double size = solve.element_size;
    const double low = 0, high = 1000;
    if (ImGui::DragScalar("##element", ImGuiDataType_Double, &size, static_cast<float>(std::max(0.005, size * 0.01)),
                          &low, &high, size > 0 ? "%.3f m" : "automatic") &&
        size >= 0)
        solve.element_size = size;
    released();

    status_figures(snapshot.status, state);
    state.solve_draft.reset();
    if (dragging && !any) state.solve_draft = solve;
    if (!any || solve == stored) return {};
    return SetSolve{solve};
}

} // namespace lueur
