// A method chart as a picture: log-log, one curve a method, the best of all behind them, failures named.
#pragma once

#include "editor/chart/method_chart.h"
#include "editor/commands/svg_chart.h"

namespace lueur {

Chart picture_of(const MethodChart& chart);

// Colour of a solver in svg_chart.h's palette, mark of a form-factor method or oracle.
int colour_of(SolverKind solver);
ChartMark mark_of(const ChartMethod& method);

// What did not settle, in lines: "not finished within 8 s: jacobi, hemicube from level 4 on; ...".
std::vector<std::string> failures_of(const MethodChart& chart);

} // namespace lueur
