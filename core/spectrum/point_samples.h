// The lecture's few, unequal wavelengths, at which light and reflectance alike are sampled at points: XYZ = Km * sum_k
// weight_k E(nm_k) rho(nm_k).
//
// They are exact for products that are polynomials of a low degree, and fail for spiky lamps, whose lines fall between
// the samples: kept for comparison (core/spectrum/folded_samples.h does better for every lamp).
#pragma once

#include <span>
#include <vector>

#include "core/spectrum/wavelengths.h"

namespace lueur {

struct PointSamples {
    std::vector<double> nm;    // increasing
    std::vector<Xyz> weight;   // nm, without Km
    std::vector<double> width; // nm: the cell of 380..780 nm that each stands for, for watts
};

// Meyer 1988, "Wavelength Selection for Synthetic Image Generation" (CVGIP 41): Gaussian quadrature under the axes of
// AC1C2, of orders in the measure of their importance. 4 samples: C2 of order 1, C1 of 2, A of 3 with its outer nodes
// moved to C1's (456.4, 490.9, 557.7, 631.4 nm). 6: orders 3, 2, 1 without the merger; 10: orders 4, 4, 2.
inline constexpr int meyer_counts[] = {4, 6, 10};
PointSamples meyer_samples(int count);

// Gaussian quadrature under xbar + ybar + zbar; each of X, Y, Z by interpolation through its nodes.
inline constexpr int fewest_gauss = 3, most_gauss = 20;
PointSamples gauss_samples(int count);

} // namespace lueur
