// How far measured illuminances are from a reference, in one line of figures.
#pragma once

#include <span>

#include "core/solve/relative_error.h"
#include "core/view/measure.h"

namespace lueur {

// Relative errors (relative_error.h, as in the error that a solution states of itself, so that the two can be compared)
// over the points that the reference finds brighter than 2 % of its mean.
struct ErrorStatistics {
    double rms_of_truth = 0; // relative to the truth alone, as found: without a bound where more is shown than there is
    double rms = 0;          // as found: the reference's own noise is in it
    double median = 0;       // ditto
    double percentile95 = 0; // ditto
    // The reference is unbiased and its noise independent of what is measured: the mean square has its variance, as far
    // as it is in the error, which is taken off here.
    double rms_without_noise = 0; // never below `resolution`
    double reference_error = 0;   // RMS of the reference's relative standard errors
    double resolution = 0;        // resolution_of(reference_error, counted)
    int counted = 0;              // points with both figures
    int missing = 0;              // bright points that the method has no finite figure for
};

// What cannot be told from no error at all: the mean of n squares of normal errors s has the standard deviation
// s^2 sqrt(2 / n), and twice that may be left when the noise is taken off.
double resolution_of(double reference_error, int points);

// Both have one entry a point. Without any counted point all errors are 1.
ErrorStatistics error_statistics(std::span<const Irradiance> values, std::span<const Irradiance> reference);

} // namespace lueur
