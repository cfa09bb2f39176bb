// The phases of a solution and which solver has them.
#include "core/solve/solution.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "core/scene/solver_words.h"
#include "core/solve/choose_solver.h"
#include "core/solve/settled_words.h"
#include "core/solve/solution_steps.h"
#include "core/solve/traced_field.h"

namespace lueur {

using State = Solution::State;

namespace {

void step_transport(State& s, const std::atomic<bool>& cancel) {
    switch (s.solver()) {
    case SolverKind::automatic:
    case SolverKind::gathering:
        trace_gathering_rows(s, cancel);
        s.status.progress = gathering_progress(s);
        return;
    case SolverKind::overshooting:
    case SolverKind::jacobi:
    case SolverKind::gauss_seidel:
        return build_matrix(s, cancel);
    case SolverKind::hierarchical:
        return make_links(s, cancel);
    case SolverKind::shooting: // makes its form factors as it shoots
    case SolverKind::reference:
        s.phase = SolvePhase::solve;
        return;
    }
}

void step_solve(State& s, const std::atomic<bool>& cancel, bool one_shot) {
    switch (s.solver()) {
    case SolverKind::automatic:
    case SolverKind::gathering:
        return step_gathering(s, cancel);
    // Refinement has asked the probes, unless it was gathering's, which asks them last.
    case SolverKind::shooting:
        if (!ask_probes(s, cancel)) return;
        return step_shooting(s, cancel, one_shot);
    case SolverKind::overshooting:
    case SolverKind::jacobi:
    case SolverKind::gauss_seidel:
        return step_matrix(s, cancel, one_shot);
    case SolverKind::hierarchical:
        if (s.direct_light_apart() && !ask_probes(s, cancel)) return;
        return step_hierarchical(s, cancel);
    case SolverKind::reference:
        return step_reference(s, cancel);
    }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// What only another solver can use, and may be large. A matrix serves all that are solved on one.
void forget_other_solvers(State& s) {
    if (!uses_form_factors(s.solver())) s.patch_solve = {};
    if (s.solver() != SolverKind::gathering) s.light_bases.forget(), s.basis_in_the_making.reset();
    if (s.solver() != SolverKind::shooting) s.shooting = {};
    if (s.solver() != SolverKind::reference) s.traced.reset();
    if (s.solver() != SolverKind::hierarchical) {
        s.final_gather.reset();
        s.making_hierarchy = {};
        s.making_shown = {};
        s.making_leaf_mesh = {};
        s.hierarchy.reset();
        s.hierarchy_view.reset();
    }
}

void add_words(std::string& message, const std::string& words) {
    if (!words.empty()) message += (message.empty() ? "" : "; ") + words;
}

// The field's own estimate is the one that is told; why it is above the target, if it is. The number of rays follows
// from the geometry (ray_budget.h), so that light that bends between the vertices may be what is left.
void warn_of_error(SolveStatus& status, const SolveSettings& solve) {
    if (!status.message.empty() || !(status.estimated_error > 1.1 * solve.target_error)) return;
    const bool all_rays = status.rays_per_receiver + rays_per_pass * independent_sets > std::uint32_t(solve.max_rays);
    status.message =
        fmt::format("estimated error {:.1f} %, above the target of {:.1f} %: {}", 100 * status.estimated_error,
                    100 * solve.target_error,
                    all_rays ? fmt::format("{} rays a receiver are the limit set", status.rays_per_receiver)
                             : "smaller elements would lower it");
}

} // namespace

void start_solver(State& s, bool same_sources) {
    if (s.solver() != SolverKind::hierarchical) s.status.links = 0;
    if (s.solver() != SolverKind::gathering) s.indirect_deviation.clear(), s.rays_unjudged = false; // another solver's
    // They read the mesh as it was then, and are as many as the target asks for.
    if (!s.fully_refined() || s.probes.rays != probe_rays(s.scene->solve.target_error)) s.probes = {};
    switch (s.solver()) {
    case SolverKind::automatic:
    case SolverKind::gathering:
        return start_gathering(s, same_sources);
    case SolverKind::shooting:
        return start_shooting(s);
    case SolverKind::overshooting:
    case SolverKind::jacobi:
    case SolverKind::gauss_seidel:
        return start_matrix(s, same_sources);
    case SolverKind::hierarchical:
        return start_hierarchical(s, same_sources);
    case SolverKind::reference:
        return start_reference(s, same_sources);
    }
}

void settle(State& s) {
    s.phase = SolvePhase::settled;
    s.status.stage = SolveStage::settled;
    s.status.settled = true;
    s.status.progress = 1;
}

void fail(State& s, std::string message) {
    s.phase = SolvePhase::failed;
    s.status.stage = SolveStage::failed;
    s.status.message = std::move(message);
}

Solution::Solution(std::shared_ptr<const Scene> scene)
    : state_(std::make_unique<State>()) {
    state_->scene = std::move(scene);
    state_->chosen = chosen_solver(*state_->scene);
    plan_channels(*state_);
}
Solution::~Solution() = default;
Solution::Solution(Solution&&) noexcept = default;
Solution& Solution::operator=(Solution&&) noexcept = default;

void Solution::update(std::shared_ptr<const Scene> scene, SolveFrom stale) {
    State& s = *state_;
    const auto start = std::chrono::steady_clock::now();
    const std::shared_ptr<const Scene> scene_before = std::exchange(s.scene, std::move(scene));
    const SolveSettings& before = scene_before->solve;
    const SolverKind solver_before = s.solver();
    s.chosen = chosen_solver(*s.scene);
    if (stale == SolveFrom::nothing) return;
    // Leaves have cut the mesh as links asked for it; other solvers, and other links, start from their own.
    const bool other_links =
        s.scene->solve.oracle != before.oracle || s.scene->solve.link_tolerance != before.link_tolerance;
    if (s.leaf_mesh && (s.solver() != solver_before || other_links)) stale = SolveFrom::mesh;
    for (std::size_t l = 0; l < std::min(s.scene->luminaires.size(), scene_before->luminaires.size()); ++l)
        if (s.scene->luminaires[l] != scene_before->luminaires[l]) s.light_bases.want(l);
    s.stock.reset();
    s.status.seconds = 0;
    s.status.last_edit_seconds = 0;
    s.status.settled = false;
    s.edit_open = true;
    if (stale == SolveFrom::mesh) {
        auto fresh = std::make_unique<State>();
        fresh->scene = s.scene;
        fresh->chosen = s.chosen;
        fresh->choice = s.choosing.valid() ? s.choosing.get() : std::move(s.choice);
        fresh->left_meshes = std::move(s.left_meshes);
        if (s.making_mesh.valid()) fresh->left_meshes.push_back(std::move(s.making_mesh));
        state_ = std::move(fresh);
        plan_channels(*state_);
        return;
    }
    if (s.phase == SolvePhase::mesh) {
        if (s.choosing.valid()) s.choice = s.choosing.get();
        plan_channels(s);
        return;
    }
    const bool on_same_rows = s.solver() == SolverKind::gathering && solver_before == SolverKind::gathering &&
                              s.solving && s.rows_of_system == s.passes_traced && stale == SolveFrom::reflectance;
    const SameChannels same = take_channels(s, on_same_rows);
    const SolveSettings& now = s.scene->solve;
    if (s.solver() != solver_before || !same.channels || stale == SolveFrom::black || stale == SolveFrom::transport ||
        s.phase == SolvePhase::failed || other_links)
        s.solving = false; // nothing of the old radiosities can be used
    if (s.solver() != solver_before) forget_other_solvers(s);
    if (stale == SolveFrom::transport || now.target_error != before.target_error || now.max_rays != before.max_rays) {
        s.kept_hits.clear();
        s.passes.clear(); // the number of rays follows from the settings, never from what was there before
        s.pass_open = false;
        if (s.solver() == SolverKind::gathering || s.solver() == SolverKind::hierarchical) s.solving = false;
    }
    switch (s.phase) {
    case SolvePhase::mesh:
    case SolvePhase::sketch:
    case SolvePhase::burial:
        return; // goes on to the solver
    case SolvePhase::light:
        if (s.passes.empty()) return;
        [[fallthrough]];
    case SolvePhase::refine:
    case SolvePhase::transport:
    case SolvePhase::solve:
    case SolvePhase::settled:
    case SolvePhase::failed:
        if (s.solver() != SolverKind::gathering && !s.direct->is_lit()) {
            s.phase = SolvePhase::light; // only gathering begins with a guess of it
            return;
        }
        start_solver(s, same.sources);
    }
    s.status.seconds = seconds_since(start);
}

bool Solution::step(const std::atomic<bool>& cancel, bool one_shot) {
    State& s = *state_;
    if (s.phase == SolvePhase::settled || s.phase == SolvePhase::failed) return false;
    s.stock.reset();
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t direct_before = s.direct ? s.direct->rays() : 0;
    switch (s.phase) {
    case SolvePhase::mesh:
        step_mesh(s);
        break;
    case SolvePhase::sketch:
        step_sketch(s, cancel);
        break;
    case SolvePhase::light:
        step_light(s, cancel);
        break;
    case SolvePhase::burial:
        step_burial(s, cancel);
        break;
    case SolvePhase::refine:
        step_refine(s, cancel);
        break;
    case SolvePhase::transport:
        step_transport(s, cancel);
        break;
    case SolvePhase::solve:
        step_solve(s, cancel, one_shot);
        break;
    case SolvePhase::settled:
    case SolvePhase::failed:
        break;
    }
    if (s.direct) s.status.rays += s.direct->rays() - direct_before;
    if (s.status.stage == SolveStage::direct) s.status.progress = s.direct->progress();
    s.status.seconds += seconds_since(start);
    if (s.edit_open && s.phase == SolvePhase::settled) {
        s.edit_open = false;
        s.status.last_edit_seconds = s.status.seconds;
    }
    if (s.phase == SolvePhase::settled) {
        take_stock();
        if (s.solver() == SolverKind::gathering) warn_of_error(s.status, s.scene->solve);
        if (s.stock) add_words(s.status.message, settled_words(s, *s.stock));
    }
    return s.phase != SolvePhase::settled && s.phase != SolvePhase::failed;
}

bool Solution::prepare_edits(const std::atomic<bool>& cancel) {
    return state_->phase == SolvePhase::settled && state_->solver() == SolverKind::gathering &&
           prepare_gathering_edits(*state_, cancel);
}

void Solution::take_stock() {
    if (!state_->published_mesh) return;
    take_stock_of_gathering(*state_);
    state_->stock = compose_field(*state_);
    state_->status.estimated_error = state_->stock->scene_error;
}

const SolveStatus& Solution::status() const {
    return state_->status;
}
const std::shared_ptr<const Scene>& Solution::scene() const {
    return state_->scene;
}
std::shared_ptr<const Mesh> Solution::mesh() const {
    return state_->published_mesh;
}
std::shared_ptr<const World> Solution::world() const {
    return state_->world;
}
std::shared_ptr<const HierarchyView> Solution::hierarchy() const {
    return state_->solver() == SolverKind::hierarchical ? state_->hierarchy_view : nullptr;
}
std::shared_ptr<const Field> Solution::field() const {
    if (state_->stock) return state_->stock;
    return state_->published_mesh ? compose_field(*state_) : nullptr;
}

} // namespace lueur
