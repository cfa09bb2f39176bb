#include "ui/spectrum_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/spectrum/colour.h"
#include "core/spectrum/observer.h"
#include "ui/swatch.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

constexpr double visible_first = 380, visible_last = 780;

// Hue of a wavelength, bright enough to be told apart where the eye hardly sees it; grey outside.
ImVec4 colour_of_wavelength(double nm) {
    if (nm < visible_first || nm > visible_last) return {0.36f, 0.36f, 0.36f, 1};
    // Outside the display's gamut: white is added until no component is negative, and a little more for calm.
    Rgb rgb = rgb_from_xyz(srgb) * observer_xyz(nm);
    rgb -= std::min({rgb.r, rgb.g, rgb.b, 0.0});
    const double largest = std::max({rgb.r, rgb.g, rgb.b, 1e-9});
    const auto c = encoded((rgb / largest * 0.92 + 0.08) * std::clamp(0.15 + 0.7 * largest, 0.0, 0.75));
    return {c.x, c.y, c.z, 1};
}

const std::vector<ImU32>& colour_table() { // each nm from 300 to 830
    static const std::vector<ImU32> table = [] {
        std::vector<ImU32> colours;
        for (int nm = 300; nm <= 830; ++nm) colours.push_back(packed(colour_of_wavelength(nm)));
        return colours;
    }();
    return table;
}

ImU32 colour_at(double nm) {
    const auto& table = colour_table();
    return table[static_cast<std::size_t>(std::clamp(std::lround(nm) - 300L, 0L, static_cast<long>(table.size()) - 1))];
}

Outside outside_of(CurveKind kind) {
    switch (kind) {
    case CurveKind::light:
        return Outside::zero;
    case CurveKind::reflectance:
        return Outside::constant;
    }
    return Outside::zero;
}

// The largest value within [from, to]: a column of pixels never loses a narrow line.
double largest_within(const Spectrum& spectrum, double from, double to, Outside outside) {
    double largest = std::max(value_at(spectrum, from, outside), value_at(spectrum, to, outside));
    auto sample = std::ranges::lower_bound(spectrum.nm, from);
    for (; sample != spectrum.nm.end() && *sample <= to; ++sample)
        largest = std::max(largest, spectrum.value[static_cast<std::size_t>(sample - spectrum.nm.begin())]);
    return largest;
}

double own_top(const Spectrum& spectrum, CurveKind kind, double first, double last) {
    if (kind == CurveKind::reflectance) return 1;
    const double largest = spectrum.nm.empty() ? 0 : largest_within(spectrum, first, last, Outside::zero);
    return largest > 0 ? 1.06 * largest : 1;
}

// Where wavelengths and values are on the screen.
struct Axes {
    ImVec2 low, high; // of the field
    double first = visible_first, last = visible_last, top = 1;

    float x(double nm) const { return low.x + static_cast<float>((nm - first) / (last - first)) * (high.x - low.x); }
    float y(double value) const {
        return high.y - static_cast<float>(std::clamp(value / top, 0.0, 1.0)) * (high.y - low.y);
    }
    double nm(float at) const { return first + (last - first) * (at - low.x) / (high.x - low.x); }
    double value(float at) const { return top * (high.y - at) / (high.y - low.y); }
};

void fill(ImDrawList& draw, const Axes& axes, const Spectrum& spectrum, CurveKind kind, bool outline, float scale) {
    if (spectrum.nm.empty()) return;
    std::vector<ImVec2> line;
    const double step = axes.nm(axes.low.x + 1) - axes.first;
    for (float x = axes.low.x; x < axes.high.x; x += 1) {
        const double nm = axes.nm(x);
        const float y = axes.y(largest_within(spectrum, nm, nm + step, outside_of(kind)));
        if (y < axes.high.y) draw.AddRectFilled({x, y}, {x + 1, axes.high.y}, colour_at(nm));
        line.push_back({x + 0.5f, y});
    }
    if (outline)
        draw.AddPolyline(line.data(), static_cast<int>(line.size()), packed(colours::text, 0.85f), ImDrawFlags_None,
                         1.3f * scale);
}

// The field with its axes; the curve is drawn into it.
Axes draw_axes(UiState& state, const char* id, float height, double first, double last, double top) {
    const float scale = state.scale, line = state.fonts.small->FontSize;
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
    const auto corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(id, {width, height + line + 4 * scale},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    auto& draw = *ImGui::GetWindowDrawList();
    const Axes axes{{corner.x, corner.y}, {corner.x + width, corner.y + height}, first, last, top};
    draw.AddRectFilled(axes.low, axes.high, packed(colours::backdrop), 3 * scale);
    for (const double share : {0.25, 0.5, 0.75}) {
        const float y = std::floor(axes.high.y - static_cast<float>(share) * height);
        draw.AddLine({axes.low.x, y}, {axes.high.x, y}, packed(colours::line, 0.5f));
    }
    for (double nm = std::ceil(first / 100) * 100; nm < last; nm += 100) {
        const float x = std::floor(axes.x(nm));
        draw.AddLine({x, axes.low.y}, {x, axes.high.y}, packed(colours::line, 0.7f));
        const auto text = fmt::format("{:.0f}{}", nm, nm == 700 ? " nm" : "");
        draw.AddText(state.fonts.small, line, {x - 10 * scale, axes.high.y + 3 * scale}, packed(colours::dim),
                     text.c_str());
    }
    return axes;
}

void draw_unit(UiState& state, const Axes& axes, CurveKind kind) {
    const char* text = kind == CurveKind::light ? "power per nm, relative" : "reflectance, top 1";
    const float scale = state.scale, line = state.fonts.small->FontSize;
    const ImVec2 at{axes.low.x + 6 * scale, axes.low.y + 3 * scale};
    const ImVec2 size = state.fonts.small->CalcTextSizeA(line, 1e6f, 0, text);
    auto& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled({at.x - 3 * scale, at.y - scale}, {at.x + size.x + 3 * scale, at.y + size.y + scale},
                       packed(colours::backdrop, 0.6f), 3 * scale); // a curve may pass behind it
    draw.AddText(state.fonts.small, line, at, packed(colours::text, 0.7f), text);
}

void readout(const Axes& axes, const Spectrum& spectrum, CurveKind kind) {
    const float x = ImGui::GetIO().MousePos.x;
    const double nm = axes.nm(x);
    ImGui::GetWindowDrawList()->AddLine({x, axes.low.y}, {x, axes.high.y}, packed(colours::text, 0.35f));
    ImGui::SetTooltip("%.0f nm: %s%s", nm, short_number(value_at(spectrum, nm, outside_of(kind))).c_str(),
                      nm < visible_first || nm > visible_last ? "\nnot visible: kept, counts in no figure" : "");
}

void fit_range(const Spectrum& spectrum, double& first, double& last) {
    if (spectrum.nm.empty()) return;
    first = std::clamp(first_nm(spectrum), 300.0, visible_first);
    last = std::clamp(last_nm(spectrum), visible_last, 830.0);
}

double rounded(double value, double step) {
    return std::round(value / step) * step;
}

// Wavelengths to a tenth of a nanometre, values to a two-thousandth of the axis: what a hand means, and short in a
// file.
void move_point(Spectrum& spectrum, int index, double nm, double value, double top) {
    const auto i = static_cast<std::size_t>(index);
    constexpr double gap = 0.1;
    const double low = i > 0 ? spectrum.nm[i - 1] + gap : visible_first;
    const double high = i + 1 < spectrum.nm.size() ? spectrum.nm[i + 1] - gap : visible_last;
    if (low <= high) {
        const double wanted = std::round(std::clamp(nm, low, high) * 10) / 10;
        if (wanted > (i > 0 ? spectrum.nm[i - 1] : 0) && (i + 1 == spectrum.nm.size() || wanted < spectrum.nm[i + 1]))
            spectrum.nm[i] = wanted;
    }
    const double step = std::pow(10.0, std::floor(std::log10(top / 200)));
    const double fitted = std::clamp(rounded(value, step), 0.0, top);
    spectrum.value[i] = std::round(fitted * 1e9) / 1e9;
}

int nearest_point(const Axes& axes, const Spectrum& spectrum, const ImVec2& at, float reach) {
    int nearest = -1;
    float best = reach * reach;
    for (std::size_t i = 0; i < spectrum.nm.size(); ++i) {
        const float dx = axes.x(spectrum.nm[i]) - at.x, dy = axes.y(spectrum.value[i]) - at.y;
        if (dx * dx + dy * dy < best) {
            best = dx * dx + dy * dy;
            nearest = static_cast<int>(i);
        }
    }
    return nearest;
}

} // namespace

void spectrum_plot(UiState& state, const char* id, const Spectrum& spectrum, CurveKind kind) {
    double first = visible_first, last = visible_last;
    if (kind == CurveKind::light) fit_range(spectrum, first, last);
    const double top = own_top(spectrum, kind, first, last);
    const Axes axes = draw_axes(state, id, 84 * state.scale, first, last, top);
    fill(*ImGui::GetWindowDrawList(), axes, spectrum, kind, true, state.scale);
    draw_unit(state, axes, kind);
    state.layout_log.widget("spectrum_plot");
    if (ImGui::IsItemHovered() && !spectrum.nm.empty()) readout(axes, spectrum, kind);
}

std::optional<Spectrum> curve_editor(UiState& state, const char* id, const Spectrum& spectrum, CurveKind kind) {
    CurveDrag& drag = state.curve;
    const ImGuiID own = ImGui::GetID(id);
    const bool ours = drag.owner == own;
    const auto point_count = static_cast<int>(spectrum.nm.size());
    if (ours && (drag.point >= point_count || drag.chosen >= point_count)) drag = {}; // undone meanwhile
    double top = own_top(spectrum, kind, visible_first, visible_last);
    if (kind == CurveKind::light) top = std::max(top, 1.2); // room above 1 to draw in
    if (ours && drag.active()) top = drag.top;              // the axis stays while a point moves

    const Axes axes = draw_axes(state, id, 150 * state.scale, visible_first, visible_last, top);
    state.layout_log.widget("curve");
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float reach = 9 * state.scale;
    const bool by_left = active && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    const int under = hovered && !by_left ? nearest_point(axes, spectrum, mouse, reach) : -1;

    std::optional<Spectrum> changed;
    if (ImGui::IsItemActivated() && ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
        drag = {.owner = own, .point = nearest_point(axes, spectrum, mouse, reach), .top = top};
        if (drag.point < 0 && mouse.y < axes.high.y + reach) { // a new one
            const double nm = std::clamp(std::round(axes.nm(mouse.x) * 10) / 10, visible_first, visible_last);
            const auto place = std::ranges::lower_bound(spectrum.nm, nm);
            const auto i = place - spectrum.nm.begin();
            if (place == spectrum.nm.end() || *place != nm) {
                changed = spectrum;
                changed->nm.insert(changed->nm.begin() + i, nm);
                changed->value.insert(changed->value.begin() + i, 0.0);
                move_point(*changed, static_cast<int>(i), nm, axes.value(mouse.y), top);
                drag.point = static_cast<int>(i);
                drag.moved = true;
            }
        }
        drag.chosen = drag.point;
    } else if (ours && drag.active() && by_left) {
        const ImVec2 delta = ImGui::GetIO().MouseDelta;
        if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) {
            if (drag.moved) state.commands.push_back(Command::undo); // the drag is one step of it
            drag = {.owner = own};
        } else if (delta.x != 0 || delta.y != 0) {
            changed = spectrum;
            move_point(*changed, drag.point, axes.nm(mouse.x), axes.value(mouse.y), top);
            drag.moved = true;
        }
    } else if (ours && !active) {
        drag.point = -1;
    }
    const bool by_key = ours && hovered && !active && drag.chosen >= 0 && !ImGui::GetIO().WantTextInput &&
                        ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Delete), false);
    const bool by_click = hovered && under >= 0 && ImGui::IsMouseClicked(ImGuiMouseButton_Right);
    if ((by_key || by_click) && spectrum.nm.size() > 2) {
        const int gone = by_click ? under : drag.chosen;
        changed = spectrum;
        changed->nm.erase(changed->nm.begin() + gone);
        changed->value.erase(changed->value.begin() + gone);
        drag = {};
    }
    if (changed && *changed == spectrum) changed.reset();

    auto& draw = *ImGui::GetWindowDrawList();
    const Spectrum& shown = changed ? *changed : spectrum;
    fill(draw, axes, shown, kind, true, state.scale);
    draw_unit(state, axes, kind);
    for (std::size_t i = 0; i < shown.nm.size(); ++i) {
        const ImVec2 at{axes.x(shown.nm[i]), axes.y(shown.value[i])};
        const bool chosen = drag.owner == own && drag.chosen == static_cast<int>(i);
        const bool near = under == static_cast<int>(i);
        draw.AddCircleFilled(at, (chosen || near ? 5.2f : 3.8f) * state.scale, IM_COL32(20, 20, 20, 255));
        draw.AddCircleFilled(at, (chosen || near ? 3.8f : 2.6f) * state.scale,
                             packed(chosen ? colours::accent : colours::text));
    }
    const int told = drag.active() ? drag.point : under;
    if (told >= 0 && told < static_cast<int>(shown.nm.size()))
        ImGui::SetTooltip("%.1f nm: %s", shown.nm[static_cast<std::size_t>(told)],
                          short_number(shown.value[static_cast<std::size_t>(told)]).c_str());
    ImGui::PushFont(state.fonts.small);
    ImGui::TextColored(colours::dim, "Drag points. A click adds, a right click or Del takes away.");
    ImGui::PopFont();
    return changed;
}

void spectrum_thumbnail(ImDrawList& draw, const ImVec2& low, const ImVec2& high, const Spectrum& spectrum,
                        CurveKind kind) {
    draw.AddRectFilled(low, high, packed(colours::backdrop), 2);
    fill(draw, {low, high, visible_first, visible_last, own_top(spectrum, kind, visible_first, visible_last)}, spectrum,
         kind, false, 1);
}

Spectrum points_near(const Spectrum& spectrum, CurveKind kind) {
    const Outside outside = outside_of(kind);
    const double largest =
        kind == CurveKind::light ? largest_within(spectrum, visible_first, visible_last, outside) : 1.0;
    const double scale = largest > 0 ? 1 / largest : 1;
    Spectrum dense; // its own samples, and the ends of the visible range
    const auto add = [&](double nm) {
        const double at = std::round(nm * 10) / 10;
        if (!dense.nm.empty() && at <= dense.nm.back()) return;
        dense.nm.push_back(at);
        dense.value.push_back(std::clamp(std::round(1e4 * scale * value_at(spectrum, nm, outside)) / 1e4, 0.0, 1.0));
    };
    add(visible_first);
    for (const double nm : spectrum.nm)
        if (nm > visible_first && nm < visible_last) add(nm);
    add(visible_last);

    std::vector<bool> kept;
    for (double tolerance = 0.004;; tolerance *= 1.5) { // until there are few enough to be handled
        kept.assign(dense.nm.size(), false);
        kept.front() = kept.back() = true;
        std::vector<std::pair<std::size_t, std::size_t>> open{{0, dense.nm.size() - 1}};
        while (!open.empty()) {
            const auto [a, b] = open.back();
            open.pop_back();
            double farthest = tolerance;
            std::size_t at = a;
            for (std::size_t i = a + 1; i < b; ++i) {
                const double t = (dense.nm[i] - dense.nm[a]) / (dense.nm[b] - dense.nm[a]);
                const double away = std::abs(dense.value[i] - std::lerp(dense.value[a], dense.value[b], t));
                if (away > farthest) {
                    farthest = away;
                    at = i;
                }
            }
            if (at == a) continue;
            kept[at] = true;
            open.push_back({a, at});
            open.push_back({at, b});
        }
        if (std::ranges::count(kept, true) <= 40) break;
    }
    Spectrum few;
    for (std::size_t i = 0; i < kept.size(); ++i)
        if (kept[i]) {
            few.nm.push_back(dense.nm[i]);
            few.value.push_back(dense.value[i]);
        }
    return few;
}

} // namespace lueur
