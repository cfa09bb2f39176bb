// The scene's lights on the chromaticity diagram, and how good one of them and the light at the probe are.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "core/scene/luminaire.h"
#include "core/spectrum/photometry.h"
#include "ui/chromaticity_diagram.h"
#include "ui/panels.h"
#include "ui/swatch.h"
#include "ui/widgets.h"

namespace lueur {
namespace {

// Luminaires of one colour share a mark.
struct Group {
    ChromaticityMark mark;
    std::vector<LuminaireIndex> luminaires;
};

std::vector<Group> groups_of(const Scene& scene, UiState& state) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < scene.luminaires.size(); ++i) {
        const LuminaireIndex index{static_cast<std::uint32_t>(i)};
        const Chromaticity xy = state.readings.of(scene.luminaires[i].spectrum).xy;
        if (xy == Chromaticity{}) continue; // no light
        auto group = std::ranges::find_if(groups, [&](const Group& other) {
            return std::hypot(other.mark.xy.x - xy.x, other.mark.xy.y - xy.y) < 5e-4;
        });
        if (group == groups.end()) {
            groups.push_back({{xy, {}, MarkShape::disc, false}, {}});
            group = groups.end() - 1;
        }
        group->luminaires.push_back(index);
        group->mark.selected |= state.luminaire == index;
    }
    for (auto& group : groups) {
        const auto chosen = std::ranges::find(group.luminaires, state.luminaire.value_or(group.luminaires.front()));
        const auto shown = chosen == group.luminaires.end() ? group.luminaires.front() : *chosen;
        group.mark.label = scene.luminaires[at(shown)].name;
        if (group.luminaires.size() > 1) group.mark.label += fmt::format(" +{}", group.luminaires.size() - 1);
    }
    return groups;
}

void diagram(const Document& document, UiState& state) {
    const float scale = state.scale, room = ImGui::GetContentRegionAvail().x, gap = 8 * scale;
    ImGui::SetNextItemWidth(0.5f * (room - gap));
    int uv = static_cast<int>(state.chromaticity_scale);
    if (segmented(state, "chromaticity_scale",
                  {{"x y", "CIE 1931"}, {"u' v'", "CIE 1976: equal steps look more nearly equal"}}, uv))
        state.chromaticity_scale = static_cast<ChromaticityScale>(uv);
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(0.5f * (room - gap));
    int whites = state.chromaticity_whites ? 1 : 0;
    if (segmented(
            state, "chromaticity_part",
            {{"Whole", "Every colour; the white triangle is what the display shows"},
             {"Whites", "Where lamps lie. Black: Planck's law, with lines of one correlated colour temperature 0.02 "
                        "of uv to either side; blue: CIE daylight"}},
            whites))
        state.chromaticity_whites = whites == 1;

    const auto groups = groups_of(document.scene(), state);
    std::vector<ChromaticityMark> marks;
    for (const auto& group : groups) marks.push_back(group.mark);
    if (state.hovered) {
        const Chromaticity arriving = chromaticity(state.hovered->irradiance),
                           seen = chromaticity(state.hovered->radiance);
        if (!(arriving == Chromaticity{})) marks.push_back({arriving, "light here", MarkShape::ring, false});
        if (!(seen == Chromaticity{})) marks.push_back({seen, "seen", MarkShape::square, false});
    }
    // As large as leaves the table in sight; the bars may be scrolled to.
    const float table_height =
        8 * (state.fonts.small->FontSize + 3 * scale) + 1.5f * ImGui::GetFrameHeightWithSpacing();
    const float height = std::floor(
        std::clamp(ImGui::GetContentRegionAvail().y - table_height, 170 * scale, std::max(0.76f * room, 171 * scale)));
    const auto clicked = chromaticity_diagram(document.scene().display.primaries, marks, state, room, height);
    if (clicked && *clicked < groups.size()) state.luminaire = groups[*clicked].luminaires.front();
}

// One column of the table; nothing where it is not known.
struct Column {
    const char* title;
    ImVec4 colour; // of its bars
    LightKind kind;
    std::optional<double> luminous, radiant;
    std::optional<LightReading> reading; // a copy: the cache moves what it holds
};

std::string number(const std::optional<double>& value, int decimals) {
    return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

void cell(const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.c_str());
}

void readings_table(const std::vector<Column>& columns, UiState& state) {
    if (!ImGui::BeginTable("##quality", 1 + static_cast<int>(columns.size()), ImGuiTableFlags_SizingStretchSame))
        return;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 88 * state.scale);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    for (const auto& column : columns) {
        ImGui::TableNextColumn();
        ImGui::TextColored(column.colour, "%s", column.title);
    }
    const auto row = [&](const char* name, const char* tip, const auto& text_of) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextColored(colours::dim, "%s", name);
        tooltip(state, tip);
        for (const auto& column : columns) cell(text_of(column));
    };
    const auto with_unit = [](const std::optional<double>& value, std::string_view unit) {
        return value ? fmt::format("{} {}", short_number(*value), unit) : "-";
    };
    row("Luminous", "683 lm/W times V: what the eye counts",
        [&](const Column& c) { return with_unit(c.luminous, light_kind_names(c.kind).luminous_unit); });
    row("Radiant", "Watts of light within 380..780 nm",
        [&](const Column& c) { return with_unit(c.radiant, light_kind_names(c.kind).radiant_unit); });
    row("Efficacy", "Of the radiation: lumens in each watt of it", [](const Column& c) {
        return c.luminous && c.radiant && *c.radiant > 0 ? number(*c.luminous / *c.radiant, 0) + " lm/W" : "-";
    });
    const auto known = [&](const auto& text_of) {
        return [&](const Column& c) { return c.reading ? std::string(text_of(*c.reading)) : std::string("-"); };
    };
    row("x  y", "CIE 1931, 2-degree observer",
        known([](const LightReading& r) { return fmt::format("{:.4f}  {:.4f}", r.xy.x, r.xy.y); }));
    row("CCT, Duv",
        "Correlated colour temperature, and the distance from the black body in uv 1960: greenish above 0, pinkish "
        "below. "
        "None further away than 0.05 or outside 1000..25000 K",
        known([](const LightReading& r) {
            return r.temperature ? fmt::format("{:.0f} K  {:+.4f}", r.temperature->kelvin, r.temperature->duv) : "-";
        }));
    row("Ra, R9",
        "Colour rendering, CIE 13.3-1995: the mean of R1 to R8, and strong red, which the mean leaves out. In brackets "
        "where the light is further than 0.0054 of uv from its reference, for which the indices are not meant",
        known([](const LightReading& r) {
            if (!r.rendering) return std::string("-");
            const auto words = fmt::format("{:.0f}  {:.0f}", r.rendering->general, r.rendering->special[8]);
            return within_reference(*r.rendering) ? words : "(" + words + ")";
        }));
    row("S/P", "Scotopic over photopic: how bright it is to eyes adapted to the dark",
        known([](const LightReading& r) { return number(r.scotopic_ratio, 2); }));
    ImGui::EndTable();
}

ImU32 test_colour(int number) {
    static const auto colours = [] {
        std::array<glm::vec3, test_colour_count> all;
        for (int i = 0; i < test_colour_count; ++i)
            all[static_cast<std::size_t>(i)] = encoded(linear_rgb(Reflectance(Drawn{test_colour_sample(i + 1)})));
        return all;
    }();
    const auto& c = colours[static_cast<std::size_t>(number - 1)];
    return packed({c.r, c.g, c.b, 1});
}

// R1 .. R14 as bars over the test colours; what is below the scale is cut, its number is in the tooltip.
void bars(const std::vector<const Column*>& series, UiState& state) {
    const float scale = state.scale, line = state.fonts.small->FontSize;
    const float left = 26 * scale, plot_height = 92 * scale, foot = 9 * scale + line;
    const float width = std::max(ImGui::GetContentRegionAvail().x, 80 * scale);
    const auto corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##rendering", {width, plot_height + foot + 6 * scale});
    state.layout_log.widget("rendering_bars");
    auto* list = ImGui::GetWindowDrawList();
    constexpr double bottom = -50, top = 100;
    const auto y_of = [&](double index) {
        const double share = (std::clamp(index, bottom, top) - bottom) / (top - bottom);
        return corner.y + 4 * scale + static_cast<float>(1 - share) * plot_height;
    };
    const float x0 = corner.x + left, step = (width - left) / test_colour_count;
    list->AddRectFilled({x0, y_of(top)}, {x0 + step * test_colour_count, y_of(bottom)}, packed(colours::backdrop),
                        3 * scale);
    for (const int index : {100, 50, 0, -50}) {
        const float y = std::floor(y_of(index));
        list->AddLine({x0, y}, {x0 + step * test_colour_count, y}, packed(colours::line, index == 0 ? 1.0f : 0.6f));
        const auto words = std::to_string(index);
        const float wide = state.fonts.small->CalcTextSizeA(line, 1e6f, 0, words.c_str()).x;
        list->AddText(state.fonts.small, line, {std::floor(x0 - 5 * scale - wide), std::floor(y - 0.55f * line)},
                      packed(colours::dim), words.c_str());
    }
    for (int i = 0; i < test_colour_count; ++i) {
        const float x = x0 + step * static_cast<float>(i), inner = step - 4 * scale;
        const float bar = inner / static_cast<float>(std::max<std::size_t>(series.size(), 1));
        for (std::size_t k = 0; k < series.size(); ++k) {
            const double index = series[k]->reading->rendering->special[static_cast<std::size_t>(i)];
            const float bx = x + 2 * scale + bar * static_cast<float>(k);
            const float y = y_of(index), zero = y_of(0);
            list->AddRectFilled({bx, std::min(y, zero)},
                                {bx + bar - (series.size() > 1 ? scale : 0), std::max(y, zero)},
                                packed(series[k]->colour, 0.92f));
        }
        const float foot_y = y_of(bottom) + 3 * scale;
        list->AddRectFilled({x + 2 * scale, foot_y}, {x + 2 * scale + inner, foot_y + 5 * scale}, test_colour(i + 1),
                            scale);
        const auto words = std::to_string(i + 1);
        const float wide = state.fonts.small->CalcTextSizeA(line, 1e6f, 0, words.c_str()).x;
        list->AddText(state.fonts.small, line, {std::floor(x + 0.5f * (step - wide)), std::floor(foot_y + 6 * scale)},
                      packed(i == 8 ? colours::text : colours::dim), words.c_str());
    }
    if (!ImGui::IsItemHovered()) return;
    const int i = static_cast<int>((ImGui::GetIO().MousePos.x - x0) / step);
    if (i < 0 || i >= test_colour_count) return;
    auto words = fmt::format("R{}", i + 1);
    for (const auto* each : series)
        words += fmt::format("   {:.1f}", each->reading->rendering->special[static_cast<std::size_t>(i)]);
    ImGui::SetTooltip("%s", words.c_str());
}

} // namespace

void colour_panel(const Document& document, UiState& state) {
    const auto& scene = document.scene();
    diagram(document, state);

    std::vector<Column> columns;
    if (!scene.luminaires.empty()) {
        const std::size_t shown =
            state.luminaire && at(*state.luminaire) < scene.luminaires.size() ? at(*state.luminaire) : std::size_t{0};
        const auto& luminaire = scene.luminaires[shown];
        ImGui::SetNextItemWidth(-1);
        if (ImGui::BeginCombo("##luminaire", luminaire.name.c_str())) {
            for (std::size_t i = 0; i < scene.luminaires.size(); ++i) {
                ImGui::PushID(static_cast<int>(i));
                if (ImGui::Selectable(scene.luminaires[i].name.c_str(), i == shown))
                    state.luminaire = LuminaireIndex{static_cast<std::uint32_t>(i)};
                ImGui::PopID();
            }
            ImGui::EndCombo();
        }
        state.layout_log.widget("colour_luminaire");
        columns.push_back({"Luminaire", colours::accent, LightKind::flux, luminous_flux(scene, luminaire),
                           radiant_flux(scene, luminaire), state.readings.of(luminaire.spectrum)});
    }
    Column here{"Light here", colours::error_estimate, LightKind::irradiance, {}, {}, {}};
    if (state.hovered) {
        const Probe& probe = *state.hovered;
        const bool spectral = !probe.irradiance_spectrum.nm.empty();
        here.luminous = probe.irradiance.y;
        if (probe.irradiance.y > 0)
            here.reading = spectral ? state.readings.of_arriving(probe.irradiance_spectrum)
                                    : state.readings.of_arriving(probe.irradiance);
        if (spectral) here.radiant = probe.irradiance_watts;
    }
    columns.push_back(here);
    ImGui::PushFont(state.fonts.small);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {4 * state.scale, 1.5f * state.scale});
    readings_table(columns, state);
    ImGui::PopStyleVar();
    if (!state.hovered) ImGui::TextColored(colours::dim, "Move the mouse over the picture to read the light there.");
    ImGui::PopFont();

    std::vector<const Column*> series;
    for (const auto& column : columns)
        if (column.reading && column.reading->rendering) series.push_back(&column);
    section(state, "Colour rendering R1 to R14");
    bars(series, state);
}

} // namespace lueur
