// What the gathering solver makes of a solution's paints, luminaires and rays before it solves: for its own files.
#pragma once

#include "core/solve/ray_budget.h"
#include "core/solve/solution_state.h"

namespace lueur {

inline constexpr double residual_target = 2e-4;             // |r| / |b|, worst channel
inline constexpr std::uint32_t most_gathering_sweeps = 400; // a system that needs more does not converge

ChannelField rho_of_receivers(const Solution::State& s);
// Area that each receiver stands for, m^2; 0 for buried ones.
std::vector<float> receiver_areas(const Solution::State& s);

// Fine vertices that rays may end at: those there were when the rays were traced. The mesh may have grown since.
std::uint32_t fine_vertices_of_rays(const Solution::State& s);
// Direct light reflected at the fine vertices: rho D E; the row after those that rays end at is zero. Luminaires
// without any channels are left out.
ChannelField reflected_direct(const Solution::State& s, const Exitances& exitance);

SmoothedReceivers smoothed_receivers(const Solution::State& s);
LightBasesRoom room_for_bases(const Solution::State& s);

} // namespace lueur
