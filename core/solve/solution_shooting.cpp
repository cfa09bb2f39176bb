// Progressive shooting in a solution: luminaires first, then the patch with most unshot flux, as long as it matters.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/solve/restriction.h"
#include "core/solve/solution_steps.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr double unshot_part = 0.2; // of the target error that flux left unshot may take

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

} // namespace

void start_shooting(State& s) {
    if (!s.refined) {
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
    s.shooting = Shooting(*s.world, s.mesh, s.origins, s.buried, std::move(direct), std::move(flux), rho_of_patches(s),
                          std::move(weight), s.scene->solve.seed);
    s.solving = true;
    s.status.shots = 0;
    s.phase = SolvePhase::solve;
}

void step_shooting(State& s, const std::atomic<bool>& cancel, bool one_shot) {
    s.status.stage = SolveStage::solving;
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t rays_before = s.shooting.rays();
    // What is unshot would be reflected on and on: at most unshot / (1 - rho_ave) of the flux is missing.
    const double absorbed = std::max(1e-3, 1 - s.shooting.mean_reflectance());
    const double enough = unshot_part * s.scene->solve.target_error * absorbed;
    bool more = true;
    do {
        more = s.shooting.shoot();
    } while (more && !one_shot && s.shooting.unshot_share() > enough && !cancel.load(std::memory_order_relaxed) &&
             s.shooting.luminaires_shot() == s.direct->emitter_count() &&
             std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < step_seconds);
    s.status.rays += s.shooting.rays() - rays_before;
    s.status.shots = s.shooting.shots();
    s.status.shooting_patch = s.shooting.last_shooter();
    s.status.unshot_share = s.shooting.unshot_share();
    const double unsolved = s.status.unshot_share / absorbed;
    s.status.estimated_error = std::min(1.0, std::hypot(unsolved, s.direct->misfit()));
    if (!more || s.shooting.unshot_share() <= enough) settle(s);
}

} // namespace lueur
