// Reflectances sampled at a few wavelengths, the light's spectrum folded into the weights to XYZ.
//
// Radiosity is linear in the sources and independent at each wavelength: with unit emission the solution at a
// wavelength holds sums of products of reflectances, which are smooth; only the light may be spiky. So a colour is
// sum_k weight[light][k] * product(nm[k]), with weights fitted, light by light, by least squares of CIEDE2000 to the
// scene's own paints and their products (and, with a small weight, to a family of smooth edges, so that a paint that
// comes later is not far off). White keeps its XYZ and watts exactly. A line spectrum costs nothing extra, and the
// light may change without any solve.
#pragma once

#include <memory>
#include <vector>

#include "core/spectrum/spectral_content.h"
#include "core/spectrum/wavelengths.h"

namespace lueur {

struct FoldedWeights {        // of one light
    std::vector<Xyz> xyz;     // one a sample, without Km: of the light as it is given, nm times its unit
    std::vector<double> watt; // its integral over 380..780 nm
};

class FoldedFit {
public:
    explicit FoldedFit(const SpectralContent& content);
    ~FoldedFit();
    FoldedFit(FoldedFit&&) noexcept;
    FoldedFit& operator=(FoldedFit&&) noexcept;

    // All nm are on a grid of 5 nm, 380..780.
    // Wavelengths, increasing, for that many samples: grown greedily from a good smaller set, or evenly spaced, and
    // then exchanged one by one for their neighbours on the grid while that lowers the misfit.
    std::vector<double> choose(int count) const; // remembers the smaller sets: not for two threads at a time
    // Moves each wavelength to its neighbour on the grid where that makes the worst colour difference smaller, until it
    // is `enough`.
    std::vector<double> polish(std::vector<double> nm, double enough) const;
    FoldedWeights weights(std::size_t light, const std::vector<double>& nm) const;
    // Worst CIEDE2000 of the products that were fitted, over all lights, with weights of plain least squares: an upper
    // bound, quickly found, of what weights() reaches.
    double least_squares_worst(const std::vector<double>& nm) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lueur
