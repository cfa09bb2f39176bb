#include "core/solve/solution.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/scene/luminaire.h"
#include "core/scene/spectral_content.h"
#include "core/solve/ray_budget.h"
#include "core/solve/restriction.h"
#include "core/solve/solution_state.h"
#include "core/spectrum/wavelengths_plan.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr double residual_target = 2e-4;       // |r| / |b|, worst channel
constexpr std::uint32_t most_sweeps = 400;     // a system that needs more does not converge
constexpr std::uint32_t fine_vertices = 20000; // that direct light may add: the window has to draw them
constexpr double receiver_cell = 0.3;          // of the coarse element size
constexpr double ray_share = 0.7;              // of the target error that the rays may take; interpolation has the rest
constexpr double unshot_part = 0.2;            // of the target error that flux left unshot may take

using State = Solution::State;

// The wavelengths that the scene's lights and paints need; the same as before where those have not changed.
void choose_wavelengths(State& s) {
    const SolveSettings& solve = s.scene->solve;
    SpectralContent content = spectral_content(*s.scene);
    const bool same_rule = s.wavelengths && s.wavelengths->asked == solve.wavelengths;
    if (same_rule && s.content == content && s.planned_error == solve.colour_error) return;
    switch (solve.wavelengths.rule) {
    case WavelengthRule::automatic:
    case WavelengthRule::folded: {
        WavelengthsPlan plan =
            plan_wavelengths(solve.wavelengths, content, solve.colour_error, same_rule ? s.wavelengths.get() : nullptr);
        s.wavelengths = std::make_shared<const Wavelengths>(std::move(plan.wavelengths));
        s.status.predicted_colour_error = plan.prediction.worst;
        s.status.wavelengths = std::move(plan.reason);
        break;
    }
    case WavelengthRule::uniform:
    case WavelengthRule::meyer:
    case WavelengthRule::gauss:
    case WavelengthRule::rgb:
        s.wavelengths = std::make_shared<const Wavelengths>(make_wavelengths(solve.wavelengths, content));
        s.status.predicted_colour_error = -1;
        s.status.wavelengths = fmt::format("{} channels", s.wavelengths->size());
        break;
    }
    s.content = std::move(content);
    s.planned_error = solve.colour_error;
}

void make_channels(State& s) {
    const Scene& scene = *s.scene;
    choose_wavelengths(s);
    const bool compare = scene.solve.compare_trichromatic && scene.solve.wavelengths.rule != WavelengthRule::rgb &&
                         s.wavelengths->size() + 3 <= max_channels;
    s.trichromatic = compare ? std::optional(make_wavelengths(WavelengthsSpec{WavelengthRule::rgb, 3})) : std::nullopt;
    const auto with_trichromatic = [&](const auto& channels_in) {
        std::vector<double> channels = channels_in(*s.wavelengths);
        if (s.trichromatic) {
            const std::vector<double> more = channels_in(*s.trichromatic);
            channels.insert(channels.end(), more.begin(), more.end());
        }
        return channels;
    };
    s.material_rho.clear();
    for (const Material& material : scene.materials)
        s.material_rho.push_back(
            with_trichromatic([&](const Wavelengths& w) { return reflectance_channels(material, w); }));
    s.luminaire_exitance.clear();
    s.status.emitted_lumens = 0;
    std::string dark;
    for (const Luminaire& luminaire : scene.luminaires) {
        s.luminaire_exitance.push_back(
            with_trichromatic([&](const Wavelengths& w) { return exitance_channels(scene, luminaire, w); }));
        const double lumens =
            xyz_from_channels(*s.wavelengths, s.luminaire_exitance.back()).y * emitting_area(scene, luminaire);
        s.status.emitted_lumens += lumens;
        if (!(lumens > 0) && luminous_flux(scene, luminaire) > 0 && dark.empty())
            dark =
                fmt::format("\"{}\" is dark: its spectrum has nothing at the wavelengths of {}; folded samples see it",
                            luminaire.name, to_string(s.wavelengths->spec));
    }
    s.object_luminaire = luminaire_of_objects(scene);
    if (s.status.emitted_lumens <= 0 && dark.empty()) dark = "nothing emits light: the picture is black";
    s.status.message = dark;
}

ChannelField rho_of_receivers(const State& s) {
    ChannelField rho(s.receivers.count(), s.channels());
    for (std::uint32_t i = 0; i < rho.count; ++i) {
        const auto& values = s.material_rho[s.material_of(s.mesh.vertices[s.receivers.vertex[i]].surface)];
        std::copy(values.begin(), values.end(), rho[i]);
    }
    return rho;
}

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

// Area that each receiver stands for, m^2; 0 for buried ones.
std::vector<float> receiver_areas(const State& s) {
    std::vector<float> area(s.receivers.count(), 0);
    for (std::uint32_t v = 0; v < s.mesh.coarse_vertex_count; ++v)
        if (!s.buried[v]) area[s.receivers.of_vertex[v]] += s.coarse_area[v];
    return area;
}

// What the status calls unshot: luminous flux still to be sent on its way, of what the luminaires emit.
double unshot_flux_share(const State& s) {
    double flux = 0;
    const std::vector<float> area = receiver_areas(s);
    for (std::uint32_t i = 0; i < s.receivers.count(); ++i) {
        double y = 0;
        for (int c = 0; c < s.wavelengths->size(); ++c) y += s.wavelengths->xyz_weight[c].y * s.system.residual()[i][c];
        flux += area[i] * std::abs(y);
    }
    return s.status.emitted_lumens > 0 ? flux / s.status.emitted_lumens : 0;
}

// Direct light reflected at the fine vertices: rho D E, one row more than vertices, the last zero.
ChannelField reflected_direct(const State& s) {
    const std::uint32_t count = static_cast<std::uint32_t>(s.mesh.vertices.size());
    const int channels = s.channels();
    const std::size_t emitters = s.direct->emitter_count();
    ChannelField b(count + 1, channels);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 256),
                      [&](const tbb::blocked_range<std::uint32_t>& range) {
                          for (std::uint32_t v = range.begin(); v < range.end(); ++v) {
                              const auto& rho = s.material_rho[s.material_of(s.mesh.vertices[v].surface)];
                              const float* d = s.direct->at_vertex(v);
                              for (std::size_t l = 0; l < emitters; ++l) {
                                  if (d[l] == 0) continue;
                                  for (int c = 0; c < channels; ++c)
                                      b[v][c] += d[l] * static_cast<float>(rho[c] * s.luminaire_exitance[l][c]);
                              }
                          }
                      });
    return b;
}

// Equal-flux direct irradiance at all vertices: what the ray budget looks at.
std::vector<float> equal_flux_direct(const State& s) {
    std::vector<float> direct(s.mesh.vertices.size(), 0);
    for (std::size_t v = 0; v < direct.size(); ++v)
        for (std::size_t l = 0; l < s.direct->emitter_count(); ++l)
            if (s.direct->emitters()[l].area > 0)
                direct[v] += s.direct->at_vertex(static_cast<std::uint32_t>(v))[l] / s.direct->emitters()[l].area;
    return direct;
}

void update_error(State& s) {
    const std::uint32_t receivers = s.receivers.count();
    const auto luminous = [&](const float* channels) {
        double y = 0;
        for (int c = 0; c < s.wavelengths->size(); ++c) y += s.wavelengths->xyz_weight[c].y * channels[c];
        return static_cast<float>(y);
    };
    ScalarRadiosity radiosity{std::vector<float>(receivers), std::vector<float>(s.mesh.vertices.size())};
    // Direct irradiance and its reflection: luminous exitance of each luminaire, and its luminous part on each paint.
    std::vector<double> exitance;
    std::vector<std::vector<double>> reflected(s.material_rho.size());
    for (const auto& e : s.luminaire_exitance) {
        exitance.push_back(xyz_from_channels(*s.wavelengths, std::span<const double>(e)).y);
        for (std::size_t m = 0; m < s.material_rho.size(); ++m) {
            double y = 0;
            for (std::size_t c = 0; c < s.wavelengths->xyz_weight.size(); ++c)
                y += s.wavelengths->xyz_weight[c].y * s.material_rho[m][c] * e[c];
            reflected[m].push_back(y);
        }
    }
    std::vector<float> direct(receivers, 0);
    for (std::uint32_t i = 0; i < receivers; ++i) {
        radiosity.indirect[i] = luminous(s.system.radiosity()[i]);
        for (std::size_t l = 0; l < exitance.size(); ++l)
            direct[i] += static_cast<float>(s.direct->at_vertex(s.receivers.vertex[i])[l] * exitance[l]);
    }
    for (std::uint32_t v = 0; v < s.mesh.vertices.size(); ++v) {
        const float* d = s.direct->at_vertex(v);
        const auto& on_paint = reflected[s.material_of(s.mesh.vertices[v].surface)];
        for (std::size_t l = 0; l < exitance.size(); ++l) radiosity.direct[v] += static_cast<float>(d[l] * on_paint[l]);
    }

    double mean_rho = 0, area = 0, white = 0;
    for (const Xyz& w : s.wavelengths->xyz_weight) white += w.y;
    for (std::uint32_t v = 0; v < s.mesh.coarse_vertex_count; ++v) {
        const auto& rho = s.material_rho[s.material_of(s.mesh.vertices[v].surface)];
        double y = 0;
        for (std::size_t c = 0; c < s.wavelengths->xyz_weight.size(); ++c) y += s.wavelengths->xyz_weight[c].y * rho[c];
        mean_rho += s.coarse_area[v] * y / white, area += s.coarse_area[v];
    }
    mean_rho = area > 0 ? mean_rho / area : 0;
    const double rays = ray_error(s.passes, radiosity, direct, receiver_areas(s));
    const double unsolved = s.status.unshot_share / std::max(1e-3, 1 - mean_rho);
    const double interpolation = s.direct->misfit();
    s.status.estimated_error =
        std::min(1.0, std::sqrt(rays * rays + unsolved * unsolved + interpolation * interpolation));
}

// But for rounding: a lamp of the same flux in its own channels may differ in its last digit.
bool nearly_equal(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
    return std::ranges::equal(a, b, [](const std::vector<double>& one, const std::vector<double>& other) {
        return std::ranges::equal(one, other,
                                  [](double x, double y) { return std::abs(x - y) <= 1e-12 * std::abs(x); });
    });
}

// In a closed scene that absorbs nothing the radiosity grows without end: say so instead of iterating.
bool has_no_finite_solution(const State& s) {
    if (s.status.emitted_lumens <= 0 || s.passes.empty()) return false;
    for (std::uint32_t i = 0; i < s.receivers.count(); ++i) {
        if (s.receivers.buried[i]) continue;
        const auto& rho = s.material_rho[s.material_of(s.mesh.vertices[s.receivers.vertex[i]].surface)];
        if (*std::min_element(rho.begin(), rho.end()) < 1 - 1e-7) return false;
        if (row_sum(s.passes, i, s.receivers.count()) < 1 - 1e-7) return false;
    }
    return true;
}

void refresh_indirect(State& s) {
    for (std::uint32_t v = 0; v < s.indirect_irradiance.count; ++v) {
        const std::uint32_t i = s.receivers.of_vertex[v];
        for (int c = 0; c < s.channels(); ++c)
            s.indirect_irradiance[v][c] = s.gathered_direct[i][c] + s.system.gathered()[i][c];
    }
}

// New sources, paints or rays: one reflection of direct light is gathered anew, then the system holds them.
void start_gathering(State& s, bool new_rays) {
    const std::uint32_t n = s.receivers.count();
    const std::atomic<bool> never{false};
    s.gathered_direct = ChannelField(n, s.channels());
    s.indirect_irradiance = ChannelField(s.mesh.coarse_vertex_count, s.channels());
    apply_rows(s.passes, RayEnds::fine, reflected_direct(s), s.gathered_direct, never);
    if (!s.solving) s.system = GatherSystem(n, s.channels(), receiver_areas(s));
    if (new_rays) s.system.set_rows(s.passes);
    s.system.set_sources(rho_of_receivers(s), s.gathered_direct);
    s.solving = true;
    s.status.sweeps = 0;
    refresh_indirect(s);
}

void start_shooting(State& s) {
    const std::vector<float> coarse_direct = restrict_direct(s.mesh, *s.direct);
    std::vector<ChannelField> direct;
    std::vector<double> flux;
    for (std::size_t l = 0; l < s.direct->emitter_count(); ++l) {
        direct.push_back(direct_of(s, coarse_direct, l));
        flux.push_back(0);
    }
    // A fitted sample may weigh less than nothing in Y: flux is not shot for its sake. The trichromatic channels ride
    // along.
    std::vector<float> weight(static_cast<std::size_t>(s.channels()), 0.0f);
    double mean = 0;
    for (const Xyz& w : s.wavelengths->xyz_weight) mean += std::max(w.y, 0.0) / s.wavelengths->size();
    for (int c = 0; c < s.wavelengths->size(); ++c)
        weight[c] = static_cast<float>(0.95 * std::max(s.wavelengths->xyz_weight[c].y, 0.0) + 0.05 * mean);
    for (std::size_t l = 0; l < flux.size(); ++l)
        for (int c = 0; c < s.channels(); ++c)
            flux[l] += weight[c] * s.luminaire_exitance[l][c] * s.direct->emitters()[l].area;
    s.shooting = Shooting(*s.world, s.mesh, s.origins, s.buried, std::move(direct), std::move(flux), rho_of_patches(s),
                          std::move(weight), s.scene->solve.seed);
    s.solving = true;
    s.status.shots = 0;
}

void settle(State& s) {
    const double target = s.scene->solve.target_error;
    if (s.status.message.empty() && s.status.estimated_error > 1.1 * target &&
        s.scene->solve.solver == SolverKind::gathering)
        s.status.message =
            fmt::format("estimated error {:.1f} %, above the target of {:.1f} %: {} rays a receiver are the limit set",
                        100 * s.status.estimated_error, 100 * target, s.status.rays_per_receiver);
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
    s.status.receivers = s.receivers.count();
    s.phase = s.scene->solve.solver == SolverKind::shooting ? SolvePhase::refine : SolvePhase::gather;
}

void step_gather(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::gathering_rays;
    if (!s.pass_open) {
        s.passes.push_back(make_gather_pass(s.mesh, s.receivers));
        s.cursor = 0;
        s.pass_open = true;
    }
    const std::uint32_t pass = static_cast<std::uint32_t>(s.passes.size()) - 1;
    const std::vector<std::uint8_t> buried = s.all_buried();
    if (!run_slice(s.cursor, s.receivers.count(), 64, cancel, [&](std::uint32_t first, std::uint32_t last) {
            trace_gather_rays(*s.world, s.mesh, s.origins, s.receivers, buried, s.scene->solve.seed, pass, first, last,
                              s.passes.back());
        }))
        return;
    s.pass_open = false;
    s.status.rays += std::uint64_t(s.receivers.count()) * rays_per_pass;
    s.status.rays_per_receiver = static_cast<std::uint32_t>(s.passes.size()) * rays_per_pass;
    s.status.row_entries = std::uint64_t(s.receivers.count()) * s.status.rays_per_receiver;
    if (s.passes.size() < s.passes_wanted) return;
    start_gathering(s, true);
    s.phase = SolvePhase::sweep;
}

std::uint32_t most_passes(const State& s) {
    constexpr int group = independent_sets * rays_per_pass;
    return independent_sets * std::max<std::uint32_t>(1, static_cast<std::uint32_t>(s.scene->solve.max_rays) / group);
}

// More rays? Asked each time there are as many as were wanted; the answer depends on the geometry only. The error of a
// quasi-random set falls somewhat faster than one over the root of its rays; two thirds of the way that would leave are
// gone at once.
void plan_passes(State& s) {
    const std::uint32_t now = static_cast<std::uint32_t>(s.passes.size());
    if (s.rays_planned || now < s.passes_wanted) return;
    const double target = ray_share * s.scene->solve.target_error;
    const double error = grey_ray_error(s.passes, s.receivers.vertex, equal_flux_direct(s), receiver_areas(s));
    if (error <= target || now >= most_passes(s)) {
        s.rays_planned = true;
        return;
    }
    const double needed = now * std::pow(error / target, 4.0 / 3);
    std::uint32_t next = now + std::max(1u, static_cast<std::uint32_t>(0.67 * (needed - now)));
    next = (next + independent_sets - 1) / independent_sets * independent_sets;
    s.passes_wanted = std::min(most_passes(s), next);
}

void step_sweep(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::solving;
    if (has_no_finite_solution(s))
        return fail(s, "no finite solution: the scene is closed and every surface reflects everything; some "
                       "reflectance must be below 1");
    if (s.system.relative_residual() > residual_target) {
        if (!s.system.sweep(s.passes, cancel)) return;
        ++s.status.sweeps;
        refresh_indirect(s);
        if (s.system.diverged() || s.status.sweeps > most_sweeps)
            return fail(s, "the solver does not converge on this scene; a reflectance is too close to 1");
    }
    s.status.unshot_share = unshot_flux_share(s);
    if (s.system.relative_residual() > residual_target) return;
    update_error(s);
    if (!s.refined) {
        s.phase = SolvePhase::refine;
        return;
    }
    plan_passes(s);
    if (s.passes.size() < s.passes_wanted) {
        s.phase = SolvePhase::gather;
        return;
    }
    settle(s);
}

void step_refine(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::direct;
    const std::size_t before = s.mesh.vertices.size();
    const bool done = s.direct->refine(cancel);
    if (s.mesh.vertices.size() != before) publish_mesh(s);
    if (!done) return;
    s.refined = true;
    if (s.scene->solve.solver == SolverKind::shooting) {
        start_shooting(s);
        s.phase = SolvePhase::shoot;
        return;
    }
    // The pass of the first picture ended at vertices of the mesh before.
    s.passes.clear();
    s.passes_wanted = independent_sets;
    s.phase = SolvePhase::gather;
}

void step_shoot(State& s, const std::atomic<bool>& cancel, bool one_shot) {
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

} // namespace

std::vector<std::uint8_t> Solution::State::all_buried() const {
    std::vector<std::uint8_t> all = direct->buried();
    for (std::size_t v = 0; v < buried.size(); ++v) all[v] = all[v] || buried[v];
    return all;
}

std::uint32_t Solution::State::material_of(std::uint32_t surface) const {
    return static_cast<std::uint32_t>(at(scene->objects[at(scene->geometry->surfaces[surface].object)].material));
}

std::optional<std::size_t> Solution::State::luminaire_of(std::uint32_t surface, bool back) const {
    const auto& luminaire = object_luminaire[at(scene->geometry->surfaces[surface].object)];
    if (!luminaire) return std::nullopt;
    const EmitSide side = scene->luminaires[at(*luminaire)].side;
    if (side != EmitSide::both && (side == EmitSide::back) != back) return std::nullopt;
    return at(*luminaire);
}

bool Solution::State::luminaire_is_lit(std::size_t luminaire) const {
    if (scene->solve.solver != SolverKind::shooting || !solving) return scene->solve.solver != SolverKind::shooting;
    return shooting.luminaire_has_shot()[luminaire] != 0;
}

const ChannelField& Solution::State::indirect() const {
    return scene->solve.solver == SolverKind::shooting ? shooting.indirect() : indirect_irradiance;
}

std::vector<float> Solution::State::ambient() const {
    return scene->solve.solver == SolverKind::shooting && solving ? shooting.ambient() : std::vector<float>{};
}

Solution::Solution(std::shared_ptr<const Scene> scene)
    : state_(std::make_unique<State>()) {
    state_->scene = std::move(scene);
    make_channels(*state_);
}
Solution::~Solution() = default;
Solution::Solution(Solution&&) noexcept = default;
Solution& Solution::operator=(Solution&&) noexcept = default;

void Solution::update(std::shared_ptr<const Scene> scene, SolveFrom stale) {
    State& s = *state_;
    const SolveSettings before = s.scene->solve;
    s.scene = std::move(scene);
    if (stale == SolveFrom::nothing) return;
    s.status.seconds = 0;
    s.status.last_edit_seconds = 0;
    s.status.settled = false;
    s.edit_open = true;
    if (stale == SolveFrom::mesh) {
        auto fresh = std::make_unique<State>();
        fresh->scene = s.scene;
        state_ = std::move(fresh);
        make_channels(*state_);
        return;
    }
    const auto wavelengths_before = s.wavelengths;
    const auto rho_before = s.material_rho, exitance_before = s.luminaire_exitance;
    const int channels_before = s.channels();
    make_channels(s);
    const bool same_channels = s.channels() == channels_before && s.wavelengths->nm == wavelengths_before->nm &&
                               s.wavelengths->spec == wavelengths_before->spec;
    // Another lamp of the same flux where all lamps have one spectrum: only the weights to XYZ have changed.
    const bool same_sources =
        same_channels && s.material_rho == rho_before && nearly_equal(s.luminaire_exitance, exitance_before);
    if (s.scene->solve.solver != before.solver || !same_channels || stale == SolveFrom::black ||
        s.phase == SolvePhase::failed)
        s.solving = false; // nothing of the old radiosities can be used
    if (s.scene->solve.target_error != before.target_error || s.scene->solve.max_rays != before.max_rays) {
        s.passes.clear(); // the number of rays follows from the settings, never from what was there before
        s.passes_wanted = s.refined ? independent_sets : 1;
        s.rays_planned = false;
        s.pass_open = false;
        s.solving = false;
    }
    const bool shooting = s.scene->solve.solver == SolverKind::shooting;
    const bool transport_ready = s.phase != SolvePhase::mesh && s.phase != SolvePhase::sketch &&
                                 s.phase != SolvePhase::light && s.phase != SolvePhase::burial;
    if (!transport_ready) return;
    if (std::exchange(s.pass_open, false)) s.passes.pop_back(); // half traced: again later
    if (shooting) {
        if (!s.refined) {
            s.phase = SolvePhase::refine;
            return;
        }
        start_shooting(s);
        s.phase = SolvePhase::shoot;
        return;
    }
    if (s.passes.empty()) {
        s.phase = SolvePhase::gather;
        return;
    }
    s.status.sweeps = 0;
    if (!s.solving || !same_sources) start_gathering(s, !s.solving);
    s.phase = SolvePhase::sweep;
}

bool Solution::step(const std::atomic<bool>& cancel, bool one_shot) {
    State& s = *state_;
    if (s.phase == SolvePhase::settled || s.phase == SolvePhase::failed) return false;
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
    case SolvePhase::gather:
        step_gather(s, cancel);
        break;
    case SolvePhase::sweep:
        step_sweep(s, cancel);
        break;
    case SolvePhase::refine:
        step_refine(s, cancel);
        break;
    case SolvePhase::shoot:
        step_shoot(s, cancel, one_shot);
        break;
    case SolvePhase::settled:
    case SolvePhase::failed:
        break;
    }
    s.status.rays += s.direct->rays() - direct_before;
    if (s.status.stage == SolveStage::direct) s.status.progress = s.direct->progress();
    if (s.phase == SolvePhase::gather && s.receivers.count() > 0 && s.passes_wanted > 0) {
        const double traced = double(s.passes.size()) - (s.pass_open ? 1 - double(s.cursor) / s.receivers.count() : 0);
        s.status.progress = std::clamp(traced / s.passes_wanted, 0.0, 1.0);
    }
    s.status.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (s.edit_open && s.phase == SolvePhase::settled) {
        s.edit_open = false;
        s.status.last_edit_seconds = s.status.seconds;
    }
    return s.phase != SolvePhase::settled && s.phase != SolvePhase::failed;
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
std::shared_ptr<const Field> Solution::field() const {
    return state_->published_mesh ? compose_field(*state_) : nullptr;
}

} // namespace lueur
