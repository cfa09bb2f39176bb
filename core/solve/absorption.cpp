// Whether light that is sent out can end: what the scene's geometry and paints say of it before any solver has begun.
#include <algorithm>

#include "core/solve/least_absorbed.h"
#include "core/solve/solution_steps.h"

namespace lueur {

using State = Solution::State;

bool absorbs_nothing(const State& s) {
    if (!(s.status.emitted_lumens > 0)) return false;
    bool any = false;
    for (std::uint32_t v = 0; v < s.mesh.coarse_vertex_count; ++v) {
        if (s.buried[v]) continue;
        if (s.around.lit[v] < burial_rays) return false;
        const std::vector<double>& rho = s.material_rho[s.material_of(s.mesh.vertices[v].surface)];
        if (rho.empty() || *std::min_element(rho.begin(), rho.end()) < 1 - least_absorbed) return false;
        any = true;
    }
    return any;
}

double mean_lit_share(const State& s) {
    double lit = 0, area = 0;
    for (std::uint32_t v = 0; v < s.mesh.coarse_vertex_count; ++v) {
        if (s.buried[v]) continue;
        lit += double(s.coarse_area[v]) * s.around.lit[v] / burial_rays;
        area += double(s.coarse_area[v]);
    }
    return area > 0 ? lit / area : 0;
}

} // namespace lueur
