#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/spectrum/cieluv.h"
#include "core/spectrum/colour_temperature.h"
#include "core/spectrum/observer.h"
#include "ui/chromaticity_diagram.h"
#include "ui/swatch.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

struct Place { // on the diagram: x, y or u', v'
    double x, y;
};

Place place_of(const Chromaticity& xy, ChromaticityScale scale) {
    switch (scale) {
    case ChromaticityScale::xy:
        return {xy.x, xy.y};
    case ChromaticityScale::uv: {
        const Uv1976 uv = uv1976_from_chromaticity(xy);
        return {uv.u, uv.v};
    }
    }
    return {};
}

Chromaticity chromaticity_at(const Place& place, ChromaticityScale scale) {
    switch (scale) {
    case ChromaticityScale::xy:
        return {place.x, place.y};
    case ChromaticityScale::uv:
        return chromaticity_from_uv(Uv1976{place.x, place.y});
    }
    return {};
}

// The colour of a chromaticity as bright as sRGB shows it; outside its gamut mixed with white until it fits.
ImU32 shown_colour(const Chromaticity& xy) {
    static const glm::dmat3 to_rgb = rgb_from_xyz(srgb);
    Rgb rgb = to_rgb * xyz_from_chromaticity({xy.x, std::max(xy.y, 1e-4)}, 1);
    rgb -= std::min({rgb.r, rgb.g, rgb.b, 0.0});
    const auto c = encoded(rgb / std::max({rgb.r, rgb.g, rgb.b, 1e-9}));
    return packed({c.r, c.g, c.b, 1}, 0.82f);
}

// The locus of single wavelengths, and rings from the white out to it (and to the line of purples): a fan of quads of
// which only the corners' colours are worked out.
constexpr int first_nm_drawn = 400, last_nm_drawn = 700, nm_step = 4;
constexpr int locus_count = (last_nm_drawn - first_nm_drawn) / nm_step + 1, purple_count = 16, ring_count = 18;
constexpr int spoke_count = locus_count + purple_count;

struct Fan {
    std::array<std::array<Place, ring_count + 1>, spoke_count> at;
    std::array<std::array<ImU32, ring_count + 1>, spoke_count> colour;
};

Chromaticity of_wavelength(int nm) {
    return chromaticity(observer_xyz(nm));
}

Fan make_fan(ChromaticityScale scale) {
    Fan fan;
    const Chromaticity white{1.0 / 3, 1.0 / 3}, violet = of_wavelength(first_nm_drawn),
                                                red = of_wavelength(last_nm_drawn);
    const auto towards = [](const Chromaticity& from, const Chromaticity& to, double share) {
        return Chromaticity{std::lerp(from.x, to.x, share), std::lerp(from.y, to.y, share)};
    };
    for (int spoke = 0; spoke < spoke_count; ++spoke) {
        const Chromaticity edge = spoke < locus_count
                                      ? of_wavelength(first_nm_drawn + spoke * nm_step)
                                      : towards(red, violet, (spoke - locus_count + 1) / (purple_count + 1.0));
        for (int ring = 0; ring <= ring_count; ++ring) {
            const Chromaticity xy = towards(white, edge, static_cast<double>(ring) / ring_count);
            fan.at[static_cast<std::size_t>(spoke)][static_cast<std::size_t>(ring)] = place_of(xy, scale);
            fan.colour[static_cast<std::size_t>(spoke)][static_cast<std::size_t>(ring)] = shown_colour(xy);
        }
    }
    return fan;
}

const Fan& fan_of(ChromaticityScale scale) {
    static const std::array<Fan, 2> fans{make_fan(ChromaticityScale::xy), make_fan(ChromaticityScale::uv)};
    return fans[static_cast<std::size_t>(scale)];
}

struct View {
    Place low, high; // the part of the diagram that is shown
};

// Whole: all of the locus. Whites: where lamps lie.
View view_of(ChromaticityScale scale, bool whites) {
    switch (scale) {
    case ChromaticityScale::xy:
        return whites ? View{{0.22, 0.24}, {0.56, 0.50}} : View{{-0.03, -0.02}, {0.77, 0.90}};
    case ChromaticityScale::uv:
        return whites ? View{{0.15, 0.42}, {0.33, 0.56}} : View{{-0.03, -0.02}, {0.65, 0.625}};
    }
    return {};
}

struct Drawing {
    ImDrawList* list;
    UiState& state;
    ChromaticityScale scale;
    View view;
    ImVec2 origin; // pixel of view.low
    float per_unit;

    ImVec2 at(const Place& place) const {
        return {origin.x + static_cast<float>(place.x - view.low.x) * per_unit,
                origin.y - static_cast<float>(place.y - view.low.y) * per_unit};
    }
    ImVec2 at(const Chromaticity& xy) const { return at(place_of(xy, scale)); }
    float text_width(const std::string& words) const {
        return state.fonts.small->CalcTextSizeA(state.fonts.small->FontSize, 1e6f, 0, words.c_str()).x;
    }
    // On a shadow, for it stands on every colour.
    void text(float x, float y, ImU32 colour, const std::string& words) const {
        const float px = std::floor(x), py = std::floor(y), size = state.fonts.small->FontSize;
        for (const ImVec2& aside : {ImVec2{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
            list->AddText(state.fonts.small, size, {px + aside.x, py + aside.y}, IM_COL32(0, 0, 0, 120), words.c_str());
        list->AddText(state.fonts.small, size, {px, py}, colour, words.c_str());
    }
};

void draw_colours(const Drawing& drawing) {
    const Fan& fan = fan_of(drawing.scale);
    const ImVec2 blank = ImGui::GetFontTexUvWhitePixel();
    auto* list = drawing.list;
    list->PrimReserve(spoke_count * ring_count * 6, spoke_count * (ring_count + 1));
    const auto first = list->_VtxCurrentIdx;
    for (std::size_t spoke = 0; spoke < spoke_count; ++spoke)
        for (std::size_t ring = 0; ring <= ring_count; ++ring)
            list->PrimWriteVtx(drawing.at(fan.at[spoke][ring]), blank, fan.colour[spoke][ring]);
    for (unsigned spoke = 0; spoke < spoke_count; ++spoke)
        for (unsigned ring = 0; ring < ring_count; ++ring) {
            const unsigned here = first + spoke * (ring_count + 1) + ring;
            const unsigned next = first + (spoke + 1) % spoke_count * (ring_count + 1) + ring;
            for (const unsigned corner : {here, here + 1, next + 1, here, next + 1, next})
                list->PrimWriteIdx(static_cast<ImDrawIdx>(corner));
        }
    std::vector<ImVec2> edge;
    for (const auto& spoke : fan.at) edge.push_back(drawing.at(spoke[ring_count]));
    list->AddPolyline(edge.data(), static_cast<int>(edge.size()), IM_COL32(235, 235, 235, 150), ImDrawFlags_Closed,
                      1.2f * drawing.state.scale);
}

void draw_wavelengths(const Drawing& drawing) {
    const float scale = drawing.state.scale, line = drawing.state.fonts.small->FontSize;
    const ImVec2 white = drawing.at(Chromaticity{1.0 / 3, 1.0 / 3});
    for (const int nm : {460, 480, 500, 520, 540, 560, 580, 600, 620, 700}) {
        const ImVec2 at = drawing.at(of_wavelength(nm));
        const float dx = at.x - white.x, dy = at.y - white.y, length = std::hypot(dx, dy);
        const ImVec2 out{dx / length, dy / length};
        drawing.list->AddLine(at, {at.x + 3 * scale * out.x, at.y + 3 * scale * out.y}, IM_COL32(235, 235, 235, 150));
        const auto words = std::to_string(nm);
        const float width = drawing.text_width(words);
        drawing.text(at.x + (5 * scale + 0.5f * width) * out.x - 0.5f * width,
                     at.y + (5 * scale + 0.5f * line) * out.y - 0.5f * line, packed(colours::dim), words);
    }
}

void draw_loci(const Drawing& drawing, bool whites) {
    const float scale = drawing.state.scale;
    const auto locus = [](const auto& of_kelvin, double coldest, double hottest) {
        std::vector<Chromaticity> points;
        constexpr int count = 48;
        for (int i = 0; i <= count; ++i) // even steps of 1 / T
            points.push_back(of_kelvin(1 / std::lerp(1 / coldest, 1 / hottest, static_cast<double>(i) / count)));
        return points;
    };
    static const auto planckian = locus([](double kelvin) { return chromaticity(planckian_xyz(kelvin)); },
                                        least_colour_temperature, most_colour_temperature);
    static const auto daylights = locus(daylight_chromaticity, least_daylight_temperature, most_daylight_temperature);
    const auto curve = [&](const std::vector<Chromaticity>& points, ImU32 colour, float width) {
        std::vector<ImVec2> pixels;
        for (const auto& xy : points) pixels.push_back(drawing.at(xy));
        drawing.list->AddPolyline(pixels.data(), static_cast<int>(pixels.size()), colour, ImDrawFlags_None,
                                  width * scale);
    };
    curve(planckian, IM_COL32(20, 20, 20, 230), 1.6f);
    curve(daylights, IM_COL32(30, 70, 150, 220), 1.3f);

    // Lines of one correlated colour temperature, 0.02 of uv 1960 to either side.
    struct Isotherm {
        int kelvin;
        std::array<Chromaticity, 2> ends;
    };
    static const auto isotherms = [] {
        std::vector<Isotherm> lines;
        for (const int kelvin : {1500, 2000, 2700, 3000, 3500, 4000, 5000, 6500, 10000}) {
            const Uv1960 here = uv1960_from_xyz(planckian_xyz(kelvin));
            const Uv1960 hotter = uv1960_from_xyz(planckian_xyz(kelvin * 1.001));
            const double du = hotter.u - here.u, dv = hotter.v - here.v, size = 0.02 / std::hypot(du, dv);
            lines.push_back({kelvin,
                             {chromaticity_from_uv(Uv1960{here.u + dv * size, here.v - du * size}),
                              chromaticity_from_uv(Uv1960{here.u - dv * size, here.v + du * size})}});
        }
        return lines;
    }();
    for (const auto& [kelvin, ends] : isotherms) {
        const ImVec2 one = drawing.at(ends[0]), other = drawing.at(ends[1]);
        drawing.list->AddLine(one, other, IM_COL32(20, 20, 20, whites ? 190 : 110), scale);
        if (!whites || kelvin == 3000 || kelvin == 4000) continue; // no room to name it
        const ImVec2 low = one.y > other.y ? one : other;          // below the locus it is emptier
        const auto words = fmt::format("{} K", kelvin);
        drawing.text(low.x - 0.5f * drawing.text_width(words), low.y + scale, IM_COL32(225, 225, 225, 235), words);
    }
}

void draw_gamut(const Drawing& drawing, const RgbSpace& display) {
    const std::array corners{drawing.at(display.red), drawing.at(display.green), drawing.at(display.blue)};
    drawing.list->AddPolyline(corners.data(), 3, IM_COL32(255, 255, 255, 220), ImDrawFlags_Closed,
                              1.4f * drawing.state.scale);
    const ImVec2 white = drawing.at(display.white);
    const float arm = 4 * drawing.state.scale;
    drawing.list->AddLine({white.x - arm, white.y}, {white.x + arm, white.y}, IM_COL32(255, 255, 255, 230));
    drawing.list->AddLine({white.x, white.y - arm}, {white.x, white.y + arm}, IM_COL32(255, 255, 255, 230));
}

void draw_mark(const Drawing& drawing, const ChromaticityMark& mark) {
    const float scale = drawing.state.scale, radius = (mark.selected ? 5.0f : 4.0f) * scale;
    const ImVec2 at = drawing.at(mark.xy);
    const ImU32 dark = IM_COL32(10, 10, 10, 235), light = mark.selected ? packed(colours::accent) : IM_COL32_WHITE;
    auto* list = drawing.list;
    switch (mark.shape) {
    case MarkShape::disc:
        list->AddCircleFilled(at, radius + 1.5f * scale, dark);
        list->AddCircleFilled(at, radius, light);
        break;
    case MarkShape::ring:
        list->AddCircle(at, radius + 2 * scale, dark, 0, 4 * scale);
        list->AddCircle(at, radius + 2 * scale, packed(colours::error_estimate), 0, 2 * scale);
        break;
    case MarkShape::square:
        list->AddRect({at.x - radius, at.y - radius}, {at.x + radius, at.y + radius}, dark, 0, 0, 4 * scale);
        list->AddRect({at.x - radius, at.y - radius}, {at.x + radius, at.y + radius}, packed(colours::error_estimate),
                      0, 0, 2 * scale);
        break;
    }
}

// Beside its mark where nothing else stands; what finds no room has its name in the tooltip only. The selected one and
// the probe's (the last) choose first.
void draw_labels(const Drawing& drawing, const std::vector<ChromaticityMark>& marks, const ImVec2& low,
                 const ImVec2& high) {
    const float scale = drawing.state.scale, line = drawing.state.fonts.small->FontSize, aside = 9 * scale;
    const auto overlap = [](const ImVec4& a, const ImVec4& b) {
        return a.x < b.z && b.x < a.z && a.y < b.w && b.y < a.w;
    };
    std::vector<ImVec4> taken;
    for (const auto& mark : marks) {
        const ImVec2 at = drawing.at(mark.xy);
        taken.push_back({at.x - 5 * scale, at.y - 5 * scale, at.x + 5 * scale, at.y + 5 * scale});
    }
    std::vector<std::size_t> order(marks.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = order.size() - 1 - i;
    std::ranges::stable_partition(order, [&](std::size_t i) { return marks[i].selected; });
    for (const std::size_t i : order) {
        const ImVec2 at = drawing.at(marks[i].xy);
        if (at.x < low.x || at.x > high.x || at.y < low.y || at.y > high.y) continue;
        const float width = drawing.text_width(marks[i].label);
        const float right = at.x + aside, left = at.x - aside - width, middle = at.y - 0.5f * line;
        for (const ImVec2& corner : {ImVec2{right, middle},
                                     {left, middle},
                                     {right, middle + 0.8f * line},
                                     {right, middle - 0.8f * line},
                                     {left, middle + 0.8f * line},
                                     {left, middle - 0.8f * line},
                                     {at.x - 0.5f * width, middle + 1.3f * line},
                                     {at.x - 0.5f * width, middle - 1.3f * line}}) {
            const ImVec4 box{corner.x, corner.y, corner.x + width, corner.y + line};
            if (box.x < low.x || box.z > high.x || box.y < low.y || box.w > high.y) continue;
            if (std::ranges::any_of(taken, [&](const ImVec4& other) { return overlap(box, other); })) continue;
            taken.push_back(box);
            if (marks[i].selected)
                drawing.list->AddRectFilled({box.x - 3 * scale, box.y - scale}, {box.z + 3 * scale, box.w + 2 * scale},
                                            IM_COL32(20, 20, 20, 190), 3 * scale);
            drawing.text(corner.x, corner.y, marks[i].selected ? packed(colours::accent) : IM_COL32_WHITE,
                         marks[i].label);
            break;
        }
    }
}

} // namespace

std::optional<std::size_t> chromaticity_diagram(const RgbSpace& display, const std::vector<ChromaticityMark>& marks,
                                                UiState& state, float width, float height) {
    const float scale = state.scale;
    const auto corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##chromaticity", {std::max(width, 1.0f), std::max(height, 1.0f)});
    const bool hovered = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
    state.layout_log.widget("chromaticity");
    const ImVec2 end{corner.x + width, corner.y + height};
    auto* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(corner, end, packed(colours::backdrop), 3 * scale);

    const View view = view_of(state.chromaticity_scale, state.chromaticity_whites);
    const float per_unit = std::min(width / static_cast<float>(view.high.x - view.low.x),
                                    height / static_cast<float>(view.high.y - view.low.y));
    const float used_width = static_cast<float>(view.high.x - view.low.x) * per_unit,
                used_height = static_cast<float>(view.high.y - view.low.y) * per_unit;
    const Drawing drawing{list,
                          state,
                          state.chromaticity_scale,
                          view,
                          {corner.x + 0.5f * (width - used_width), end.y - 0.5f * (height - used_height)},
                          per_unit};
    list->PushClipRect(corner, end, true);
    draw_colours(drawing);
    draw_gamut(drawing, display);
    draw_loci(drawing, state.chromaticity_whites);
    if (!state.chromaticity_whites) draw_wavelengths(drawing);
    for (const auto& mark : marks) {
        draw_mark(drawing, mark);
        const ImVec2 at = drawing.at(mark.xy);
        state.layout_log.area("mark:" + mark.label, at.x - 3, at.y - 3, at.x + 3, at.y + 3);
    }
    draw_labels(drawing, marks, corner, end);
    list->PopClipRect();

    if (!hovered) return {};
    const auto mouse = ImGui::GetIO().MousePos;
    for (std::size_t i = marks.size(); i-- > 0;) { // the topmost first
        const ImVec2 at = drawing.at(marks[i].xy);
        if (std::hypot(mouse.x - at.x, mouse.y - at.y) > 8 * scale) continue;
        ImGui::SetTooltip("%s\nx y  %.4f  %.4f", marks[i].label.c_str(), marks[i].xy.x, marks[i].xy.y);
        if (clicked) return i;
        return {};
    }
    const Chromaticity xy = chromaticity_at({view.low.x + static_cast<double>(mouse.x - drawing.origin.x) / per_unit,
                                             view.low.y + static_cast<double>(drawing.origin.y - mouse.y) / per_unit},
                                            state.chromaticity_scale);
    const Uv1976 uv = uv1976_from_chromaticity(xy);
    ImGui::SetTooltip("x y  %.3f  %.3f\nu' v'  %.3f  %.3f", xy.x, xy.y, uv.u, uv.v);
    return {};
}

} // namespace lueur
