// The solvers of the full matrix in a solution: the matrix built in slices, then sweeps or shots.
//
// Patches are the coarse elements where their matrix fits into the memory allowed, else the mesh's larger patches.
// Luminaires are patches with exitance, so that direct light goes through form factors too, as in the lecture; the
// transport's direct light is shown only until the first sweep. What is shown is the patches' irradiance, averaged over
// area at the vertices of the same surface (correction 36).
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/scene/solver_words.h"
#include "core/solve/least_absorbed.h"
#include "core/solve/solution_steps.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr double unshot_of_sweeps = 0.05; // of the target error that flux left unshot may take
constexpr double unshot_of_shots = 0.2;
constexpr std::uint32_t most_matrix_sweeps = 20000;
constexpr std::uint32_t most_shots = 500; // a patch
constexpr std::size_t rate_sweeps = 16;   // over which the rate of convergence is taken

using State = Solution::State;

// Luminous and other channels of the sources and paints, patch by patch.
void give_sources(State& s) {
    PatchSolve& p = s.patch_solve;
    PatchField rho(p.matrix.n, s.channels()), exitance(p.matrix.n, s.channels());
    for (std::uint32_t e = 0; e < s.mesh.coarse_element_count; ++e) {
        const std::uint32_t patch = p.of_element[e], surface = s.mesh.coarse_surface[e];
        const auto luminaire = s.luminaire_of(surface, s.mesh.coarse_back[e] != 0);
        for (int c = 0; c < s.channels(); ++c) {
            rho[patch][c] = s.material_rho[s.material_of(surface)][c];
            exitance[patch][c] = luminaire ? s.luminaire_exitance[*luminaire][c] : 0;
        }
    }
    if (has_no_finite_solution(p.matrix, p.sums, rho, exitance, s.channels())) return fail(s, no_finite_solution);
    p.system.set_sources(std::move(rho), std::move(exitance));
}

// Irradiance of the patches at the coarse vertices.
void show_patches(State& s) {
    PatchSolve& p = s.patch_solve;
    const Mesh& mesh = s.mesh;
    const PatchField& h = p.system.irradiance();
    p.irradiance = ChannelField(mesh.coarse_vertex_count, s.channels());
    std::vector<float> area(mesh.coarse_vertex_count, 0);
    for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.nodes[e].vertices[k];
            area[v] += mesh.coarse_area[e];
            for (int c = 0; c < s.channels(); ++c)
                p.irradiance[v][c] += mesh.coarse_area[e] * static_cast<float>(h[p.of_element[e]][c]);
        }
    for (std::uint32_t v = 0; v < area.size(); ++v)
        for (int c = 0; c < s.channels() && area[v] > 0; ++c) p.irradiance[v][c] /= area[v];

    double square = 0, norm = 0;
    p.arriving = 0;
    std::vector<float> channels(static_cast<std::size_t>(h.stride));
    for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e) {
        const double* patch = h[p.of_element[e]];
        std::copy(patch, patch + h.stride, channels.begin());
        const double there = luminous(s, channels.data());
        double mean = 0;
        for (int k = 0; k < 3; ++k) mean += luminous(s, p.irradiance[mesh.nodes[e].vertices[k]]) / 3;
        square += mesh.coarse_area[e] * (there - mean) * (there - mean);
        norm += mesh.coarse_area[e] * there * there;
        p.arriving += mesh.coarse_area[e] * there;
    }
    p.smoothing = norm > 0 ? std::sqrt(square / norm) : 0;
}

// Of all the light that arrives in the end, the share that is still missing. Each unit unshot is reflected on,
// 1 / (1 - rho_ave) times if nothing is lost, and in a part of the scene that is whiter than the rest as the sweeps
// show: Jacobi's residual falls by the largest eigenvalue mu, Gauss-Seidel's by mu^2 (Young 1971).
double missing_share(const State& s) {
    const PatchSolve& p = s.patch_solve;
    double absorbed = std::max(least_absorbed, 1 - mean_luminous_reflectance(s) * mean_lit_share(s));
    const std::vector<double>& u = p.unshot_history;
    if (s.solver() != SolverKind::overshooting && u.size() > rate_sweeps && u[u.size() - 1 - rate_sweeps] > 0) {
        double rate = std::pow(u.back() / u[u.size() - 1 - rate_sweeps], 1.0 / rate_sweeps);
        if (s.solver() == SolverKind::gauss_seidel) rate = std::sqrt(rate);
        if (rate < 1) absorbed = std::max(least_absorbed, std::min(absorbed, 1 - rate));
    }
    const double missing = s.status.unshot_share * s.status.emitted_lumens / absorbed;
    return missing > 0 ? missing / (missing + p.arriving) : 0;
}

// Why it will not get there, or nothing. `enough`: the share missing that it is to reach.
std::string hopeless(const State& s, double enough) {
    const std::vector<double>& u = s.patch_solve.history;
    if (u.back() <= enough) return {};
    if (!std::isfinite(u.back())) return "the solver lost its way on this scene: no finite radiosities";
    if (u.size() <= 2 * rate_sweeps) return {};
    const double rate = std::pow(u.back() / u[u.size() - 1 - rate_sweeps], 1.0 / rate_sweeps);
    if (rate < 1) {
        const double left = std::log(enough / u.back()) / std::log(rate);
        if (s.status.sweeps + left <= most_matrix_sweeps) return {};
        return fmt::format("{} would need about {:.2g} sweeps, {} are the limit: a reflectance is too close to 1",
                           to_string(s.solver()), s.status.sweeps + left, most_matrix_sweeps);
    }
    if (s.status.sweeps < most_matrix_sweeps) return {};
    return fmt::format("{} does not converge on this scene within {} sweeps", to_string(s.solver()),
                       most_matrix_sweeps);
}

std::string hopeless_shots(const State& s, double enough) {
    const std::vector<double>& u = s.patch_solve.history; // after each round of as many shots as there are patches
    const double most = double(most_shots) * s.patch_solve.matrix.n;
    double needed = s.status.shots;
    if (u.size() >= rate_sweeps) {
        const double rate = std::pow(u.back() / u[u.size() - rate_sweeps / 2], 2.0 / rate_sweeps);
        needed = rate < 1 ? needed + s.patch_solve.matrix.n * std::log(enough / u.back()) / std::log(rate) : 1e30;
    }
    if (needed <= most) return {};
    return fmt::format("overshooting would need about {:.2g} shots, {:.2g} are the limit: a reflectance is too close "
                       "to 1",
                       needed, most);
}

void take_shots(State& s, const std::atomic<bool>& cancel, bool one_shot, double enough) {
    MatrixSystem& system = s.patch_solve.system;
    TimeSlice slice(cancel);
    bool hopeless = false; // when it ends is counted in shots, never in time
    do {
        if (!system.shoot(true)) break;
        ++s.status.shots;
        if (s.status.shots % s.patch_solve.matrix.n != 0) continue;
        s.patch_solve.history.push_back(system.unshot_share());
        hopeless = !hopeless_shots(s, enough).empty();
    } while (!one_shot && system.unshot_share() > enough && !hopeless && !slice.over());
    system.refresh();
    const std::uint32_t shooter = system.last_shooter();
    s.status.shooting_patch = no_index;
    for (std::uint32_t e = 0; e < s.mesh.coarse_element_count && shooter != no_index; ++e)
        if (s.patch_solve.of_element[e] == shooter) s.status.shooting_patch = s.mesh.coarse_patch[e];
}

// Rows above 1, and what the pixels of item buffers have missed.
std::string words_of_rows(const PatchSolve& p) {
    constexpr double missed_share = 0.01; // of the pairs: worth a word
    std::string words;
    if (p.sums.above + p.sums.broken > 0)
        words = fmt::format("form factors of {} of {} patches summed to more than 1 ({:.4g} at most): scaled down to 1",
                            p.sums.above + p.sums.broken, p.matrix.n, p.sums.largest);
    if (double(p.cost.missed) > missed_share * double(p.cost.pairs))
        words += fmt::format("{}{} missed {:.2g} % of the pairs of patches that face each other, {:.2g} % are narrower "
                             "than two of its pixels: more samples or another method are needed",
                             words.empty() ? "" : "; ", to_string(p.method),
                             100 * double(p.cost.missed) / double(p.cost.pairs),
                             100 * double(p.cost.warned) / double(p.cost.pairs));
    return words;
}

bool made_with(const PatchSolve& p, const SolveSettings& solve) {
    return p.matrix.n > 0 && p.method == solve.form_factors && p.samples == solve.form_factor_samples &&
           p.seed == solve.seed && p.memory == solve.matrix_memory;
}

} // namespace

MatrixSize matrix_size(const Mesh& mesh, int memory_mib) {
    const bool elements = matrix_bytes(mesh.coarse_element_count) <= std::uint64_t(memory_mib) << 20;
    const auto patches = elements ? mesh.coarse_element_count : static_cast<std::uint32_t>(mesh.patches.size());
    return {elements, patches};
}

void start_matrix(State& s, bool same_sources) {
    PatchSolve& p = s.patch_solve;
    if (!made_with(p, s.scene->solve)) {
        p = PatchSolve{};
        s.solving = false;
    }
    s.status.matrix_patches = matrix_size(s.mesh, s.scene->solve.matrix_memory).patches;
    s.status.matrix_bytes = matrix_bytes(s.status.matrix_patches);
    if (!p.complete) {
        s.phase = SolvePhase::transport;
        return;
    }
    s.phase = SolvePhase::solve;
    if (p.matrix.transposed != (s.solver() == SolverKind::overshooting)) transpose(p.matrix);
    if (s.solving && same_sources) return;
    if (!s.solving) p.system = MatrixSystem(p.matrix, s.channels(), flux_weights(s));
    s.status.sweeps = s.status.shots = 0;
    p.history.clear();
    p.unshot_history.clear();
    if (s.status.message.empty()) s.status.message = words_of_rows(p);
    give_sources(s);
}

void build_matrix(State& s, const std::atomic<bool>& cancel) {
    PatchSolve& p = s.patch_solve;
    const SolveSettings& solve = s.scene->solve;
    s.status.stage = SolveStage::form_factors;
    if (!std::exchange(p.announced, true)) return; // the status says what it will take before it is taken
    if (p.matrix.n == 0) {
        const MatrixSize size = matrix_size(s.mesh, solve.matrix_memory);
        p.of_elements = size.of_elements;
        p.of_element.resize(s.mesh.coarse_element_count);
        std::vector<float> area(size.patches, 0);
        for (std::uint32_t e = 0; e < s.mesh.coarse_element_count; ++e) {
            p.of_element[e] = size.of_elements ? e : s.mesh.coarse_patch[e];
            area[p.of_element[e]] += s.mesh.coarse_area[e];
        }
        auto matrix = make_form_factor_matrix(std::move(area), std::uint64_t(solve.matrix_memory) << 20);
        if (!matrix) return fail(s, matrix.error());
        p.matrix = std::move(*matrix);
        p.scene = size.of_elements ? make_element_scene(s.mesh, *s.world) : make_patch_scene(s.mesh, *s.world);
        p.method = solve.form_factors, p.samples = solve.form_factor_samples;
        p.seed = solve.seed, p.memory = solve.matrix_memory;
        p.cursor = 0;
    }
    const std::uint64_t cost_before = p.cost.cost;
    const bool done =
        fill_rows(p.matrix, p.scene, p.method, row_settings(p.method, p.samples, p.seed), p.cursor, p.cost, cancel);
    s.status.form_factor_cost += p.cost.cost - cost_before;
    s.status.form_factor_pairs = p.cost.pairs;
    s.status.form_factors_warned = p.cost.warned, s.status.form_factors_missed = p.cost.missed;
    s.status.progress = p.matrix.n > 0 ? double(p.cursor) / p.matrix.n : 1;
    if (!done) return;
    p.sums = limit_row_sums(p.matrix);
    p.complete = true;
    s.status.row_entries = std::uint64_t(p.matrix.n) * p.matrix.n;
    start_matrix(s, false);
}

void step_matrix(State& s, const std::atomic<bool>& cancel, bool one_shot) {
    PatchSolve& p = s.patch_solve;
    s.status.stage = SolveStage::solving;
    // Direct light of a finer mesh is not used here, so that refinement, which else asks for them, has not been.
    if (!ask_probes(s, cancel)) return;
    const bool shots = s.solver() == SolverKind::overshooting;
    double enough = (shots ? unshot_of_shots : unshot_of_sweeps) * s.scene->solve.target_error;
    if (shots) // of the emitted flux: each unit unshot is reflected on, 1 / (1 - rho_ave) times if nothing is lost
        enough *= std::max(least_absorbed, 1 - mean_luminous_reflectance(s) * mean_lit_share(s));
    switch (s.solver()) {
    case SolverKind::jacobi:
        if (!p.system.jacobi_sweep(cancel)) return;
        ++s.status.sweeps;
        break;
    case SolverKind::gauss_seidel:
        if (!p.system.gauss_seidel_sweep(cancel)) return;
        ++s.status.sweeps;
        break;
    case SolverKind::overshooting:
        take_shots(s, cancel, one_shot, enough);
        break;
    case SolverKind::automatic:
    case SolverKind::gathering:
    case SolverKind::shooting:
    case SolverKind::hierarchical:
    case SolverKind::reference:
        return;
    }
    show_patches(s);
    s.solving = true;
    s.status.unshot_share = p.system.unshot_share();
    s.status.residual = p.system.relative_residual();
    if (!shots) p.unshot_history.push_back(s.status.unshot_share);
    const double missing = missing_share(s);
    s.status.estimated_error = std::min(1.0, std::hypot(missing, p.smoothing));
    const bool known = shots || p.system.residual_known();
    if (known && (shots ? s.status.unshot_share : missing) <= enough) return settle(s);
    if (!shots) {
        p.history.push_back(missing);
        if (std::string why = hopeless(s, enough); !why.empty()) return fail(s, std::move(why));
    } else {
        if (std::string why = hopeless_shots(s, enough); !why.empty()) return fail(s, std::move(why));
    }
}

std::vector<float> unshot_of_matrix(const State& s) {
    const PatchSolve& p = s.patch_solve;
    std::vector<float> unshot(s.mesh.coarse_vertex_count, 0), area(s.mesh.coarse_vertex_count, 0);
    std::vector<float> channels;
    for (std::uint32_t e = 0; e < s.mesh.coarse_element_count; ++e) {
        const double* r = p.system.unshot()[p.of_element[e]];
        channels.assign(r, r + p.system.unshot().stride);
        const auto y = static_cast<float>(std::abs(luminous(s, channels.data())));
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t v = s.mesh.nodes[e].vertices[k];
            unshot[v] += s.mesh.coarse_area[e] * y, area[v] += s.mesh.coarse_area[e];
        }
    }
    for (std::size_t v = 0; v < unshot.size(); ++v)
        if (area[v] > 0) unshot[v] /= area[v];
    return unshot;
}

} // namespace lueur
