// The reference: irradiance at a point by paths, unbiased, without any row, interpolation or solved field. It meets the
// coarse elements only as triangles.
//
// Paths are cosine-distributed; light is found twice, by a point of a luminaire and by the ray that goes on, weighted
// by the balance heuristic (Veach & Guibas 1995), so that the variance stays bounded where a lamp touches a wall.
// Russian roulette on the largest reflectance from the third bounce on (Kajiya 1986; Arvo & Kirk 1990). Paths belong to
// independent batches, each a quasi-random sequence of its own: their spread is the standard error.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "core/solve/solution_state.h"

namespace lueur {

inline constexpr int path_batches = 16;

// What paths need to know of luminaires; made once for a solution's sources.
struct PathLights {
    std::vector<double> flux;                // luminous, of each luminaire: bounces choose by it
    double total = 0;                        // 0: nothing shines
    std::vector<std::vector<double>> source; // exitance per channel, trichromatic channels last
};
PathLights make_path_lights(const Solution::State& state);

// Adds what path number `path` of batch `batch` brings to the point (already off its surface): irradiance per channel,
// as many channels as `irradiance` has room for. The point's seed decides its sequences. Returns its illuminance.
// cut_short: set where the path had to be ended, which biases it.
double trace_path(const Solution::State& state, const PathLights& lights, glm::vec3 origin, glm::vec3 normal,
                  std::uint32_t seed, std::uint32_t batch, std::uint32_t path, std::span<double> irradiance,
                  bool* cut_short = nullptr);

struct PathEstimate {
    std::vector<double> channels; // irradiance, without trichromatic channels
    double illuminance = 0;       // lx
    double standard_error = 0;    // lx, of the batches' mean
};

// `paths` are shared out evenly, at least one a batch. Stops early (with numbers of no use) when cancelled.
PathEstimate trace_irradiance(const Solution::State& state, const PathLights& lights, glm::vec3 origin,
                              glm::vec3 normal, int paths, std::uint32_t seed, const std::atomic<bool>& cancel);

// Standard error of the mean of independent batches.
double standard_error_of_batches(std::span<const double> means);

// Student's t over the normal quantile for this many batches less one, 95 %: a standard error from few batches times
// this, times 1.96, is a 95 % interval.
inline constexpr double batch_interval_factor = 2.1314 / 1.9600; // 15 degrees of freedom

} // namespace lueur
