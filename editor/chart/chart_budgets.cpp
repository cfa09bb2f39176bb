#include <algorithm>
#include <array>

#include "editor/chart/method_chart.h"

namespace lueur {

namespace {

constexpr std::array budgets{ChartBudget{4, 0.3, 0},      ChartBudget{2, 0.1, 0},    ChartBudget{1.4, 0.05, 0},
                             ChartBudget{1, 0.02, 0},     ChartBudget{0.7, 0.01, 0}, ChartBudget{0.5, 0.005, 0},
                             ChartBudget{0.35, 0.0025, 0}};

} // namespace

std::span<const ChartBudget> chart_budgets() {
    return budgets;
}

ChartBudget budget_of(const ChartMethod& method, std::size_t level) {
    ChartBudget budget = budgets.at(level);
    if (method.solver == SolverKind::reference) budget.samples = 16 << (2 * std::min<std::size_t>(level, 5));
    return budget;
}

} // namespace lueur
