#include "editor/commands/svg_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace lueur {

namespace {

constexpr double panel_width = 320, panel_height = 250; // of the plotted area, in pixels
constexpr double left = 58, right = 22, above = 34, below = 56, margin = 14, legend_line = 20;
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

class PanelWriter {
public:
    PanelWriter(const Chart& chart, const ChartPanel& panel, double x, double y)
        : chart_(chart)
        , panel_(panel)
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
        if (panel_.level)
            out += line(x_, up(*panel_.level), x_ + panel_width, up(*panel_.level), "#888888", 1.2, "2 3");
        out += fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#8a8d91\"/>\n", x_, y_,
            panel_width, panel_height);
        out += text_at(x_ + panel_width / 2, y_ + panel_height + 38, panel_.x.label, "middle", ink, 12);
        out +=
            text_at(0, 0, panel_.y.label, "middle", ink, 12,
                    fmt::format(" transform=\"translate({:.1f} {:.1f}) rotate(-90)\"", x_ - 42, y_ + panel_height / 2));
        for (const ChartCurve& curve : panel_.curves) out += curve_svg(curve);
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
                marks += fmt::format("<circle stroke=\"none\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", x,
                                     y, curve.dashed ? 1.6 : 2.6, colour);
        }
        if (series.marks_only || curve.points.size() < 2) return marks;
        return fmt::format(
                   "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{}/>\n",
                   path, colour, curve.dashed ? 1.1 : 2.0, curve.dashed ? " stroke-dasharray=\"5 3\"" : "") +
               marks;
    }

    const Chart& chart_;
    const ChartPanel& panel_;
    double x_, y_;
};

} // namespace

std::string svg_text(const Chart& chart) {
    const std::size_t columns = std::max<std::size_t>(1, std::min(chart.columns, chart.panels.size())),
                      rows = (chart.panels.size() + columns - 1) / columns;
    const double cell_width = left + panel_width + right, cell_height = above + panel_height + below;
    const double top = margin + 62 + (chart.note.empty() ? 0 : legend_line);
    const double width = 2 * margin + static_cast<double>(columns) * cell_width,
                 height = top + static_cast<double>(rows) * cell_height + margin;
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
        "{1:.0f}\" font-family=\"Inter, Helvetica, Arial, sans-serif\">\n",
        width, height);
    out += fmt::format("<title>{}</title>\n", escaped(chart.title));
    out += fmt::format("<rect x=\"0.5\" y=\"0.5\" width=\"{:.0f}\" height=\"{:.0f}\" rx=\"8\" fill=\"{}\" "
                       "stroke=\"#c9cbce\"/>\n",
                       width - 1, height - 1, ground);
    out += text_at(margin + 8, margin + 18, chart.title, "start", ink, 16, " font-weight=\"600\"");
    double x = margin + 8;
    for (const ChartSeries& series : chart.series) {
        const double y = margin + 44;
        if (series.marks_only)
            out += fmt::format("<path d=\"M{:.1f} {:.1f}l5 5l-5 5l-5 -5z\" fill=\"{}\"/>\n", x + 10, y - 9,
                               colour_of(series));
        else
            out += fmt::format("<path d=\"M{:.1f} {:.1f}h20\" stroke=\"{}\" stroke-width=\"3\"/>\n", x, y - 4,
                               colour_of(series));
        out += text_at(x + 26, y, series.name, "start", ink, 12.5);
        x += 26 + 7.2 * static_cast<double>(series.name.size()) + 22;
    }
    if (!chart.note.empty()) out += text_at(margin + 8, margin + 44 + legend_line, chart.note, "start", faint_ink, 12);
    for (std::size_t i = 0; i < chart.panels.size(); ++i)
        out += PanelWriter(chart, chart.panels[i], margin + static_cast<double>(i % columns) * cell_width + left,
                           top + static_cast<double>(i / columns) * cell_height + above)
                   .svg();
    return out + "</svg>\n";
}

} // namespace lueur
