#include "core/spectrum/visible_grid.h"

#include <algorithm>
#include <cmath>

#include "core/spectrum/quadrature.h"

namespace lueur {

VisibleGrid on_visible_grid(const Spectrum& spectrum, Outside outside) {
    VisibleGrid values;
    for (int j = 0; j < visible_count; ++j)
        values[static_cast<std::size_t>(j)] = value_at(spectrum, observer_first_nm + j, outside);
    return values;
}

VisibleGrid moments_on_visible_grid(const Spectrum& emission, double first_nm, double last_nm) {
    VisibleGrid moments{};
    if (emission.nm.empty()) return moments;
    static const std::vector<double> whole = [] {
        std::vector<double> nm;
        for (int j = observer_first_nm; j <= observer_last_nm; ++j) nm.push_back(j);
        return nm;
    }();
    const std::vector<double> own = grid(emission);
    const double from = std::max({double(observer_first_nm), first_nm, own.front()}),
                 to = std::min({double(observer_last_nm), last_nm, own.back()});
    const std::vector<double> points = breakpoints(from, to, {own, whole});
    // Two Gauss points an interval: exact to cubics, and never on a bin's edge.
    const double half_gap = 0.5 / std::sqrt(3.0);
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double a = points[i - 1], b = points[i], width = b - a;
        const int left = std::min(static_cast<int>(std::floor((a + b) / 2)) - observer_first_nm, visible_count - 2);
        for (const double t : {0.5 - half_gap, 0.5 + half_gap}) {
            const double nm = a + t * width, part = nm - (left + observer_first_nm);
            const double power = 0.5 * width * value_at(emission, nm, Outside::zero);
            moments[static_cast<std::size_t>(left)] += (1 - part) * power;
            moments[static_cast<std::size_t>(left) + 1] += part * power;
        }
    }
    return moments;
}

} // namespace lueur
