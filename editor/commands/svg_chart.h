// Charts as SVG: panels with logarithmic axes, one curve a method, one legend or a name at the end of each curve.
//
// The chart paints its own light ground, so that it reads the same on a white page and on a dark one.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace lueur {

enum class ChartMark { circle, square, triangle, diamond, plus, star, bar };

struct ChartSeries { // what the legend names; the same colour in every panel
    std::string name;
    int colour = 0; // of a palette of eight that colour-blind people can tell apart (Okabe & Ito 2008)
    bool marks_only = false;
    ChartMark mark = ChartMark::circle;
};

struct ChartCurve {
    std::size_t series = 0;
    std::vector<glm::dvec2> points; // x, y above 0; what is below the axis is drawn on its edge
    bool dashed = false;
};

struct ChartFailure { // a cross at the top edge
    std::size_t series = 0;
    double x = 1;
};

struct ChartAxis {
    std::string label;
    double low = 1, high = 10; // above 0, low < high
    bool linear = false;       // then low may be 0 or below
};

struct ChartPanel {
    std::string title;
    ChartAxis x, y;
    std::vector<ChartCurve> curves;
    std::optional<double> level{};   // a line across at this y
    std::vector<glm::dvec2> front{}; // a wide band behind the curves: steps down from point to point
    std::vector<glm::dvec2> dots{};  // small, without a curve
    std::vector<ChartFailure> failures{};
};

struct Chart {
    std::string title;
    std::string note; // a line under the legend
    std::vector<ChartSeries> series;
    std::vector<ChartPanel> panels; // row by row
    std::size_t columns = 1;
    double panel_width = 320, panel_height = 250; // of the plotted area, in pixels
    double names_width = 0; // of a column right of each panel with the name of each curve at its end; 0: a legend above
    std::vector<std::string> remarks{}; // lines under the panels; long ones are wrapped
};

std::string svg_text(const Chart& chart);

// Where names stand that would like to stand at `wanted`: in the same order, `spacing` apart at least, within low..high
// as far as they fit.
std::vector<double> spread_out(std::span<const double> wanted, double spacing, double low, double high);

} // namespace lueur
