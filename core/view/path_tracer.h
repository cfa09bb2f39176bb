// The reference: irradiance at a point by paths, unbiased, without any mesh, row or interpolation.
//
// Direct light by stratified area sampling of every luminaire; indirect light by cosine-distributed paths with one
// luminaire sample at each bounce and Russian roulette on the largest reflectance (Kajiya 1986; Arvo & Kirk 1990). It
// meets the coarse elements only as triangles.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "core/solve/solution_state.h"

namespace lueur {

// Irradiance per channel at a point (already off its surface); `luminous_batches` gets the illuminance of 8 independent
// eighths of the paths. Stops early (with numbers of no use) when cancelled.
std::vector<double> trace_irradiance(const Solution::State& state, glm::vec3 origin, glm::vec3 normal, int paths,
                                     std::uint32_t seed, const std::atomic<bool>& cancel,
                                     std::span<double, 8> luminous_batches);

} // namespace lueur
