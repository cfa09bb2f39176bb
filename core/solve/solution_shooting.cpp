// Progressive shooting in a solution: luminaires first, then the patch with most unshot flux, as long as it matters.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/solve/restriction.h"
#include "core/solve/solution_steps.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr double unshot_part = 0.1;            // of the target error that flux left unshot may take
constexpr double most_shots_of_a_patch = 1000; // on average
constexpr std::uint8_t gap_rays = 12;          // of burial_rays that end near by: next to one wall it is half of them

using State = Solution::State;

ChannelField rho_of_patches(const State& s) {
    ChannelField rho(static_cast<std::uint32_t>(s.mesh.patches.size()), s.channels());
    for (std::uint32_t p = 0; p < rho.count; ++p) {
        const auto& values = s.material_rho[s.material_of(s.mesh.vertices[s.mesh.patches[p].x].surface)];
        std::copy(values.begin(), values.end(), rho[p]);
    }
    return rho;
}

// Direct irradiance of one luminaire at the coarse vertices, of D restricted to them.
ChannelField direct_of(const State& s, const std::vector<float>& coarse_direct, std::size_t luminaire) {
    const std::size_t emitters = s.direct->emitter_count();
    ChannelField h(s.mesh.coarse_vertex_count, s.channels());
    for (std::uint32_t i = 0; i < h.count; ++i) {
        const float d = coarse_direct[i * emitters + luminaire];
        for (int c = 0; c < s.channels(); ++c) h[i][c] = d * static_cast<float>(s.luminaire_exitance[luminaire][c]);
    }
    return h;
}

Shooting::Scenery scenery_of(const State& s) {
    Shooting::Scenery scenery{s.origins, {}, s.buried, {}, std::vector<std::uint8_t>(s.luminaire_exitance.size(), 1),
                              1};
    for (std::size_t v = 0; v < s.around.lit.size(); ++v) {
        // Between walls a millimetre apart what slips out does so at the very rim, of which a vertex knows too much.
        const bool gap = s.around.near[v] >= gap_rays;
        const int lit = gap ? static_cast<int>(burial_rays) - s.around.back[v] : s.around.lit[v];
        scenery.lit.push_back(static_cast<float>(lit) / burial_rays);
        scenery.closed.push_back(s.around.lit[v] == burial_rays);
    }
    for (std::uint32_t v = 0; v < s.mesh.coarse_vertex_count; ++v)
        if (const auto l = s.luminaire_of(s.mesh.vertices[v].surface, s.mesh.vertices[v].back); l && !scenery.closed[v])
            scenery.luminaire_closed[*l] = 0;
    scenery.lit_share = mean_lit_share(s);
    return scenery;
}

} // namespace

void start_shooting(State& s) {
    if (absorbs_nothing(s)) return fail(s, no_finite_solution);
    if (!s.fully_refined()) {
        s.phase = SolvePhase::refine;
        return;
    }
    const std::vector<float> coarse_direct = restrict_direct(s.mesh, *s.direct);
    std::vector<ChannelField> direct;
    std::vector<double> flux;
    for (std::size_t l = 0; l < s.direct->emitter_count(); ++l) {
        direct.push_back(direct_of(s, coarse_direct, l));
        flux.push_back(0);
    }
    std::vector<float> weight = flux_weights(s);
    for (std::size_t l = 0; l < flux.size(); ++l)
        for (int c = 0; c < s.channels(); ++c)
            flux[l] += weight[c] * s.luminaire_exitance[l][c] * s.direct->emitters()[l].area;
    s.shooting = Shooting(*s.world, s.mesh, scenery_of(s), std::move(direct), std::move(flux), rho_of_patches(s),
                          std::move(weight), s.scene->solve.seed);
    s.solving = true;
    s.status.shots = 0;
    s.phase = SolvePhase::solve;
}

void step_shooting(State& s, const std::atomic<bool>& cancel, bool one_shot) {
    s.status.stage = SolveStage::solving;
    TimeSlice slice(cancel);
    const std::uint64_t rays_before = s.shooting.rays();
    const double enough = unshot_part * s.scene->solve.target_error;
    const double most = most_shots_of_a_patch * s.shooting.patches();
    // When it ends is counted in shots, never in time.
    const auto hopeless = [&] { return s.shooting.shots_needed(enough) > most || s.shooting.shots() > most; };
    bool more = true;
    do {
        more = s.shooting.shoot();
    } while (more && !one_shot && s.shooting.missing_share() > enough && !hopeless() &&
             s.shooting.luminaires_shot() == s.direct->emitter_count() && !slice.over());
    s.status.rays += s.shooting.rays() - rays_before;
    s.status.shots = s.shooting.shots();
    s.status.shooting_patch = s.shooting.last_shooter();
    s.status.unshot_share = s.shooting.unshot_share();
    s.status.estimated_error = std::min(1.0, std::hypot(s.shooting.missing_share(), s.direct->misfit()));
    if (!more || s.shooting.missing_share() <= enough) return settle(s);
    if (hopeless())
        fail(s, fmt::format("shooting would need about {:.2g} shots, {:.2g} are the limit: a reflectance is too close "
                            "to 1",
                            std::max(s.shooting.shots_needed(enough), most), most));
}

} // namespace lueur
