// The chart of methods, error against time, with the solve that is going on as a moving point. A click on a curve takes
// its method.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

constexpr double least_shown = 1e-4, most_shown = 2; // relative error
constexpr float reach = 9;                           // unscaled pixels from the pointer to what it means

ImVec4 colour_of(SolverKind solver) {
    switch (solver) {
    case SolverKind::automatic:
    case SolverKind::gathering:
        return colours::accent;
    case SolverKind::shooting:
        return {0.34f, 0.71f, 0.91f, 1};
    case SolverKind::overshooting:
        return {0.55f, 0.60f, 0.98f, 1};
    case SolverKind::jacobi:
        return {0.85f, 0.52f, 0.72f, 1};
    case SolverKind::gauss_seidel:
        return {0.20f, 0.74f, 0.55f, 1};
    case SolverKind::hierarchical:
        return {0.93f, 0.36f, 0.24f, 1};
    case SolverKind::reference:
        return {0.66f, 0.66f, 0.66f, 1};
    }
    return colours::dim;
}

ChartMethod method_of(const SolveSettings& solve) {
    ChartMethod method;
    method.solver = solve.solver;
    for (const ChartMethod& known : all_chart_methods()) {
        if (known.solver != solve.solver) continue;
        if (known.form_factors != FormFactorMethod::automatic && known.form_factors != solve.form_factors) continue;
        if (has_oracle(known.solver) && known.oracle != solve.oracle) continue;
        return known;
    }
    return method;
}

std::string percent(double share) {
    return short_number(100 * share) + " %";
}

struct Meant { // what the pointer is at
    const ChartRun* run = nullptr;
    const ChartPoint* point = nullptr; // null: the end of a run that did not settle
};

void tooltip_of(const Meant& meant, float scale) {
    const ChartRun& run = *meant.run;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(300 * scale);
    ImGui::TextColored(colour_of(run.method.solver), "%s", to_string(run.method).c_str());
    if (const ChartPoint* point = meant.point) {
        ImGui::Text("%s after %.3g s", percent(point->error.rms_without_noise).c_str(), point->seconds);
        ImGui::TextColored(colours::dim, "median %s, 95 %% below %s", percent(point->error.median).c_str(),
                           percent(point->error.percentile95).c_str());
        ImGui::TextColored(colours::dim, "estimated by itself: %s", percent(point->estimated_error).c_str());
    } else
        ImGui::TextColored(colours::warning, "%s",
                           run.reason.empty() ? to_string(run.end).c_str() : run.reason.c_str());
    ImGui::TextColored(
        colours::dim, "%s",
        fmt::format("elements {:g} x, target {:g} %{}", run.budget.element_scale, 100 * run.budget.target_error,
                    run.budget.samples > 0 ? fmt::format(", {} samples", run.budget.samples) : std::string())
            .c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

class Plot {
public:
    Plot(const MethodChart& chart, const Document& document, const Snapshot& snapshot, UiState& state)
        : chart_(chart)
        , snapshot_(snapshot)
        , state_(state)
        , current_(method_of(document.scene().solve))
        , scale_(state.scale)
        , line_(state.fonts.small->FontSize)
        , draw_(ImGui::GetWindowDrawList()) {}

    // Fills the rest of the panel; what a click took.
    std::optional<ChartMethod> draw() {
        const auto methods = methods_of(chart_);
        const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
        const float legend = legend_height(methods, room.x);
        low_ = {corner.x + 38 * scale_, corner.y + 4 * scale_};
        high_ = {corner.x + room.x - 8 * scale_, corner.y + room.y - line_ - 7 * scale_ - legend};
        ImGui::InvisibleButton("##chart", {std::max(room.x, 1.0f), std::max(room.y, 1.0f)});
        state_.layout_log.area("chart", low_.x, low_.y, high_.x, high_.y);
        if (high_.x - low_.x < 60 * scale_ || high_.y - low_.y < 40 * scale_) return {};
        const bool hovered = ImGui::IsItemHovered(), clicked = hovered && ImGui::IsItemClicked();
        set_range();
        draw_->AddRectFilled(low_, high_, packed(colours::backdrop), 3 * scale_);
        axes();
        draw_->PushClipRect(low_, high_, true);
        front();
        const Meant meant = hovered ? nearest(ImGui::GetIO().MousePos) : Meant{};
        for (const ChartMethod& method : methods) curve(method, meant.run && !(meant.run->method == method));
        for (const ChartRun& run : chart_.runs)
            if (failed(run)) cross(place_of(run), packed(colour_of(run.method.solver), 0.9f));
        live();
        draw_->PopClipRect();
        legend_of(methods, corner.x, high_.y + line_ + 8 * scale_, room.x);
        if (!meant.run) return {};
        if (meant.point) draw_->AddCircle(place_of(*meant.point), 5 * scale_, packed(colours::text), 0, 1.5f * scale_);
        tooltip_of(meant, scale_);
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        return clicked ? std::optional(meant.run->method) : std::nullopt;
    }

private:
    static bool failed(const ChartRun& run) { return run.end != RunEnd::settled && run.end != RunEnd::not_started; }

    float text_width(const std::string& words) const {
        return state_.fonts.small->CalcTextSizeA(line_, std::numeric_limits<float>::max(), 0, words.c_str()).x;
    }
    void text(float x, float y, const ImVec4& colour, const std::string& words) const {
        draw_->AddText(state_.fonts.small, line_, {std::floor(x), std::floor(y)}, packed(colour), words.c_str());
    }

    void set_range() {
        double first = std::numeric_limits<double>::infinity(), last = 0, least = most_shown, most = least_shown;
        const auto take = [&](double seconds, double error) {
            if (seconds > 0) first = std::min(first, seconds), last = std::max(last, seconds);
            least = std::min(least, std::max(error, least_shown));
            most = std::max(most, std::min(error, most_shown));
        };
        for (const ChartRun& run : chart_.runs) {
            for (const ChartPoint& point : run.points) take(point.seconds, point.error.rms_without_noise);
            if (failed(run) && run.seconds > 0) last = std::max(last, run.seconds);
        }
        if (snapshot_.status.seconds > 0) take(snapshot_.status.seconds, snapshot_.status.estimated_error);
        if (!(last > 0)) first = 1e-3, last = 10, least = 1e-3, most = 1;
        first = std::max(first, 1e-3); // a live solve begins at nothing
        x0_ = std::log10(0.8 * first), x1_ = std::log10(1.3 * std::max(last, 3 * first));
        y0_ = std::log10(0.7 * least), y1_ = std::log10(1.4 * std::max(most, 3 * least));
    }
    float across(double seconds) const {
        return low_.x +
               static_cast<float>((std::log10(std::max(seconds, 1e-9)) - x0_) / (x1_ - x0_)) * (high_.x - low_.x);
    }
    float up(double error) const {
        const double share = (std::log10(std::clamp(error, least_shown, most_shown)) - y0_) / (y1_ - y0_);
        return high_.y - static_cast<float>(std::clamp(share, 0.0, 1.0)) * (high_.y - low_.y);
    }
    ImVec2 place_of(const ChartPoint& point) const {
        return {across(point.seconds), up(point.error.rms_without_noise)};
    }
    ImVec2 place_of(const ChartRun& run) const {
        return {std::clamp(across(run.seconds), low_.x + 6 * scale_, high_.x - 6 * scale_), low_.y + 7 * scale_};
    }

    void axes() const {
        float last_label = low_.x - 100 * scale_;
        for (int decade = static_cast<int>(std::floor(x0_)); decade <= static_cast<int>(x1_) + 1; ++decade)
            for (const double step : {1.0, 2.0, 5.0}) {
                const double seconds = step * std::pow(10.0, decade);
                const float x = std::floor(across(seconds));
                if (x < low_.x || x > high_.x) continue;
                draw_->AddLine({x, low_.y}, {x, high_.y}, packed(colours::line, step == 1 ? 0.9f : 0.35f));
                const auto words =
                    seconds < 0.1 ? fmt::format("{:g} ms", 1000 * seconds) : fmt::format("{:g} s", seconds);
                const float width = text_width(words), start = x - 0.5f * width;
                if ((step != 1 && x1_ - x0_ > 2.2) || start < last_label + 6 * scale_ ||
                    start + width > high_.x + 8 * scale_)
                    continue;
                text(start, high_.y + 3 * scale_, colours::dim, words);
                last_label = start + width;
            }
        float last_y = high_.y + 100 * scale_;
        for (int decade = static_cast<int>(std::floor(y0_)); decade <= 0; ++decade)
            for (const double step : {1.0, 2.0, 5.0}) {
                const double error = step * std::pow(10.0, decade);
                const float y = std::floor(up(error));
                if (std::log10(error) < y0_ || std::log10(error) > y1_) continue;
                draw_->AddLine({low_.x, y}, {high_.x, y}, packed(colours::line, step == 1 ? 0.9f : 0.35f));
                if (y > last_y - 1.1f * line_) continue;
                const auto words = fmt::format("{:g} %", 100 * error);
                text(low_.x - 5 * scale_ - text_width(words), y - 0.55f * line_, colours::dim, words);
                last_y = y;
            }
    }

    void front() const {
        std::vector<ImVec2> band;
        for (const FrontPoint& point : front_of(chart_)) {
            const ImVec2 place{across(point.place.x), up(point.place.y)};
            if (!band.empty()) band.push_back({place.x, band.back().y});
            band.push_back(place);
        }
        if (band.empty()) return;
        band.push_back({high_.x, band.back().y});
        draw_->AddPolyline(band.data(), static_cast<int>(band.size()), packed(colours::text, 0.13f), ImDrawFlags_None,
                           8 * scale_);
    }

    void curve(const ChartMethod& method, bool faint) const {
        const bool current = method == current_;
        const ImU32 colour = packed(colour_of(method.solver), faint ? 0.25f : 0.95f);
        std::vector<ImVec2> line;
        for (const glm::dvec2& point : curve_of(chart_, method)) line.push_back({across(point.x), up(point.y)});
        draw_->AddPolyline(line.data(), static_cast<int>(line.size()), colour, ImDrawFlags_None,
                           (current ? 2.6f : 1.3f) * scale_);
        for (const ImVec2& place : line) draw_->AddCircleFilled(place, (current ? 2.8f : 2.0f) * scale_, colour);
    }

    void cross(const ImVec2& place, ImU32 colour) const {
        const float r = 3.5f * scale_;
        draw_->AddLine({place.x - r, place.y - r}, {place.x + r, place.y + r}, colour, 1.5f * scale_);
        draw_->AddLine({place.x - r, place.y + r}, {place.x + r, place.y - r}, colour, 1.5f * scale_);
    }

    // Estimated error against solve time: the trail of the solve so far and where it is now.
    void live() const {
        std::vector<ImVec2> trail;
        for (const ConvergencePoint& point : snapshot_.history) {
            const ImVec2 place{across(point.seconds), up(point.error)};
            if (trail.empty() || std::hypot(place.x - trail.back().x, place.y - trail.back().y) > scale_)
                trail.push_back(place);
        }
        draw_->AddPolyline(trail.data(), static_cast<int>(trail.size()), packed(colours::text, 0.55f), ImDrawFlags_None,
                           scale_);
        if (!(snapshot_.status.seconds > 0)) return;
        const ImVec2 now{across(snapshot_.status.seconds), up(snapshot_.status.estimated_error)};
        draw_->AddCircleFilled(now, 4 * scale_, packed(colours::backdrop));
        draw_->AddCircle(now, 4 * scale_, packed(colours::text), 0, 2 * scale_);
        const std::string words = "live " + percent(snapshot_.status.estimated_error);
        const float width = text_width(words);
        const float x = now.x + 8 * scale_ + width < high_.x ? now.x + 8 * scale_ : now.x - 8 * scale_ - width;
        text(x, std::clamp(now.y - 1.2f * line_, low_.y, high_.y - line_), colours::text, words);
    }

    Meant nearest(ImVec2 pointer) const {
        Meant meant;
        float least = reach * scale_;
        const auto offer = [&](const ImVec2& place, const ChartRun& run, const ChartPoint* point) {
            const float distance = std::hypot(place.x - pointer.x, place.y - pointer.y);
            if (distance >= least) return;
            least = distance;
            meant = {&run, point};
        };
        for (const ChartRun& run : chart_.runs) {
            for (const ChartPoint& point : run.points) offer(place_of(point), run, &point);
            if (failed(run)) offer(place_of(run), run, nullptr);
        }
        return meant;
    }

    static std::vector<SolverKind> solvers_of(const std::vector<ChartMethod>& methods) {
        std::vector<SolverKind> solvers;
        for (const ChartMethod& method : methods)
            if (solvers.empty() || solvers.back() != method.solver) solvers.push_back(method.solver);
        return solvers;
    }
    // Calls `place(solver, words, x, row)` for each word of the legend; the number of rows.
    template <typename Place>
    int lay_out(const std::vector<ChartMethod>& methods, float width, const Place& place) const {
        float x = 0;
        int row = 0;
        for (const SolverKind solver : solvers_of(methods)) {
            ChartMethod alone;
            alone.solver = solver;
            std::string words = to_string(alone);
            words = words.substr(0, words.find(','));
            const float needed = 16 * scale_ + text_width(words);
            if (x > 0 && x + needed > width) x = 0, ++row;
            place(solver, words, x, row);
            x += needed + 11 * scale_;
        }
        return row + 1;
    }
    float legend_height(const std::vector<ChartMethod>& methods, float width) const {
        const int rows = lay_out(methods, width, [](SolverKind, const std::string&, float, int) {});
        return methods.empty() ? 0 : static_cast<float>(rows) * (line_ + scale_);
    }
    void legend_of(const std::vector<ChartMethod>& methods, float left, float top, float width) const {
        lay_out(methods, width, [&](SolverKind solver, const std::string& words, float x, int row) {
            const float y = top + static_cast<float>(row) * (line_ + scale_);
            draw_->AddRectFilled({left + x, y + 0.5f * line_}, {left + x + 11 * scale_, y + 0.5f * line_ + 2 * scale_},
                                 packed(colour_of(solver)));
            text(left + x + 15 * scale_, y, solver == current_.solver ? colours::text : colours::dim, words);
        });
    }

    const MethodChart& chart_;
    const Snapshot& snapshot_;
    UiState& state_;
    const ChartMethod current_;
    const float scale_, line_;
    ImDrawList* draw_;
    ImVec2 low_{}, high_{};
    double x0_ = 0, x1_ = 1, y0_ = 0, y1_ = 1; // decades shown
};

bool same_light(const Scene& a, const Scene& b) {
    return a.geometry == b.geometry && a.materials == b.materials && a.luminaires == b.luminaires;
}

std::string words_about(const ChartPanelState& panel, const Document& document) {
    if (panel.chart->runs.empty()) return "No run is done yet.";
    std::string words =
        fmt::format("{} runs, {} points, {}", panel.chart->runs.size(), panel.chart->points, panel.source);
    if (panel.scene && !same_light(*panel.scene, document.scene())) words += "; the scene has changed since";
    return words;
}

} // namespace

std::optional<Edit> chart_panel(const Document& document, const Snapshot& snapshot, UiState& state) {
    ChartPanelState& panel = state.chart;
    const float scale = state.scale, button = 84 * scale;
    if (panel.running) {
        if (ImGui::Button("Cancel", {button, 0})) panel.request = ChartRequest::cancel;
        state.layout_log.widget("chart:cancel");
        ImGui::SameLine();
        ImGui::ProgressBar(static_cast<float>(panel.share), {-1, 0}, panel.what.c_str());
    } else {
        if (ImGui::Button("Compute", {button, 0})) panel.request = ChartRequest::compute;
        state.layout_log.widget("chart:compute");
        tooltip(state, "Run every solver with every method of finding form factors on this scene, with ever larger "
                       "budgets, in the background, and measure each against traced paths");
        ImGui::SameLine();
        ImGui::PushFont(state.fonts.small);
        ImGui::PushTextWrapPos(0);
        const std::string words = !panel.what.empty() ? panel.what
                                  : panel.chart       ? words_about(panel, document)
                                                      : std::string("Error against time of every method; 90 s.");
        ImGui::TextColored(colours::dim, "%s", words.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopFont();
    }
    static const MethodChart nothing;
    const auto taken = Plot(panel.chart ? *panel.chart : nothing, document, snapshot, state).draw();
    if (!taken) return {};
    auto solve = document.scene().solve;
    solve.solver = taken->solver;
    if (solve.form_factors != taken->form_factors) solve.form_factor_samples = 0; // a number means another thing there
    solve.form_factors = taken->form_factors;
    if (has_oracle(taken->solver)) solve.oracle = taken->oracle;
    if (solve == document.scene().solve) return {};
    return SetSolve{solve};
}

} // namespace lueur
