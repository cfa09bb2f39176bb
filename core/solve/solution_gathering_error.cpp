// What the gathering solver knows of its own error: from independent sets of rays and from what is not solved yet.
#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "core/solve/gathering_sources.h"
#include "core/solve/least_absorbed.h"
#include "core/solve/solution_steps.h"

namespace lueur {

namespace {

using State = Solution::State;

// Of all the light that arrives in the end, the share that is still missing: each unit of the residual is reflected on,
// 1 / (1 - rho_ave) times if nothing is lost.
double gathering_missing_share(const State& s, const std::vector<float>& areas, const std::vector<float>& light) {
    double arriving = 0;
    for (std::uint32_t i = 0; i < s.receivers.count(); ++i) arriving += double(areas[i]) * double(light[i]);
    const double absorbed = std::max(least_absorbed, 1 - mean_luminous_reflectance(s) * mean_lit_share(s));
    const double missing = s.status.unshot_share * s.status.emitted_lumens / absorbed;
    return missing > 0 ? missing / (missing + arriving) : 0;
}

} // namespace

void take_stock_of_gathering(State& s) {
    if (!std::exchange(s.rays_unjudged, false)) return;
    const std::uint32_t receivers = s.receivers.count();
    ScalarRadiosity radiosity{std::vector<float>(receivers), std::vector<float>(fine_vertices_of_rays(s))};
    tbb::parallel_for(std::uint32_t(0), receivers, [&](std::uint32_t i) {
        radiosity.indirect[i] = static_cast<float>(luminous(s, s.system.radiosity()[i]));
    });
    // Direct irradiance and its reflection on each paint, the luminous part of both: of what each luminaire sends.
    std::vector<double> sent;
    std::vector<std::vector<double>> reflected(s.material_rho.size());
    for (const std::vector<double>& exitance : s.luminaire_exitance) {
        sent.push_back(0);
        for (std::size_t c = 0; c < s.wavelengths->xyz_weight.size(); ++c)
            sent.back() += s.wavelengths->xyz_weight[c].y * exitance[c];
        for (std::size_t m = 0; m < reflected.size(); ++m) {
            reflected[m].push_back(0);
            for (std::size_t c = 0; c < s.wavelengths->xyz_weight.size(); ++c)
                reflected[m].back() += s.wavelengths->xyz_weight[c].y * exitance[c] * s.material_rho[m][c];
        }
    }
    const auto arriving = [&](std::uint32_t v, const std::vector<double>& of_luminaires) {
        double sum = 0;
        s.direct->each_share(v, [&](const DirectShare& share, float part) {
            sum += double(part) * double(share.factor) * of_luminaires[share.emitter];
        });
        return static_cast<float>(sum);
    };
    std::vector<float> light(receivers, 0);
    tbb::parallel_for(std::uint32_t(0), receivers, [&](std::uint32_t i) {
        light[i] = arriving(s.receivers.vertex[i], sent) +
                   static_cast<float>(luminous(s, s.gathered_direct[i]) + luminous(s, s.system.gathered()[i]));
    });
    tbb::parallel_for(std::uint32_t(0), static_cast<std::uint32_t>(radiosity.direct.size()), [&](std::uint32_t v) {
        radiosity.direct[v] = arriving(v, reflected[s.material_of(s.mesh.vertices[v].surface)]);
    });

    const SmoothedReceivers smoothed = smoothed_receivers(s);
    s.indirect_deviation = smoothed.of(half_differences(s.passes, radiosity));
    for (float& d : s.indirect_deviation) d = std::abs(d);
    const std::vector<float> areas = receiver_areas(s);
    const double unsolved = gathering_missing_share(s, areas, light);
    const double rays =
        s.passes.size() % independent_sets == 0 ? relative_ray_error(light, s.indirect_deviation, areas, smoothed) : 1;
    const double interpolation = s.direct->misfit();
    s.status.estimated_error =
        std::min(1.0, std::sqrt(rays * rays + unsolved * unsolved + interpolation * interpolation));
}

} // namespace lueur
