// Charts as SVG: panels with logarithmic axes, one curve a method, one legend.
//
// The chart paints its own light ground, so that it reads the same on a white page and on a dark one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace lueur {

struct ChartSeries { // what the legend names; the same colour in every panel
    std::string name;
    int colour = 0; // of a palette of eight that colour-blind people can tell apart (Okabe & Ito 2008)
    bool marks_only = false;
};

struct ChartCurve {
    std::size_t series = 0;
    std::vector<glm::dvec2> points; // x, y above 0; what is below the axis is drawn on its edge
    bool dashed = false;
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
    std::optional<double> level; // a line across at this y
};

struct Chart {
    std::string title;
    std::string note; // a line under the legend
    std::vector<ChartSeries> series;
    std::vector<ChartPanel> panels; // row by row
    std::size_t columns = 1;
};

std::string svg_text(const Chart& chart);

} // namespace lueur
