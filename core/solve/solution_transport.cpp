// What every solver stands on: mesh, rays' world, direct light, who is buried.
#include "core/solve/settled_words.h"
#include "core/solve/solution_steps.h"
#include "core/solve/solve_budgets.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr double near_share = 0.01;              // of the coarse element size: what is nearer, elements do not resolve
constexpr std::uint32_t first_direct_levels = 2; // before the first refined picture

using State = Solution::State;

float cell_of(double element_size) {
    return static_cast<float>(receiver_cell * element_size);
}

Room room_of(const State& s) {
    return is_crowded(s.mesh.coarse_vertex_count) ? Room::for_finer_levels : Room::as_far_as_it_goes;
}

// Cuts the mesh where indirect light needs more receivers than the coarse vertices; true at the end.
bool refine_indirect(State& s, const std::atomic<bool>& cancel) {
    if (s.indirect_level || s.refined) return true;
    if (!s.indirect_refinement)
        s.indirect_refinement = std::make_unique<IndirectRefinement>(
            *s.world, s.mesh, *s.direct, s.buried, s.around.distance,
            IndirectParams{.smallest_element = cell_of(s.element_size),
                           .smallest_edge = static_cast<float>(s.element_size / 8),
                           .most_vertices = s.mesh.coarse_vertex_count +
                                            contact_vertices(s.mesh.coarse_vertex_count, s.receivers.count()),
                           .room = room_of(s)});
    const std::uint64_t rays = s.indirect_refinement->rays();
    const bool done = s.indirect_refinement->step(cancel);
    s.status.rays += s.indirect_refinement->rays() - rays;
    if (s.direct->lit_vertices() != s.mesh.vertices.size()) s.direct->follow_mesh();
    if (!done) return false;
    s.indirect_level.emplace(static_cast<std::uint32_t>(s.mesh.vertices.size()),
                             static_cast<std::uint32_t>(s.mesh.nodes.size()), s.mesh.elements,
                             s.indirect_refinement->origins(), s.indirect_refinement->buried(),
                             s.indirect_refinement->distance());
    s.indirect_refinement.reset();
    return true;
}

State::MadeMesh make_mesh_and_world(const std::shared_ptr<const Scene>& scene, double element_size) {
    State::MadeMesh made;
    made.mesh = make_mesh(*scene, {element_size});
    made.world = std::make_shared<const World>(made.mesh);
    made.origins = ray_origins(made.mesh, made.world->epsilon());
    made.area = vertex_areas(made.mesh);
    made.published = std::make_shared<const Mesh>(made.mesh);
    if (is_sampled(made.mesh.coarse_vertex_count))
        made.samples =
            make_light_samples(*scene, made.mesh, *made.world, made.origins, cell_of(element_size), most_samples);
    return made;
}

void take_indirect_level(State& s) {
    Solution::State::IndirectLevel level = std::move(*s.indirect_level);
    s.mesh.indirect_vertex_count = level.vertices;
    s.mesh.indirect_node_count = level.nodes;
    s.mesh.indirect_elements = std::move(level.elements);
    s.indirect_area = vertex_areas(s.mesh, s.mesh.indirect_elements, level.vertices);
    s.origins.insert(s.origins.end(), level.origins.begin() + s.mesh.coarse_vertex_count, level.origins.end());
    s.buried.insert(s.buried.end(), level.buried.begin() + s.mesh.coarse_vertex_count, level.buried.end());
    s.indirect_distance = std::move(level.distance);
    add_receivers(level.vertices, s.buried, s.receivers);
    s.status.receivers = s.receivers.count();
}

} // namespace

void publish_mesh(State& s, std::shared_ptr<const Mesh> copy) {
    s.published_mesh = copy ? std::move(copy) : std::make_shared<const Mesh>(s.mesh);
    s.status.vertices = static_cast<std::uint32_t>(s.mesh.vertices.size());
    s.status.elements = static_cast<std::uint32_t>(s.mesh.elements.size());
}

void step_mesh(State& s) {
    s.status.stage = SolveStage::meshing;
    if (!s.left_meshes.empty()) { // one after the other: two would take the memory of both
        if (!is_ready(s.left_meshes.back())) return;
        s.left_meshes.clear();
    }
    if (!s.making_mesh.valid()) {
        s.element_size =
            s.scene->solve.element_size > 0 ? s.scene->solve.element_size : automatic_element_size(*s.scene);
        s.making_mesh = std::async(std::launch::async, make_mesh_and_world, s.scene, s.element_size);
    }
    if (!is_ready(s.making_mesh) || (s.choosing.valid() && !is_ready(s.choosing))) return;
    State::MadeMesh made = s.making_mesh.get();
    s.mesh = std::move(made.mesh);
    s.world = std::move(made.world);
    s.origins = std::move(made.origins);
    s.buried.assign(s.mesh.coarse_vertex_count, 0);
    s.around.lit.assign(s.mesh.coarse_vertex_count, 0);
    s.around.back = s.around.near = s.around.lit;
    s.around.distance.assign(s.mesh.coarse_vertex_count, 0);
    s.around.near_distance = static_cast<float>(near_share * s.element_size);
    if (!is_sampled(s.mesh.coarse_vertex_count) && s.solver() == SolverKind::gathering)
        s.around.hits.resize(std::size_t(s.mesh.coarse_vertex_count) * burial_rays);
    const DirectParams params{.smallest_edge = static_cast<float>(s.element_size / 8),
                              .element_size = static_cast<float>(s.element_size),
                              .most_vertices = s.mesh.coarse_vertex_count + fine_vertices(s.mesh.coarse_vertex_count),
                              .room = room_of(s)};
    s.direct =
        std::make_unique<DirectTransport>(*s.world, s.mesh, make_emitters(*s.scene), params, std::move(made.samples));
    s.coarse_area = s.indirect_area = std::move(made.area);
    make_channels(s);
    publish_mesh(s, std::move(made.published));
    s.cursor = 0;
    s.phase = SolvePhase::sketch;
}

void step_sketch(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::direct;
    if (!s.direct->sketch(cancel)) return;
    const bool light_takes_long = std::uint64_t(s.direct->row_count()) * s.direct->emitter_count() > most_lit_first;
    s.phase = s.solver() == SolverKind::gathering && light_takes_long ? SolvePhase::burial : SolvePhase::light;
}

void step_light(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::direct;
    if (!s.direct->light_vertices(cancel)) return;
    if (s.receivers.count() == 0) {
        s.phase = SolvePhase::burial;
        return;
    }
    // Solved for a guess of it: now for itself, on more rays.
    if (s.solver() == SolverKind::gathering && !s.passes.empty())
        want_more_coarse_passes(s);
    else
        start_solver(s);
}

void step_burial(State& s, const std::atomic<bool>& cancel) {
    const LightSamples& samples = s.direct->samples();
    const bool sampled = samples.count() > 0;
    const std::uint32_t places = sampled ? samples.count() : s.mesh.coarse_vertex_count;
    if (s.cursor < places) {
        const bool done = run_slice(s.cursor, places, 64, cancel, [&](std::uint32_t first, std::uint32_t last) {
            for (std::uint32_t i = first; i < last; ++i) {
                const std::uint32_t v = sampled ? samples.vertex[i] : i;
                find_buried(*s.world, s.mesh, s.origins, s.scene->solve.seed, v, v + 1, s.buried, &s.around);
            }
        });
        for (std::uint32_t v = 0; done && sampled && v < s.mesh.coarse_vertex_count; ++v) {
            const std::uint32_t of = samples.vertex[samples.of_vertex[v]];
            s.buried[v] = s.buried[of];
            s.around.lit[v] = s.around.lit[of], s.around.back[v] = s.around.back[of];
            s.around.near[v] = s.around.near[of], s.around.distance[v] = s.around.distance[of];
        }
        return;
    }
    if (s.overlap.cursor < s.mesh.coarse_element_count) {
        find_overlap(s.mesh, *s.world, s.buried, cancel, s.overlap);
        return;
    }
    s.indirect_distance = s.around.distance;
    s.status.rays += std::uint64_t(places) * burial_rays + s.mesh.coarse_element_count;
    s.receivers =
        sampled ? receivers_of(samples, s.buried) : make_receivers(*s.scene, s.mesh, s.buried, cell_of(s.element_size));
    s.status.matrix_patches = matrix_size(s.mesh, s.scene->solve.matrix_memory).patches;
    s.status.matrix_bytes = matrix_bytes(s.status.matrix_patches);
    s.status.receivers = s.receivers.count();
    start_solver(s);
}

bool ask_probes(State& s, const std::atomic<bool>& cancel) {
    if (s.probes.complete()) return true;
    const std::vector<std::uint8_t> buried = s.all_buried();
    const std::uint32_t seed = s.scene->solve.seed;
    if (s.probes.points.empty()) {
        std::vector<std::uint32_t> luminaire(s.mesh.coarse_element_count, no_index);
        for (std::uint32_t e = 0; e < luminaire.size(); ++e)
            if (const auto l = s.luminaire_of(s.mesh.coarse_surface[e], s.mesh.coarse_back[e] != 0))
                luminaire[e] = static_cast<std::uint32_t>(*l);
        place_probes(*s.world, s.mesh, *s.direct, buried, std::move(luminaire), probe_count(s.mesh),
                     probe_rays(s.scene->solve.target_error), seed, s.probes);
    }
    if (!trace_probes(*s.world, s.mesh, *s.direct, buried, seed, cancel, s.probes)) return false;
    s.status.rays +=
        s.probes.ends.size() + s.probes.points.size() * ErrorProbes::shadow_rays * s.direct->emitter_count();
    return true;
}

void step_refine(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::direct;
    const std::size_t before = s.mesh.vertices.size();
    // Gathering shows what the first levels give; the finer ones cost more rays and change less.
    const bool gathering = s.solver() == SolverKind::gathering;
    const std::uint32_t levels = gathering && !s.refined ? first_direct_levels : no_index;
    const bool done = refine_indirect(s, cancel) && s.direct->light_vertices(cancel) &&
                      s.direct->refine(cancel, levels) && s.direct->light_vertices(cancel);
    if (s.mesh.vertices.size() != before) publish_mesh(s);
    if (!done) return;
    // It asks its probes last: they tell how wrong the light is, and make none of it.
    if (!gathering && !ask_probes(s, cancel)) return;
    if (!s.refined) take_indirect_level(s);
    s.refined = true;
    // The rays there are ended at vertices of the mesh before.
    if (s.pass_open) s.passes.pop_back();
    s.pass_open = false;
    s.kept_hits.clear();
    for (GatherPass& pass : s.passes) s.kept_hits.push_back(std::move(pass.hits));
    s.passes.clear();
    start_solver(s);
}

} // namespace lueur
