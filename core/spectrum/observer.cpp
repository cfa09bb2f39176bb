#include "core/spectrum/observer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/spectrum/observer_integral.h"
#include "core/spectrum/quadrature.h"

namespace lueur {

namespace {

constexpr std::array<std::array<double, 3>, observer_last_nm - observer_first_nm + 1> table{{
#include "core/spectrum/observer_table.inc"
}};

const std::vector<double>& observer_grid() {
    static const std::vector<double> grid = [] {
        std::vector<double> nm;
        for (int i = observer_first_nm; i <= observer_last_nm; ++i) nm.push_back(i);
        return nm;
    }();
    return grid;
}

} // namespace

Xyz observer_xyz(int nm) {
    if (nm < observer_first_nm || nm > observer_last_nm) return Xyz(0);
    const auto& row = table[static_cast<std::size_t>(nm - observer_first_nm)];
    return {row[0], row[1], row[2]};
}

Xyz observer_xyz(double nm) {
    if (!(nm >= observer_first_nm && nm <= observer_last_nm)) return Xyz(0);
    const int below = std::min(static_cast<int>(nm), observer_last_nm - 1);
    return glm::mix(observer_xyz(below), observer_xyz(below + 1), nm - below);
}

Xyz observer_integral(const Spectrum& spectrum, Outside outside) {
    if (spectrum.nm.empty()) return Xyz(0);
    double from = observer_first_nm, to = observer_last_nm;
    if (outside == Outside::zero) { // the jump to zero at the ends of the grid must not fall inside an interval
        from = std::max(from, spectrum.nm.front());
        to = std::min(to, spectrum.nm.back());
    }
    return integrate<Xyz>(breakpoints(from, to, {spectrum.nm, observer_grid()}),
                          [&](double nm) { return value_at(spectrum, nm, outside) * observer_xyz(nm); });
}

Xyz xyz_from_spectrum(const Spectrum& emission) {
    return luminous_efficacy_km * observer_integral(emission, Outside::zero);
}

} // namespace lueur
