// Unshot flux and estimated error against solve time, on a logarithmic axis with a line at each decade; under them, as
// thin lines, the unshot flux of the solvers that ran before on this scene.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "ui/panels.h"
#include "ui/solver_rows.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

std::string decade_text(int exponent) {
    if (exponent >= 0) return "100 %";
    const double percent = std::pow(10.0, exponent + 2);
    return percent >= 1 ? fmt::format("{:.0f} %", percent) : fmt::format("{:.{}f} %", percent, -exponent - 2);
}

double nice_step(double span, int most) {
    const double raw = std::max(span, 1e-9) / most, base = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (raw <= factor * base) return factor * base;
    return 10 * base;
}

std::string time_text(double seconds, double step) {
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 4);
    return fmt::format("{:.{}f}", seconds, decimals);
}

const ImVec4& past_colour(std::size_t number) {
    static const ImVec4 all[] = {{0.56f, 0.80f, 0.47f, 1}, {0.80f, 0.55f, 0.82f, 1}, {0.45f, 0.62f, 0.95f, 1},
                                 {0.90f, 0.80f, 0.45f, 1}, {0.92f, 0.52f, 0.50f, 1}, {0.45f, 0.80f, 0.78f, 1}};
    return all[number % std::size(all)];
}

std::string percent_text(double share) {
    return short_number(100 * share) + " %";
}

} // namespace

void convergence_plot(const Snapshot& snapshot, double target_error, UiState& state, float width, float height) {
    const float scale = state.scale, line = state.fonts.small->FontSize;
    const auto corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##convergence", {std::max(width, 1.0f), std::max(height, 1.0f)});
    ImGui::SetItemAllowOverlap(); // by Clear
    const bool hovered = ImGui::IsItemHovered();
    auto* draw = ImGui::GetWindowDrawList();
    const auto text = [&](float x, float y, const ImVec4& colour, const std::string& words) {
        draw->AddText(state.fonts.small, line, {std::floor(x), std::floor(y)}, packed(colour), words.c_str());
    };
    const auto text_width = [&](const std::string& words) {
        return state.fonts.small->CalcTextSizeA(line, 1e6f, 0, words.c_str()).x;
    };

    const ImVec2 low{corner.x + 48 * scale, corner.y + line + 8 * scale};
    const ImVec2 high{corner.x + width - 10 * scale, corner.y + height - line - 5 * scale};
    if (high.x - low.x < 60 * scale || high.y - low.y < 24 * scale) return;
    draw->AddRectFilled(low, high, packed(colours::backdrop), 3 * scale);

    ConvergenceRuns& past = state.convergence_runs;
    past.note(snapshot);
    const std::string present = snapshot.scene ? solver_label(snapshot.scene->solve) : std::string();
    const auto& history = snapshot.history;
    const auto& status = snapshot.status;
    double smallest = std::min(target_error, 1.0);
    double last = 0;
    for (const auto& point : history) {
        if (point.unshot_share > 0) smallest = std::min(smallest, point.unshot_share);
        if (point.error > 0) smallest = std::min(smallest, point.error);
        last = std::max(last, point.seconds);
    }
    for (const ConvergenceRun& run : past.runs) last = std::max(last, run.history.back().seconds);
    const int bottom = std::clamp(static_cast<int>(std::floor(std::log10(std::max(smallest, 1e-6)))), -6, -2);
    const auto y_of = [&](double share) {
        const double decade = std::clamp(std::log10(std::max(share, 1e-9)), static_cast<double>(bottom), 0.0);
        return high.y - static_cast<float>((decade - bottom) / -bottom) * (high.y - low.y - 2 * scale);
    };
    const double step = nice_step(std::max(last, 0.01), static_cast<int>((high.x - low.x) / (72 * scale)));
    const double end = std::max(last * 1.02, 0.01);
    const auto x_of = [&](double seconds) { return low.x + static_cast<float>(seconds / end) * (high.x - low.x); };

    const float decade_height = (high.y - low.y) / static_cast<float>(-bottom);
    const int label_each = decade_height < line ? 2 : 1;
    for (int exponent = 0; exponent >= bottom; --exponent) {
        const float y = std::floor(y_of(std::pow(10.0, exponent)));
        draw->AddLine({low.x, y}, {high.x, y}, packed(colours::line, 0.9f));
        if (-exponent % label_each == 0) {
            const auto words = decade_text(exponent);
            text(low.x - 6 * scale - text_width(words), y - 0.55f * line, colours::dim, words);
        }
    }
    for (double t = 0; t <= end; t += step) {
        const float x = std::floor(x_of(t));
        if (t > 0) draw->AddLine({x, low.y}, {x, high.y}, packed(colours::line, 0.45f));
        const auto words = time_text(t, step) + (t == 0 ? " s" : "");
        if (x + 0.5f * text_width(words) < high.x + 8 * scale)
            text(t == 0 ? x : x - 0.5f * text_width(words), high.y + 3 * scale, colours::dim, words);
    }
    const float target_y = std::floor(y_of(target_error));
    for (float x = low.x; x < high.x; x += 7 * scale)
        draw->AddLine({x, target_y}, {std::min(x + 3 * scale, high.x), target_y},
                      packed(colours::error_estimate, 0.75f));

    draw->PushClipRect(low, high, true);
    const auto curve = [&](const std::vector<ConvergencePoint>& points, double ConvergencePoint::*member,
                           const ImVec4& colour, float thickness) {
        if (points.empty()) return;
        // A solve of minutes has thousands of points: a column of pixels shows where it enters, its extremes and where
        // it leaves.
        std::vector<ImVec2> line_points;
        float column = -1, lowest = 0, highest = 0;
        ImVec2 newest{};
        const auto finish_column = [&] {
            for (const float y : {lowest, highest, newest.y})
                if (line_points.back().y != y) line_points.push_back({newest.x, y});
        };
        for (const auto& point : points) {
            const ImVec2 place{x_of(point.seconds), y_of(point.*member)};
            if (std::floor(place.x) != column) {
                if (!line_points.empty()) finish_column();
                column = std::floor(place.x);
                lowest = highest = place.y;
                line_points.push_back(place);
            }
            lowest = std::max(lowest, place.y);
            highest = std::min(highest, place.y);
            newest = place;
        }
        finish_column();
        draw->AddPolyline(line_points.data(), static_cast<int>(line_points.size()), packed(colour), ImDrawFlags_None,
                          thickness * scale);
        draw->AddCircleFilled(newest, 1.6f * thickness * scale, packed(colour));
    };
    std::size_t others = 0;
    for (const ConvergenceRun& run : past.runs)
        if (run.name != present) curve(run.history, &ConvergencePoint::unshot_share, past_colour(others++), 1.0f);
    curve(history, &ConvergencePoint::unshot_share, colours::accent, 1.7f);
    curve(history, &ConvergencePoint::error, colours::error_estimate, 1.7f);
    draw->PopClipRect();
    if (others > 0) {
        float row = low.y + 3 * scale;
        others = 0;
        for (const ConvergenceRun& run : past.runs) {
            if (run.name == present) continue;
            const ImVec4& colour = past_colour(others++);
            const float right = high.x - 6 * scale, width_of_name = text_width(run.name);
            draw->AddLine({right - 14 * scale, row + 0.5f * line}, {right, row + 0.5f * line}, packed(colour), scale);
            text(right - 19 * scale - width_of_name, row, colours::dim, run.name);
            row += line;
        }
        ImGui::SetCursorScreenPos({high.x - 40 * scale, row + 2 * scale});
        ImGui::PushFont(state.fonts.small);
        if (ImGui::SmallButton("Clear")) past.forget_others(present);
        ImGui::PopFont();
        state.layout_log.widget("convergence:clear");
        tooltip(state, "Forget the curves of the solvers that ran before");
    }

    // The legend is the present value.
    float x = low.x;
    const auto legend = [&](const ImVec4& colour, const std::string& words) {
        draw->AddRectFilled({x, corner.y + 0.5f * line}, {x + 12 * scale, corner.y + 0.5f * line + 2 * scale},
                            packed(colour));
        text(x + 17 * scale, corner.y, colours::text, words);
        x += 17 * scale + text_width(words) + 18 * scale;
    };
    legend(colours::accent, "unshot " + percent_text(status.unshot_share));
    legend(colours::error_estimate, "estimated error " + percent_text(status.estimated_error));
    if (x + text_width("target 00.0 %") < high.x)
        text(x, corner.y, colours::dim, "target " + percent_text(target_error) + " (dashed)");

    if (hovered && !history.empty()) {
        const double seconds = end * (ImGui::GetIO().MousePos.x - low.x) / (high.x - low.x);
        const auto nearest = std::ranges::min_element(
            history, {}, [&](const ConvergencePoint& point) { return std::abs(point.seconds - seconds); });
        const float at_x = x_of(nearest->seconds);
        draw->AddLine({at_x, low.y}, {at_x, high.y}, packed(colours::text, 0.35f));
        ImGui::SetTooltip("%.3f s\nunshot %s\nestimated error %s", nearest->seconds,
                          percent_text(nearest->unshot_share).c_str(), percent_text(nearest->error).c_str());
    }
}

} // namespace lueur
