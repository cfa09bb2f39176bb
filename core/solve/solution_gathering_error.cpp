// What the gathering solver knows of its own error: from independent sets of rays and from what is not solved yet.
#include <algorithm>
#include <cmath>

#include "core/solve/gathering_sources.h"
#include "core/solve/least_absorbed.h"
#include "core/solve/solution_steps.h"

namespace lueur {

namespace {

using State = Solution::State;

// Of all the light that arrives in the end, the share that is still missing: each unit of the residual is reflected on,
// 1 / (1 - rho_ave) times if nothing is lost.
double gathering_missing_share(const State& s, const std::vector<float>& areas, const std::vector<float>& direct) {
    double arriving = 0;
    for (std::uint32_t i = 0; i < s.receivers.count(); ++i)
        arriving += double(areas[i]) *
                    (double(direct[i]) + luminous(s, s.gathered_direct[i]) + luminous(s, s.system.gathered()[i]));
    const double absorbed = std::max(least_absorbed, 1 - mean_luminous_reflectance(s) * mean_lit_share(s));
    const double missing = s.status.unshot_share * s.status.emitted_lumens / absorbed;
    return missing > 0 ? missing / (missing + arriving) : 0;
}

} // namespace

void take_stock_of_gathering(State& s) {
    if (!std::exchange(s.rays_unjudged, false)) return;
    const std::uint32_t receivers = s.receivers.count();
    ScalarRadiosity radiosity{std::vector<float>(receivers), std::vector<float>(fine_vertices_of_rays(s))};
    for (std::uint32_t i = 0; i < receivers; ++i)
        radiosity.indirect[i] = static_cast<float>(luminous(s, s.system.radiosity()[i]));
    // Direct irradiance and its reflection, the luminous part of both.
    std::vector<float> direct(receivers, 0); // that of the rays is added below
    {
        ChannelField h(static_cast<std::uint32_t>(s.mesh.vertices.size()), s.channels());
        read_direct(s, s.luminaire_exitance, h);
        std::vector<std::vector<float>> reflected; // of each paint: what a channel's irradiance gives
        for (const std::vector<double>& rho : s.material_rho) {
            reflected.emplace_back();
            for (std::size_t c = 0; c < s.wavelengths->xyz_weight.size(); ++c)
                reflected.back().push_back(static_cast<float>(s.wavelengths->xyz_weight[c].y * rho[c]));
        }
        for (std::uint32_t i = 0; i < receivers; ++i)
            direct[i] = static_cast<float>(luminous(s, h[s.receivers.vertex[i]]));
        for (std::uint32_t v = 0; v < radiosity.direct.size(); ++v) {
            const std::vector<float>& on_paint = reflected[s.material_of(s.mesh.vertices[v].surface)];
            for (std::size_t c = 0; c < on_paint.size(); ++c) radiosity.direct[v] += on_paint[c] * h[v][c];
        }
    }

    const SmoothedReceivers smoothed = smoothed_receivers(s);
    s.indirect_deviation = smoothed.of(half_differences(s.passes, radiosity));
    for (float& d : s.indirect_deviation) d = std::abs(d);
    const std::vector<float> areas = receiver_areas(s);
    const double unsolved = gathering_missing_share(s, areas, direct);
    for (std::uint32_t i = 0; i < receivers; ++i)
        direct[i] += static_cast<float>(luminous(s, s.gathered_direct[i]) + luminous(s, s.system.gathered()[i]));
    const double rays =
        s.passes.size() % independent_sets == 0 ? relative_ray_error(direct, s.indirect_deviation, areas, smoothed) : 1;
    const double interpolation = s.direct->misfit();
    s.status.estimated_error =
        std::min(1.0, std::sqrt(rays * rays + unsolved * unsolved + interpolation * interpolation));
}

} // namespace lueur
