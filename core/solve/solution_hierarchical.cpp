// Hierarchical radiosity in a solution: links made and refined, then gathered over, pushed and pulled.
#include <algorithm>
#include <cmath>

#include "core/solve/restriction.h"
#include "core/solve/solution_steps.h"

namespace lueur {

namespace {

constexpr std::uint32_t vertices_for_leaves = 40000; // that leaves may add to the mesh: the window has to draw them
constexpr double direct_share = 0.5; // of the target error that interpolation of direct light is left with

using State = Solution::State;

HierarchySources sources_of(const State& s) {
    HierarchySources sources;
    for (std::uint32_t surface = 0; surface < s.scene->geometry->surfaces.size(); ++surface)
        sources.surface_material.push_back(s.material_of(surface));
    sources.material_rho = s.material_rho;
    sources.luminaire_exitance = s.luminaire_exitance;
    for (std::uint32_t r = 0; r < s.hierarchy->tree().root_count; ++r) {
        const ElementNode& root = s.hierarchy->tree().nodes[r];
        sources.root_luminaire.push_back(s.luminaire_of(root.surface, root.back));
    }
    sources.weight = flux_weights(s);
    return sources;
}

// Direct light as the fine mesh has it; where a ray down to the surface does not find it, anew.
void direct_at(const State& s, glm::vec3 position, glm::vec3 normal, float* factors) {
    const std::size_t emitters = s.direct->emitter_count();
    std::fill_n(factors, emitters, 0.0f);
    const float lift = static_cast<float>(0.05 * s.element_size);
    const Hit hit = s.world->closest({position, -normal, 0, lift});
    if (hit.element != no_index) {
        const Located at = locate(s.mesh, hit.element, hit.b1, hit.b2);
        float sum = 0;
        for (int k = 0; k < 3; ++k)
            if (!s.direct->buried()[at.vertices[k]]) sum += at.weights[k];
        for (int k = 0; k < 3; ++k) {
            if (s.direct->buried()[at.vertices[k]] || !(sum > 0)) continue;
            const float* d = s.direct->at_vertex(at.vertices[k]);
            for (std::size_t l = 0; l < emitters; ++l) factors[l] += at.weights[k] / sum * d[l];
        }
        if (sum > 0) return;
    }
    std::uint64_t rays = 0;
    for (std::size_t l = 0; l < emitters; ++l)
        factors[l] = direct_form_factor(*s.world, s.direct->emitters()[l], position, normal, rays);
}

void show_leaves(State& s, bool new_leaves) {
    const ElementTree& tree = s.hierarchy->tree();
    if (new_leaves) {
        const auto most = static_cast<std::uint32_t>(
            std::max<std::size_t>(s.mesh.vertices.size(), s.mesh.coarse_vertex_count + vertices_for_leaves));
        if (cut_mesh_to_leaves(tree, s.mesh, most)) {
            s.direct->follow_mesh(s.direct_light_apart());
            s.passes.clear(); // their rays end at vertices of the mesh before
            s.pass_open = false;
            publish_mesh(s);
        }
        s.leaf_readings = read_leaves(tree, s.mesh);
        s.hierarchy_view = std::make_shared<const HierarchyView>(view_hierarchy(*s.hierarchy));
    }
    std::vector<std::uint8_t> inside;
    s.indirect_irradiance = irradiance_at_vertices(*s.hierarchy, s.leaf_readings, s.channels(), inside);
    fill_buried(s.mesh.elements, std::move(inside), s.indirect_irradiance);
}

void report(State& s) {
    const Hierarchy& h = *s.hierarchy;
    s.status.links = h.link_count();
    s.status.link_elements = h.element_count();
    s.status.link_levels = h.level_count();
    s.status.link_rounds = h.rounds();
    s.status.sweeps = h.sweeps();
    s.status.residual = h.residual();
    s.status.error_bound = h.error_bound();
    const double absorbed = std::max(1e-3, 1 - mean_luminous_reflectance(s));
    s.status.unshot_share = std::min(1.0, h.residual() / absorbed);
    const double direct = s.direct_light_apart() ? s.direct->misfit() : 0;
    s.status.estimated_error = std::min(1.0, std::hypot(h.estimated_error(), direct));
    s.status.progress = h.progress();
}

} // namespace

void start_hierarchical(State& s, bool same_sources) {
    if (s.direct_light_apart() && !s.refined) {
        s.phase = SolvePhase::refine;
        return;
    }
    const SolveSettings& solve = s.scene->solve;
    if (!s.hierarchy || !s.solving) {
        HierarchySettings settings;
        settings.oracle = solve.oracle;
        settings.tolerance = solve.link_tolerance;
        settings.target_error = s.direct_light_apart() ? direct_share * solve.target_error : solve.target_error;
        settings.smallest_area = static_cast<float>(s.element_size * s.element_size / 16);
        DirectAt direct;
        if (s.direct_light_apart())
            direct = [&s](glm::vec3 p, glm::vec3 n, float* factors) { direct_at(s, p, n, factors); };
        s.hierarchy = std::make_unique<Hierarchy>(*s.scene, *s.world, settings, std::move(direct));
        if (!s.hierarchy->failure().empty()) return fail(s, s.hierarchy->failure());
        s.leaf_readings.clear();
        same_sources = false;
    }
    if (!same_sources) s.hierarchy->set_sources(sources_of(s));
    if (s.leaf_readings.empty()) s.indirect_irradiance = ChannelField(s.mesh.coarse_vertex_count, s.channels());
    s.solving = true;
    s.status.sweeps = 0;
    s.phase = SolvePhase::solve;
}

void make_links(State& s, const std::atomic<bool>&) {
    s.phase = SolvePhase::solve; // links are made and solved over in turn
}

void step_hierarchical(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::solving;
    const std::uint64_t rays = s.hierarchy->rays();
    const std::uint32_t sweeps = s.hierarchy->sweeps();
    const std::uint32_t shown = s.status.link_rounds;
    const bool more = s.hierarchy->step(cancel);
    s.status.rays += s.hierarchy->rays() - rays;
    if (!s.hierarchy->failure().empty()) return fail(s, s.hierarchy->failure());
    if (s.hierarchy->sweeps() != sweeps || !more) {
        show_leaves(s, s.hierarchy->rounds() != shown || s.leaf_readings.empty() || !more);
        report(s);
    }
    s.status.progress = s.hierarchy->progress();
    if (!more) settle(s);
}

} // namespace lueur
