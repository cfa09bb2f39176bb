#include <algorithm>
#include <array>

#include "editor/chart/method_chart.h"

namespace lueur {

namespace {

constexpr std::array budgets{ChartBudget{4, 0.3, 0},      ChartBudget{2, 0.1, 0},    ChartBudget{1.4, 0.05, 0},
                             ChartBudget{1, 0.02, 0},     ChartBudget{0.7, 0.01, 0}, ChartBudget{0.5, 0.005, 0},
                             ChartBudget{0.35, 0.0025, 0}};

using Samples = std::array<int, budgets.size()>;

// What one number means to each method: row_settings (core/transport/form_factor.h), whose defaults stand at level 3.
constexpr Samples exact_visibility{4, 8, 16, 16, 16, 32, 32}, sub_elements{1, 2, 4, 4, 4, 8, 16},
    pairs{8, 16, 32, 64, 128, 256, 512}, hemicube_edge{16, 32, 48, 64, 96, 128, 192},
    hemisphere_rays{256, 1024, 2048, 4096, 8192, 16384, 32768};

int samples_of(FormFactorMethod method, std::size_t level) {
    switch (method) {
    case FormFactorMethod::automatic:
        return 0;
    case FormFactorMethod::analytic:
        return exact_visibility.at(level);
    case FormFactorMethod::point_to_disk:
    case FormFactorMethod::area_sampled:
        return sub_elements.at(level);
    case FormFactorMethod::monte_carlo:
        return pairs.at(level);
    case FormFactorMethod::hemicube:
        return hemicube_edge.at(level);
    case FormFactorMethod::hemisphere:
        return hemisphere_rays.at(level);
    }
    return 0;
}

} // namespace

std::span<const ChartBudget> chart_budgets() {
    return budgets;
}

ChartBudget budget_of(const ChartMethod& method, std::size_t level) {
    ChartBudget budget = budgets.at(level);
    budget.samples = samples_of(method.form_factors, level);
    return budget;
}

} // namespace lueur
