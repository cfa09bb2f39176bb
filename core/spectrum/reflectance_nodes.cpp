#include "core/spectrum/reflectance_nodes.h"

#include <algorithm>
#include <vector>

#include "core/spectrum/quadrature.h"

namespace lueur {

NodeWeights node_weights(const Spectrum& light) {
    NodeWeights weights{}; // glm leaves what it is not told to set
    weights.fill(Xyz(0));
    std::vector<double> whole_nm;
    for (int nm = observer_first_nm; nm <= observer_last_nm; ++nm) whole_nm.push_back(nm);
    const double from = std::max<double>(observer_first_nm, first_nm(light));
    const double to = std::min<double>(observer_last_nm, last_nm(light));
    const std::vector<double> points = breakpoints(from, to, {grid(light), whole_nm}); // the nodes are whole nm too
    for (std::size_t i = 1; i < points.size(); ++i) {
        const std::array interval{points[i - 1], points[i]};
        const double step = node_nm(1) - node_nm(0);
        const auto place = [&](double nm) { return std::clamp((nm - node_nm(0)) / step, 0.0, node_count - 1.0); };
        const auto below = std::min(static_cast<std::size_t>(place((interval[0] + interval[1]) / 2)),
                                    static_cast<std::size_t>(node_count - 2));
        const auto lit = [&](double nm) { return value_at(light, nm, Outside::zero) * observer_xyz(nm); };
        const Xyz all = integrate<Xyz>(interval, lit);
        const Xyz above =
            integrate<Xyz>(interval, [&](double nm) { return (place(nm) - static_cast<double>(below)) * lit(nm); });
        weights[below] += all - above;
        weights[below + 1] += above;
    }
    return weights;
}

} // namespace lueur
