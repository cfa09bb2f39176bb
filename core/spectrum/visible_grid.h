// Spectra on the observer's 1 nm grid, 360..830 nm: what long lists of products are integrated on.
#pragma once

#include <array>

#include "core/spectrum/observer.h"

namespace lueur {

inline constexpr int visible_count = observer_last_nm - observer_first_nm + 1;
inline constexpr int visible_first_nm = 380, visible_last_nm = 780; // of what is said to be light: lamps' watts, white
using VisibleGrid = std::array<double, visible_count>;

VisibleGrid on_visible_grid(const Spectrum& spectrum, Outside outside); // values at whole nanometres

// m_j = integral of emission * hat_j, hat_j the linear hat of width 1 nm either side of the j-th nanometre: then
// sum_j m_j f_j is the integral of emission * f for every f that is linear between whole nanometres, whatever lines the
// emission has between them. Only what is emitted from `first_nm` to `last_nm` counts.
VisibleGrid moments_on_visible_grid(const Spectrum& emission, double first_nm = observer_first_nm,
                                    double last_nm = observer_last_nm);

} // namespace lueur
