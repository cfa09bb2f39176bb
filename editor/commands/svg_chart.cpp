#include "editor/commands/svg_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace lueur {

namespace {

constexpr double left = 58, right = 22, above = 34, below = 56, margin = 14, legend_line = 20; // pixels
constexpr double name_line = 14.5, remark_line = 16, letter = 6.1; // of text as small as names and remarks
constexpr const char* ground = "#fcfcfa";
constexpr const char* ink = "#222222";
constexpr const char* faint_ink = "#55585c";
constexpr std::array palette{"#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#56b4e9", "#7a6a00", "#000000"};

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) switch (c) {
        case '&':
            safe += "&amp;";
            break;
        case '<':
            safe += "&lt;";
            break;
        case '>':
            safe += "&gt;";
            break;
        case '"':
            safe += "&quot;";
            break;
        default:
            safe += c;
        }
    return safe;
}

const char* colour_of(const ChartSeries& series) {
    return palette[static_cast<std::size_t>(series.colour) % palette.size()];
}

std::string text_at(double x, double y, std::string_view text, const char* anchor, const char* fill, double size,
                    std::string_view more = {}) {
    return fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\" stroke=\"none\" font-size=\"{}\"{}>{}</text>\n",
        x, y, anchor, fill, size, more, escaped(text));
}

// 1, 2, 5, 10, 20, 50 ... within the axis; 1, 10, 100 ... only where those would be crowded.
std::vector<double> ticks(const ChartAxis& axis) {
    if (axis.linear) { // five or so round numbers
        const double step = std::pow(10.0, std::floor(std::log10((axis.high - axis.low) / 3)));
        const double wide = (axis.high - axis.low) / step > 12  ? 5 * step
                            : (axis.high - axis.low) / step > 6 ? 2 * step
                                                                : step;
        std::vector<double> values;
        for (double n = std::ceil(axis.low / wide - 1e-9); n * wide <= axis.high + 1e-9 * wide; ++n)
            values.push_back(n * wide + 0.0); // not -0
        return values;
    }
    const bool crowded = std::log10(axis.high / axis.low) > 3.2;
    std::vector<double> values;
    for (int decade = static_cast<int>(std::floor(std::log10(axis.low)));
         decade <= static_cast<int>(std::ceil(std::log10(axis.high))); ++decade)
        for (const double step : {1.0, 2.0, 5.0}) {
            const double value = step * std::pow(10.0, decade);
            const bool inside = value >= axis.low * (1 - 1e-9) && value <= axis.high * (1 + 1e-9);
            if (inside && (!crowded || step == 1)) values.push_back(value);
        }
    return values;
}

std::string mark_svg(ChartMark mark, double x, double y, double size, const char* colour) {
    const auto outline = [&](const char* path) {
        return fmt::format("<path transform=\"translate({:.1f} {:.1f}) scale({:g})\" d=\"{}\" stroke=\"none\" "
                           "fill=\"{}\"/>\n",
                           x, y, size, path, colour);
    };
    const auto strokes = [&](const char* path) {
        return fmt::format("<path transform=\"translate({:.1f} {:.1f}) scale({:g})\" d=\"{}\" fill=\"none\" "
                           "stroke=\"{}\" stroke-width=\"0.7\"/>\n",
                           x, y, size, path, colour);
    };
    switch (mark) {
    case ChartMark::circle:
        return fmt::format("<circle stroke=\"none\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" fill=\"{}\"/>\n", x, y, size,
                           colour);
    case ChartMark::square:
        return outline("M-1 -1h2v2h-2z");
    case ChartMark::triangle:
        return outline("M0 -1.3L1.2 0.9h-2.4z");
    case ChartMark::diamond:
        return outline("M0 -1.5L1.3 0L0 1.5L-1.3 0z");
    case ChartMark::plus:
        return strokes("M-1.4 0h2.8M0 -1.4v2.8");
    case ChartMark::star:
        return strokes("M-1.1 -1.1l2.2 2.2M-1.1 1.1l2.2 -2.2");
    case ChartMark::bar:
        return strokes("M0 -1.6v3.2");
    }
    return {};
}

// Cut between words, no line longer than `width` pixels; the lines after the first stand further in.
std::vector<std::string> wrapped_remark(const std::string& text, double width) {
    const auto letters = static_cast<std::size_t>(std::max(20.0, width / letter));
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        if (!line.empty() && line.size() + 1 + word.size() > letters) {
            lines.push_back(line);
            line = "    " + word;
        } else
            line += (line.empty() ? "" : " ") + word;
        at = end + 1;
    }
    lines.push_back(line);
    return lines;
}

class PanelWriter {
public:
    PanelWriter(const Chart& chart, const ChartPanel& panel, double x, double y)
        : chart_(chart)
        , panel_(panel)
        , panel_width(chart.panel_width)
        , panel_height(chart.panel_height)
        , x_(x)
        , y_(y) {}

    std::string svg() const {
        std::string out =
            text_at(x_ + panel_width / 2, y_ - 12, panel_.title, "middle", ink, 13.5, " font-weight=\"600\"");
        out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n", x_, y_,
                           panel_width, panel_height);
        for (const double tick : ticks(panel_.x)) {
            out += line(across(tick), y_, across(tick), y_ + panel_height, "#e2e2de", 1);
            out += text_at(across(tick), y_ + panel_height + 17, fmt::format("{:g}", tick), "middle", faint_ink, 11.5);
        }
        for (const double tick : ticks(panel_.y)) {
            out += line(x_, up(tick), x_ + panel_width, up(tick), "#e2e2de", 1);
            out += text_at(x_ - 7, up(tick) + 4, fmt::format("{:g}", tick), "end", faint_ink, 11.5);
        }
        if (!panel_.front.empty()) out += front_svg();
        if (panel_.level)
            out += line(x_, up(*panel_.level), x_ + panel_width, up(*panel_.level), "#888888", 1.2, "2 3");
        out += fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#8a8d91\"/>\n", x_, y_,
            panel_width, panel_height);
        out += text_at(x_ + panel_width / 2, y_ + panel_height + 38, panel_.x.label, "middle", ink, 12);
        out +=
            text_at(0, 0, panel_.y.label, "middle", ink, 12,
                    fmt::format(" transform=\"translate({:.1f} {:.1f}) rotate(-90)\"", x_ - 42, y_ + panel_height / 2));
        if (!panel_.dots.empty()) out += dots_svg();
        for (const ChartCurve& curve : panel_.curves) out += curve_svg(curve);
        for (const ChartFailure& failure : panel_.failures)
            out += fmt::format("<path d=\"M{:.1f} {:.1f}m-4 -4l8 8m-8 0l8 -8\" stroke=\"{}\" stroke-width=\"2\"/>\n",
                               across(failure.x), y_ + 8, colour_of(chart_.series.at(failure.series)));
        if (chart_.names_width > 0) out += names_svg();
        return out;
    }

private:
    static double share(const ChartAxis& axis, double value) {
        if (axis.linear) return std::clamp((value - axis.low) / (axis.high - axis.low), 0.0, 1.0);
        const double s = std::log(std::max(value, axis.low) / axis.low) / std::log(axis.high / axis.low);
        return std::clamp(s, 0.0, 1.0);
    }
    double across(double value) const { return x_ + panel_width * share(panel_.x, value); }
    double up(double value) const { return y_ + panel_height * (1 - share(panel_.y, value)); }

    static std::string line(double x1, double y1, double x2, double y2, const char* stroke, double width,
                            const char* dashes = nullptr) {
        return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", x1, y1,
                           x2, y2, stroke, width, dashes ? fmt::format(" stroke-dasharray=\"{}\"", dashes) : "");
    }

    std::string curve_svg(const ChartCurve& curve) const {
        const ChartSeries& series = chart_.series.at(curve.series);
        const char* colour = colour_of(series);
        std::string path, marks;
        for (const glm::dvec2& point : curve.points) {
            const double x = across(point.x), y = up(point.y);
            path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x, y);
            if (series.marks_only)
                marks += fmt::format("<path d=\"M{:.1f} {:.1f}l5 5l-5 5l-5 -5z\" fill=\"{}\" stroke=\"{}\"/>\n", x,
                                     y - 5, curve.dashed ? ground : colour, colour);
            else
                marks += mark_svg(series.mark, x, y, curve.dashed ? 1.6 : 2.6, colour);
        }
        if (series.marks_only || curve.points.size() < 2) return marks;
        return fmt::format(
                   "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{}/>\n",
                   path, colour, curve.dashed ? 1.1 : 2.0, curve.dashed ? " stroke-dasharray=\"5 3\"" : "") +
               marks;
    }

    // Hundreds of them in one path: strokes without length under round caps.
    std::string dots_svg() const {
        std::string path;
        for (const glm::dvec2& dot : panel_.dots) path += fmt::format("M{:.1f} {:.1f}h0", across(dot.x), up(dot.y));
        return fmt::format("<path d=\"{}\" stroke=\"#b9bbbd\" stroke-width=\"2.6\" stroke-linecap=\"round\"/>\n", path);
    }

    // From each point to the time of the next at the same error, then down: what is best until then.
    std::string front_svg() const {
        std::string path;
        for (const glm::dvec2& point : panel_.front)
            path += path.empty() ? fmt::format("M{:.1f} {:.1f}", across(point.x), up(point.y))
                                 : fmt::format("H{:.1f}V{:.1f}", across(point.x), up(point.y));
        path += fmt::format("H{:.1f}", x_ + panel_width);
        return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#f3df9b\" stroke-width=\"9\" "
                           "stroke-linejoin=\"round\"/>\n",
                           path);
    }

    // The name of each curve right of the panel, as near to its end as the other names allow, with a thin line to it.
    std::string names_svg() const {
        std::vector<const ChartCurve*> named;
        for (const ChartCurve& curve : panel_.curves)
            if (!curve.points.empty()) named.push_back(&curve);
        std::ranges::stable_sort(named, {}, [&](const ChartCurve* curve) { return up(curve->points.back().y); });
        std::vector<double> wanted;
        for (const ChartCurve* curve : named) wanted.push_back(up(curve->points.back().y));
        const auto places = spread_out(wanted, name_line, y_ + 2, y_ + panel_height + below - 10);
        const double start = x_ + panel_width + 24;
        std::string out;
        for (std::size_t i = 0; i < named.size(); ++i) {
            const ChartSeries& series = chart_.series.at(named[i]->series);
            const double x = across(named[i]->points.back().x);
            out += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}\" fill=\"none\" stroke=\"{}\" "
                               "stroke-width=\"0.6\" stroke-opacity=\"0.55\"/>\n",
                               x, wanted[i], x_ + panel_width + 2, wanted[i], start - 4, places[i], colour_of(series));
            out += mark_svg(series.mark, start + 4, places[i], 2.8, colour_of(series));
            out += text_at(start + 12, places[i] + 4, series.name, "start", colour_of(series), 11.5);
        }
        return out;
    }

    const Chart& chart_;
    const ChartPanel& panel_;
    const double panel_width, panel_height;
    double x_, y_;
};

} // namespace

std::vector<double> spread_out(std::span<const double> wanted, double spacing, double low, double high) {
    std::vector<double> places(wanted.begin(), wanted.end());
    double least = low;
    for (double& place : places) {
        place = std::max(place, least);
        least = place + spacing;
    }
    double most = high;
    for (auto place = places.rbegin(); place != places.rend(); ++place) {
        *place = std::min(*place, most);
        most = *place - spacing;
    }
    return places;
}

std::string svg_text(const Chart& chart) {
    const std::size_t columns = std::max<std::size_t>(1, std::min(chart.columns, chart.panels.size())),
                      rows = (chart.panels.size() + columns - 1) / columns;
    const double cell_width = left + chart.panel_width + right + chart.names_width,
                 cell_height = above + chart.panel_height + below;
    const double width = 2 * margin + static_cast<double>(columns) * cell_width;

    std::string legend;
    double top = margin + 18; // the line of the title
    if (chart.names_width <= 0) {
        top += 26;
        double x = margin + 8;
        for (const ChartSeries& series : chart.series) {
            const double room = 26 + 7.2 * static_cast<double>(series.name.size());
            if (x + room > width - margin && x > margin + 8) {
                x = margin + 8;
                top += legend_line;
            }
            if (series.marks_only)
                legend += fmt::format("<path d=\"M{:.1f} {:.1f}l5 5l-5 5l-5 -5z\" fill=\"{}\"/>\n", x + 10, top - 9,
                                      colour_of(series));
            else
                legend += fmt::format("<path d=\"M{:.1f} {:.1f}h20\" stroke=\"{}\" stroke-width=\"3\"/>\n", x, top - 4,
                                      colour_of(series));
            legend += text_at(x + 26, top, series.name, "start", ink, 12.5);
            x += room + 22;
        }
    }
    if (!chart.note.empty()) {
        top += legend_line;
        legend += text_at(margin + 8, top, chart.note, "start", faint_ink, 12);
    }
    top += 18;

    std::vector<std::string> remarks;
    for (const std::string& remark : chart.remarks)
        for (std::string& line : wrapped_remark(remark, width - 2 * margin - 16)) remarks.push_back(std::move(line));
    const double bottom = top + static_cast<double>(rows) * cell_height,
                 height = bottom + static_cast<double>(remarks.size()) * remark_line + margin;

    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
        "{1:.0f}\" font-family=\"Inter, Helvetica, Arial, sans-serif\">\n",
        width, height);
    out += fmt::format("<title>{}</title>\n", escaped(chart.title));
    out += fmt::format("<rect x=\"0.5\" y=\"0.5\" width=\"{:.0f}\" height=\"{:.0f}\" rx=\"8\" fill=\"{}\" "
                       "stroke=\"#c9cbce\"/>\n",
                       width - 1, height - 1, ground);
    out += text_at(margin + 8, margin + 18, chart.title, "start", ink, 16, " font-weight=\"600\"");
    out += legend;
    for (std::size_t i = 0; i < chart.panels.size(); ++i)
        out += PanelWriter(chart, chart.panels[i], margin + static_cast<double>(i % columns) * cell_width + left,
                           top + static_cast<double>(i / columns) * cell_height + above)
                   .svg();
    for (std::size_t i = 0; i < remarks.size(); ++i)
        out += text_at(margin + 8, bottom + static_cast<double>(i + 1) * remark_line - 6, remarks[i], "start",
                       faint_ink, 11.5, " xml:space=\"preserve\"");
    return out + "</svg>\n";
}

} // namespace lueur
