#include "core/spectrum/observer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/spectrum/observer_integral.h"
#include "core/spectrum/quadrature.h"

namespace lueur {

namespace {

using ObserverTable = std::array<std::array<double, 3>, observer_last_nm - observer_first_nm + 1>;

constexpr ObserverTable cie1931_table{{
#include "core/spectrum/observer_table.inc"
}};

constexpr ObserverTable cie1964_table{{
#include "core/spectrum/observer_1964_table.inc"
}};

const ObserverTable& table_of(Observer observer) {
    switch (observer) {
    case Observer::cie1931_2degree:
        return cie1931_table;
    case Observer::cie1964_10degree:
        return cie1964_table;
    }
    std::unreachable();
}

const std::vector<double>& observer_grid() {
    static const std::vector<double> grid = [] {
        std::vector<double> nm;
        for (int i = observer_first_nm; i <= observer_last_nm; ++i) nm.push_back(i);
        return nm;
    }();
    return grid;
}

} // namespace

Xyz observer_xyz(int nm, Observer observer) {
    if (nm < observer_first_nm || nm > observer_last_nm) return Xyz(0);
    const auto& row = table_of(observer)[static_cast<std::size_t>(nm - observer_first_nm)];
    return {row[0], row[1], row[2]};
}

Xyz observer_xyz(double nm, Observer observer) {
    if (!(nm >= observer_first_nm && nm <= observer_last_nm)) return Xyz(0);
    const int below = std::min(static_cast<int>(nm), observer_last_nm - 1);
    return glm::mix(observer_xyz(below, observer), observer_xyz(below + 1, observer), nm - below);
}

Xyz observer_integral(const Spectrum& spectrum, Outside outside, Observer observer) {
    double from = observer_first_nm, to = observer_last_nm;
    if (outside == Outside::zero) {
        from = std::max(from, first_nm(spectrum));
        to = std::min(to, last_nm(spectrum));
    }
    return integrate<Xyz>(breakpoints(from, to, {grid(spectrum), observer_grid()}),
                          [&](double nm) { return value_at(spectrum, nm, outside) * observer_xyz(nm, observer); });
}

Xyz xyz_from_spectrum(const Spectrum& emission, Observer observer) {
    return luminous_efficacy_km * observer_integral(emission, Outside::zero, observer);
}

} // namespace lueur
