// Integrals against the observer, without Km.
#pragma once

#include "core/spectrum/observer.h"

namespace lueur {

// Integral of spectrum * (xbar, ybar, zbar) over 360..830 nm, in nm times the spectrum's unit. Exact: both are
// piecewise linear.
Xyz observer_integral(const Spectrum& spectrum, Outside outside, Observer observer = Observer::cie1931_2degree);

} // namespace lueur
