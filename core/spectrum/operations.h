// Sums and products of spectra, on the union of their grids: no line of either is lost.
//
// Where a result jumps (the edge of a bin, the end of a grid) it has two samples that are neighbouring floating-point
// numbers, so that every result is one piecewise linear spectrum.
#pragma once

#include "core/spectrum/spectrum.h"

namespace lueur {

Spectrum scaled(const Spectrum& spectrum, double factor); // on its own grid, linear or bin as it was

// Exact.
Spectrum sum(const Spectrum& a, const Spectrum& b, Outside outside = Outside::zero);

// A light times a reflectance, unless said otherwise. Exact where one of them is made of bins or is constant; the
// product of two slopes is a parabola, which gets as many samples as hold the error under 1e-5 of the product's largest
// value. To integrate a product exactly cut at both grids (quadrature.h) instead.
Spectrum product(const Spectrum& a, const Spectrum& b, Outside a_outside = Outside::zero,
                 Outside b_outside = Outside::constant);

// The same spectrum as linear pieces, exactly.
Spectrum piecewise_linear(const Spectrum& spectrum);

} // namespace lueur
