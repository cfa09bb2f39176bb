#include "core/solve/error_missing.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/solve/solution_steps.h"

namespace lueur {

namespace {

using State = Solution::State;

// By probes: what a mean of as many may be by chance is no sign of anything missing.
double mean_by_probes(const std::vector<Residual>& probes, double rho) {
    const auto mean_square = [&](double Residual::*part) {
        double mean = 0, area = 0, noise = 0;
        for (const Residual& r : probes) mean += r.point->area * r.*part, area += r.point->area;
        mean /= area;
        for (const Residual& r : probes) {
            const double off = r.point->area / area * (r.*part - mean);
            noise += off * off;
        }
        return std::max(0.0, mean * mean - noise);
    };
    return std::sqrt(mean_square(&Residual::indirect) + mean_square(&Residual::unsent)) / (1 - rho);
}

// By what is unshot.
double mean_by_flux(const State& s, const ErrorMesh& mesh, const ErrorLight& light, double rho) {
    double flux = 0;
    const std::vector<float> unshot = s.solving ? s.unshot_at_vertices() : std::vector<float>{};
    for (std::uint32_t v = 0; v < light.total.size(); ++v) {
        if (mesh.buried[v]) continue;
        if (!s.solving)
            flux += double(mesh.area[v]) * light.reflected[v];
        else if (v < unshot.size())
            flux += double(unshot.size() == s.indirect_area.size() ? s.indirect_area[v] : s.coarse_area[v]) * unshot[v];
    }
    return mesh.seen_area > 0 ? light.caught * flux / mesh.seen_area / (1 - rho) : 0;
}

// The rays of a coarse vertex that told whether it is buried; none when they were not kept.
std::span<const RayHit> first_rays(const State& s, std::uint32_t v) {
    if (!s.around.hits.empty()) return std::span(s.around.hits).subspan(std::size_t(v) * burial_rays, burial_rays);
    if (s.passes.size() != 1 || s.passes[0].hits.empty()) return {};
    return std::span(s.passes[0].hits)
        .subspan(std::size_t(s.receivers.of_vertex[v]) * rays_per_pass, burial_rays); // gathering has them
}

// What arrives of `exitance` by these rays; `unknown` where there are none.
std::vector<float> gathered_by_first_rays(const State& s, std::span<const float> exitance, float unknown) {
    std::vector<float> arriving(exitance.size());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, s.mesh.coarse_vertex_count, 256), [&](const auto& range) {
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
            float sum = 0, traced = 0;
            for (const RayHit& hit : first_rays(s, i)) {
                if (hit.element == RayHit::untraced) continue;
                traced += 1;
                if (hit.element == no_index) continue;
                const glm::uvec3& v = s.mesh.nodes[hit.element].vertices; // of a coarse element: near enough
                sum += (1 - hit.b1 - hit.b2) * exitance[v.x] + hit.b1 * exitance[v.y] + hit.b2 * exitance[v.z];
            }
            arriving[i] = traced > 0 ? sum / traced : unknown;
        }
    });
    for (std::size_t v = s.mesh.coarse_vertex_count; v < arriving.size(); ++v) { // parents come first
        const auto& p = s.mesh.vertices[v].parents;
        arriving[v] = 0.5f * (arriving[p[0]] + arriving[p[1]]);
    }
    return arriving;
}

} // namespace

std::vector<float> missing_light(const State& s, const ErrorMesh& mesh, const ErrorLight& light,
                                 const std::vector<Residual>& probes, double rho) {
    double mean = probes.empty() ? mean_by_flux(s, mesh, light, rho) : mean_by_probes(probes, rho);
    if (!s.solving && probes.empty()) {
        // One reflection here, and what the others make of the second.
        const auto unknown = static_cast<float>(mean * (1 - rho)),
                   reflectance = static_cast<float>(mean_luminous_reflectance(s));
        std::vector<float> first = gathered_by_first_rays(s, light.reflected, unknown), again = first;
        for (float& h : again) h *= reflectance;
        again = gathered_by_first_rays(s, again, static_cast<float>(rho) * unknown);
        for (std::size_t v = 0; v < first.size(); ++v) first[v] += again[v] / static_cast<float>(1 - rho);
        return first;
    }
    // Probes read the field they judge: what shots have lost between walls a millimetre apart is not seen from within.
    if (s.solver() == SolverKind::shooting && s.solving) mean = std::hypot(mean, light.mean * s.shooting.lost_share());
    // It is missing in proportion to what is there already, as far as anything is.
    std::vector<float> missing(light.total.size(), 0);
    const double mean_indirect = std::max(0.0, light.mean_indirect);
    for (std::size_t v = 0; v < missing.size() && mean > 0; ++v)
        missing[v] =
            static_cast<float>(mean * (std::max(0.0, double(light.indirect[v])) + mean) / (mean_indirect + mean));
    return missing;
}

} // namespace lueur
