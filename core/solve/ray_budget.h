// How many gather rays a scene needs, and how wrong the rays there are leave a solution.
//
// Even and odd passes are two independent ray sets A and B of one size: the mean of their irradiances has the variance
// (H_A - H_B)^2 / 4. One difference says little of one receiver, but much of thousands. The budget must not depend on
// paints or dimmers (or a solution after edits would differ from a fresh one): it is found with a grey stand-in, every
// surface 0.5 and luminaires as guessed_exitances has them, in one channel.
#pragma once

#include <span>
#include <vector>

#include "core/solve/smoothing.h"
#include "core/transport/gather_rows.h"

namespace lueur {

// What the rays carry, in one channel: radiosity by indirect light at the receivers (U of gather_system.h), by direct
// light at all vertices.
struct ScalarRadiosity {
    std::vector<float> indirect; // receivers
    std::vector<float> direct;   // all vertices
};

// What is shown at vertices of the receivers' values (smoothing.h).
struct SmoothedReceivers {
    std::span<const std::uint32_t> of_vertex, vertex; // as Receivers'
    const Smoothing& smoothing;
    std::vector<float> of(const std::vector<float>& at_receivers) const; // one a vertex
};

// Half the difference of the sets at each receiver: its square is the variance of their mean, and it goes through any
// linear map as the mean does. A single pass is taken for two sets, of every other ray: those are not independent, but
// spread evenly between each other, and so differ more than they err.
std::vector<float> half_differences(std::span<const GatherPass> passes, const ScalarRadiosity& radiosity);

// Relative RMS standard error over receivers brighter than 2 % of the mean: of their irradiances, and of what differs
// at vertices as shown. Receivers with weight 0 do not count.
double relative_ray_error(std::span<const float> irradiance, std::span<const float> shown_difference,
                          std::span<const float> weight, const SmoothedReceivers& smoothed);

// The same for the grey stand-in, which it solves. fine_direct: guessed irradiance at all vertices. An even number of
// passes, at least two, else 1.
double grey_ray_error(std::span<const GatherPass> passes, std::span<const float> fine_direct,
                      std::span<const float> weight, const SmoothedReceivers& smoothed);

} // namespace lueur
