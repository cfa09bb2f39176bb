// Hierarchical radiosity in a solution: links made and refined, then gathered over, pushed and pulled.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/solve/least_absorbed.h"
#include "core/solve/restriction.h"
#include "core/solve/solution_steps.h"
#include "core/transport/time_slice.h"

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
            s.direct->add_factors(at.vertices[k], at.weights[k] / sum, {factors, emitters});
        }
        if (sum > 0) return;
    }
    std::uint64_t rays = 0;
    for (std::size_t l = 0; l < emitters; ++l)
        factors[l] = direct_form_factor(*s.world, s.direct->emitters()[l], position, normal,
                                        VisibilityDetail::whole_cells, rays);
}

void begin_to_show(State& s) {
    std::vector<double> luminous;
    for (const Xyz& w : s.wavelengths->xyz_weight) luminous.push_back(w.y);
    s.making_shown =
        std::async(std::launch::async, [&hierarchy = *s.hierarchy, &leaves = *s.leaf_mesh, &elements = s.mesh.elements,
                                        channels = s.channels(), luminous = std::move(luminous)] {
            State::ShownLeaves shown;
            shown.view = std::make_shared<const HierarchyView>(view_hierarchy(hierarchy, luminous));
            std::vector<std::uint8_t> inside;
            shown.irradiance = irradiance_at_vertices(hierarchy, leaves.readings(), channels, inside);
            fill_buried(elements, std::move(inside), shown.irradiance);
            return shown;
        });
}

// True when it is through.
bool show(State& s) {
    if (!s.making_shown.valid()) begin_to_show(s);
    if (!is_ready(s.making_shown)) return false;
    State::ShownLeaves shown = s.making_shown.get();
    if (std::exchange(s.sources_wait, false)) { // it was of other light
        s.hierarchy->set_sources(sources_of(s));
        return true;
    }
    s.hierarchy_view = std::move(shown.view);
    s.indirect_irradiance = std::move(shown.irradiance);
    s.shown_round = s.hierarchy->rounds();
    return true;
}

// New vertices show what their parents do until they have their own.
void take_mesh(State& s) {
    s.mesh = s.leaf_mesh->mesh();
    s.direct->follow_mesh();
    const std::uint32_t before = s.indirect_irradiance.count;
    if (before > s.mesh.coarse_vertex_count) {
        ChannelField& h = s.indirect_irradiance;
        h.count = static_cast<std::uint32_t>(s.mesh.vertices.size());
        h.values.resize(std::size_t(h.count) * static_cast<std::size_t>(h.stride), 0.0f);
        for (std::uint32_t v = before; v < h.count; ++v) {
            const auto& p = s.mesh.vertices[v].parents;
            for (int c = 0; c < h.stride; ++c) h[v][c] = 0.5f * (h[p[0]][c] + h[p[1]][c]);
        }
    }
    s.passes.clear(); // their rays end at vertices of the mesh before
    s.pass_open = false;
    publish_mesh(s);
}

// New leaves: the mesh is cut as finely, its vertices get their direct light, and read the leaves. One part a step.
void step_show_leaves(State& s, const std::atomic<bool>& cancel) {
    using Part = State::ShowLeaves;
    const ElementTree& tree = s.hierarchy->tree();
    switch (s.show_leaves) {
    case Part::no:
        return;
    case Part::make:
        if (s.making_leaf_mesh.valid()) {
            if (!is_ready(s.making_leaf_mesh)) return;
            s.leaf_mesh = s.making_leaf_mesh.get();
        }
        s.leaf_mesh->begin();
        s.show_leaves = Part::cut;
        return;
    case Part::cut: {
        const auto most = static_cast<std::uint32_t>(std::max<std::size_t>(
            s.direct->lit_vertices(), s.mesh.coarse_vertex_count + std::size_t(vertices_for_leaves)));
        if (!s.leaf_mesh->cut(tree, most, cancel)) return;
        s.show_leaves = Part::light;
        if (s.leaf_mesh->mesh().vertices.size() == s.mesh.vertices.size()) return;
        take_mesh(s);
        return;
    }
    case Part::light:
        if (s.direct_light_apart() && !s.direct->light_vertices(cancel)) return;
        s.show_leaves = Part::read;
        return;
    case Part::read:
        if (!s.leaf_mesh->read(tree, cancel)) return;
        s.show_leaves = Part::values;
        return;
    case Part::values:
        if (show(s)) s.show_leaves = Part::no;
        return;
    }
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
    const double absorbed = std::max(least_absorbed, 1 - mean_luminous_reflectance(s));
    s.status.unshot_share = std::min(1.0, h.residual() / absorbed);
    const double direct = s.direct_light_apart() ? s.direct->misfit() : 0;
    s.status.estimated_error = std::min(1.0, std::hypot(h.estimated_error(), direct));
    s.status.progress = h.progress();
}

// The links are made and solved over. What remains is what the vertices get of them themselves. How many factors that
// takes is counted before the memory is, once for the links there are.
void step_final_gather(State& s, const std::atomic<bool>& cancel) {
    if (!s.direct_light_apart()) return settle(s);
    if (s.final_round != s.hierarchy->rounds()) {
        s.final_gather.reset();
        s.final_count = {};
        s.final_counted = s.final_done = false;
        s.status.final_gather_bytes = 0;
        s.final_round = s.hierarchy->rounds();
    }
    if (!s.final_counted) {
        s.final_counted =
            FinalGather::count_factors(*s.hierarchy, s.leaf_mesh->readings(), s.all_buried(), cancel, s.final_count);
        if (!s.final_counted) return;
        s.status.final_gather_bytes = FinalGather::bytes(s.final_count.factors);
        s.final_done = s.final_count.factors > FinalGather::most_factors;
        return; // the status says what it will take before it is taken
    }
    if (!s.final_done) {
        if (!s.final_gather) {
            s.vertex_origins = ray_origins(s.mesh, s.world->epsilon());
            s.final_gather = std::make_unique<FinalGather>(s.mesh, s.vertex_origins, s.leaf_mesh->readings(),
                                                           s.all_buried(), s.final_count.factors);
            return;
        }
        const std::uint64_t rays = s.final_gather->rays();
        s.final_done = s.final_gather->trace(*s.world, *s.hierarchy, cancel);
        s.status.rays += s.final_gather->rays() - rays;
        s.status.progress = s.final_gather->progress();
        if (!s.final_done) return;
    }
    if (s.final_gather) {
        if (s.final_irradiance.count == 0) {
            s.final_irradiance = ChannelField(static_cast<std::uint32_t>(s.mesh.vertices.size()), s.channels());
            s.final_cursor = 0;
        }
        if (!s.final_gather->gather(*s.hierarchy, cancel, s.final_cursor, s.final_irradiance)) return;
        s.indirect_irradiance = std::exchange(s.final_irradiance, {});
        fill_buried(s.mesh.elements, s.all_buried(), s.indirect_irradiance);
    } else if (s.status.message.empty()) {
        s.status.message = fmt::format(
            "the last gather at the vertices would take {}, and {} are allowed: shadows of indirect light "
            "are as coarse as the links",
            bytes_text(s.status.final_gather_bytes), bytes_text(FinalGather::bytes(FinalGather::most_factors)));
    }
    settle(s);
}

} // namespace

void start_hierarchical(State& s, bool same_sources) {
    if (absorbs_nothing(s)) return fail(s, no_finite_solution);
    if (s.direct_light_apart() && !s.fully_refined()) {
        s.phase = SolvePhase::refine;
        return;
    }
    s.final_irradiance = {}; // was of other light
    const SolveSettings& solve = s.scene->solve;
    if ((!s.hierarchy && !s.making_hierarchy.valid()) || !s.solving) {
        HierarchySettings settings;
        settings.oracle = solve.oracle;
        settings.tolerance = solve.link_tolerance;
        settings.target_error = s.direct_light_apart() ? direct_share * solve.target_error : solve.target_error;
        settings.smallest_area = static_cast<float>(s.element_size * s.element_size / 16);
        DirectAt direct;
        if (s.direct_light_apart())
            direct = [&s](glm::vec3 p, glm::vec3 n, float* factors) { direct_at(s, p, n, factors); };
        s.making_shown = {}; // waits for it: it reads what goes
        s.sources_wait = false;
        s.hierarchy.reset();
        s.making_hierarchy = std::async(
            std::launch::async, [scene = s.scene, world = s.world, settings, direct = std::move(direct)]() mutable {
                return std::make_unique<Hierarchy>(*scene, *world, settings, std::move(direct));
            });
        s.making_leaf_mesh = {};
        s.final_gather.reset();
        s.final_round = 0;
        s.leaf_mesh.reset();
        s.shown_round = 0;
        s.show_leaves = State::ShowLeaves::no;
        s.indirect_irradiance = ChannelField(s.mesh.coarse_vertex_count, s.channels());
        same_sources = false;
    }
    if (!same_sources && s.hierarchy) { // else when it is there
        s.sources_wait = s.making_shown.valid();
        if (!s.sources_wait) s.hierarchy->set_sources(sources_of(s));
    }
    s.solving = true;
    s.status.sweeps = 0;
    s.phase = SolvePhase::solve;
}

void make_links(State& s, const std::atomic<bool>&) {
    s.phase = SolvePhase::solve; // links are made and solved over in turn
}

void step_hierarchical(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::solving;
    if (s.making_hierarchy.valid()) {
        if (!is_ready(s.making_hierarchy)) return;
        s.hierarchy = s.making_hierarchy.get();
        if (!s.hierarchy->failure().empty()) return fail(s, s.hierarchy->failure());
        s.hierarchy->set_sources(sources_of(s));
    }
    Hierarchy& h = *s.hierarchy;
    if (s.show_leaves != State::ShowLeaves::no) return step_show_leaves(s, cancel);
    if (h.settled()) return step_final_gather(s, cancel);
    const std::uint64_t rays = h.rays();
    const std::uint32_t sweeps = h.sweeps();
    h.step(cancel);
    s.status.rays += h.rays() - rays;
    if (!h.failure().empty()) return fail(s, h.failure());
    report(s);
    if (h.sweeps() == sweeps) return;
    if (!h.refining() && h.rounds() != s.shown_round) {
        if (!s.leaf_mesh)
            s.making_leaf_mesh =
                std::async(std::launch::async, [mesh = s.published_mesh] { return std::make_unique<LeafMesh>(*mesh); });
        s.show_leaves = State::ShowLeaves::make;
    } else if (h.settled()) {
        s.show_leaves = State::ShowLeaves::values; // other light on the same links
    }
}

} // namespace lueur
