// What every solver stands on: mesh, rays' world, direct light, who is buried.
#include "core/solve/solution_steps.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr std::uint32_t fine_vertices = 20000; // that direct light may add: the window has to draw them
constexpr double receiver_cell = 0.3;          // of the coarse element size

using State = Solution::State;

} // namespace

void publish_mesh(State& s) {
    s.published_mesh = std::make_shared<const Mesh>(s.mesh);
    s.status.vertices = static_cast<std::uint32_t>(s.mesh.vertices.size());
    s.status.elements = static_cast<std::uint32_t>(s.mesh.elements.size());
}

void step_mesh(State& s) {
    s.status.stage = SolveStage::meshing;
    s.element_size = s.scene->solve.element_size > 0 ? s.scene->solve.element_size : automatic_element_size(*s.scene);
    s.mesh = make_mesh(*s.scene, {s.element_size});
    s.world = std::make_shared<const World>(s.mesh);
    s.origins = ray_origins(s.mesh, s.world->epsilon());
    s.buried.assign(s.mesh.coarse_vertex_count, 0);
    const DirectParams params{0.03f, static_cast<float>(s.element_size / 8),
                              s.mesh.coarse_vertex_count + fine_vertices};
    s.direct = std::make_unique<DirectTransport>(*s.world, s.mesh, make_emitters(*s.scene), params);
    s.coarse_area = vertex_areas(s.mesh); // bisection keeps what hat functions integrate to
    publish_mesh(s);
    s.cursor = 0;
    s.phase = SolvePhase::sketch;
}

void step_sketch(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::direct;
    if (s.direct->sketch(cancel)) s.phase = SolvePhase::light;
}

void step_light(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::direct;
    if (!s.direct->light_vertices(cancel)) return;
    s.phase = SolvePhase::burial;
}

void step_burial(State& s, const std::atomic<bool>& cancel) {
    if (!run_slice(s.cursor, s.mesh.coarse_vertex_count, 64, cancel, [&](std::uint32_t first, std::uint32_t last) {
            find_buried(*s.world, s.mesh, s.origins, first, last, s.buried);
        }))
        return;
    s.status.rays += std::uint64_t(s.mesh.coarse_vertex_count) * burial_rays;
    s.receivers = make_receivers(*s.scene, s.mesh, s.buried, static_cast<float>(receiver_cell * s.element_size));
    s.status.matrix_patches = matrix_size(s.mesh, s.scene->solve.matrix_memory).patches;
    s.status.matrix_bytes = matrix_bytes(s.status.matrix_patches);
    s.status.receivers = s.receivers.count();
    start_solver(s);
}

void step_refine(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::direct;
    const std::size_t before = s.mesh.vertices.size();
    const bool done = s.direct->refine(cancel);
    if (s.mesh.vertices.size() != before) publish_mesh(s);
    if (!done) return;
    const std::vector<std::uint8_t> buried = s.all_buried();
    if (s.probes.points.empty())
        place_probes(*s.world, s.mesh, *s.direct, buried, probe_count, s.scene->solve.seed, s.probes);
    if (!trace_probes(*s.world, s.mesh, *s.direct, buried, s.scene->solve.seed, cancel, s.probes)) return;
    s.status.rays +=
        s.probes.points.size() * (ErrorProbes::rays + ErrorProbes::shadow_rays * s.direct->emitter_count());
    s.refined = true;
    // The first picture's rays ended at vertices of the mesh before.
    s.passes.clear();
    start_solver(s);
}

} // namespace lueur
