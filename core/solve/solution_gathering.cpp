// The gathering solver in a solution: rows of rays, as many as the target error needs, and sweeps over them.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "core/solve/gathering_sources.h"
#include "core/solve/least_absorbed.h"
#include "core/solve/ray_budget.h"
#include "core/solve/solution_steps.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr double first_residual_target = 5e-3; // of the first picture, whose rays know no more
constexpr std::uint32_t coarse_passes = 2;     // before the mesh is refined
constexpr double smoothing_farthest = 3;       // coarse element sizes
constexpr double ray_share = 0.7;              // of the target error that the rays may take; interpolation has the rest

using State = Solution::State;

// What the status calls unshot: luminous flux still to be sent on its way, of what the luminaires emit.
double unshot_flux_share(const State& s) {
    const std::vector<float> area = receiver_areas(s);
    const double flux = tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::uint32_t>(0, s.receivers.count(), 1024), 0.0,
        [&](const auto& range, double sum) {
            for (std::uint32_t i = range.begin(); i < range.end(); ++i)
                sum += area[i] * std::abs(luminous(s, s.system.residual()[i]));
            return sum;
        },
        std::plus<>());
    return s.status.emitted_lumens > 0 ? flux / s.status.emitted_lumens : 0;
}

// In a part of the scene that keeps all its light the radiosity grows without end: say so instead of iterating. Light
// of a receiver can end if it absorbs, if one of its rays leaves the scene, or if one ends where light can.
bool has_no_finite_solution(const State& s) {
    const std::uint32_t n = s.receivers.count();
    if (s.status.emitted_lumens <= 0 || s.passes.empty()) return false;
    for (int c = 0; c < s.channels(); ++c) {
        const auto is_white = [&](const std::vector<double>& rho) {
            return rho[static_cast<std::size_t>(c)] >= 1 - least_absorbed;
        };
        if (std::none_of(s.material_rho.begin(), s.material_rho.end(), is_white)) continue; // as nearly always
        std::vector<std::uint8_t> ends(n + 1, 1);
        bool any_white = false;
        for (std::uint32_t i = 0; i < n; ++i) {
            ends[i] = s.receivers.buried[i] ||
                      !is_white(s.material_rho[s.material_of(s.mesh.vertices[s.receivers.vertex[i]].surface)]);
            any_white = any_white || !ends[i];
        }
        for (bool changed = any_white; changed;) {
            changed = false;
            for (std::uint32_t i = 0; i < n; ++i) {
                for (std::size_t p = 0; p < s.passes.size() && !ends[i]; ++p)
                    for (int k = 0; k < rays_per_pass && !ends[i]; ++k)
                        ends[i] = ends[s.passes[p].ends[std::size_t(i) * rays_per_pass + std::size_t(k)]];
                changed = changed || ends[i] == 1;
                if (ends[i] == 1) ends[i] = 2; // counted
            }
        }
        for (std::uint32_t i = 0; i < n; ++i)
            if (!ends[i] && s.gathered_direct[i][c] > 0) return true;
    }
    return false;
}

// What light can be at least, in each channel: nothing; without end where luminaires or paints lie outside the gamut of
// trichromatic channels.
std::vector<float> least_light(const State& s) {
    std::vector<float> least(static_cast<std::size_t>(s.channels()), 0);
    for (const auto* all : {&s.luminaire_exitance, &s.material_rho})
        for (const std::vector<double>& values : *all)
            for (std::size_t c = 0; c < values.size(); ++c)
                if (values[c] < 0) least[c] = -std::numeric_limits<float>::infinity();
    return least;
}

// Sweeps make the residual small, not each value: on the way some are less than nothing, and planes laid through steep
// places are too. The solution is not.
void refresh_indirect(State& s) {
    const LightSamples& samples = s.direct->samples();
    const std::vector<float> least = least_light(s);
    ChannelField& indirect = s.indirect_irradiance;
    if (indirect.count != s.mesh.indirect_vertex_count)
        indirect = ChannelField(s.mesh.indirect_vertex_count, s.channels());
    const auto for_all_vertices = [&](const auto& f) {
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, indirect.count, 256), [&](const auto& range) {
            for (std::uint32_t v = range.begin(); v < range.end(); ++v) f(v);
        });
    };
    for_all_vertices([&](std::uint32_t v) {
        std::fill_n(indirect[v], least.size(), 0.0f);
        const auto add = [&](std::uint32_t i, float weight) {
            for (std::size_t c = 0; c < least.size(); ++c)
                indirect[v][c] += weight * (s.gathered_direct[i][c] + s.system.gathered()[i][c]);
        };
        if (samples.is_sample(v))
            add(s.receivers.of_vertex[v], 1);
        else
            for (const LightSamples::Reading& r : samples.readings_of(v)) add(r.sample, r.weight);
    });
    smooth(s.smoothing, indirect);
    s.indirect_stale = false;
    for_all_vertices([&](std::uint32_t v) {
        for (std::size_t c = 0; c < least.size(); ++c) indirect[v][c] = std::max(least[c], indirect[v][c]);
    });
}

// What reads samples is smooth already.
void renew_smoothing(State& s) {
    if (s.rows_of_smoothing == s.passes_traced) return;
    s.rows_of_smoothing = s.passes_traced;
    std::vector<std::uint8_t> left_out = s.buried;
    for (std::uint32_t v = 0; v < left_out.size(); ++v)
        left_out[v] = left_out[v] || !s.direct->samples().stands_alone(v);
    s.smoothing = make_smoothing(s.mesh, s.mesh.indirect_elements, left_out, s.indirect_distance,
                                 smoothing_reach(static_cast<std::uint32_t>(s.passes.size()) * rays_per_pass),
                                 static_cast<float>(smoothing_farthest * s.element_size));
}

// Receivers that have come to those of the system are given what the vertices have between which they lie: a picture
// that is there does not go dark while the finer one is solved.
ChannelField radiosity_of_more_receivers(const State& s) {
    const ChannelField& known = s.system.radiosity();
    const std::uint32_t before = s.system.count(), count = s.receivers.count();
    ChannelField guess(count + 1, s.channels());
    for (std::uint32_t i = 0; i < count; ++i) {
        if (i < before) {
            std::copy_n(known[i], guess.stride, guess[i]);
            continue;
        }
        for (const std::uint32_t parent : s.mesh.vertices[s.receivers.vertex[i]].parents) { // they come first
            if (parent == no_index) continue;
            const float* row = guess[s.receivers.of_vertex[parent]];
            for (int c = 0; c < guess.stride; ++c) guess[i][c] += 0.5f * row[c];
        }
    }
    return guess;
}

// Rays that the system knows nothing of: edits come between passes too.
bool has_other_rows(const State& s) {
    return !s.solving || s.rows_of_system != s.passes_traced;
}

// What takes long of giving the system other rows or sources, slice by slice; true when the rest is left.
bool prepare_rows(State& s, const std::atomic<bool>& cancel) {
    TimeSlice slice(cancel);
    renew_smoothing(s);
    if (slice.over()) return false;
    if (!s.rows_in_the_making) {
        const std::uint32_t n = s.receivers.count();
        s.rows_in_the_making.emplace(reflected_direct(s, s.luminaire_exitance), ChannelField(n, s.channels()));
        if (s.solving && s.system.count() > 0 && s.system.count() != n)
            s.rows_in_the_making->guess = radiosity_of_more_receivers(s);
        if (slice.over()) return false;
    }
    State::RowsInTheMaking& d = *s.rows_in_the_making;
    if (d.cursor < d.gathered.count) {
        if (!apply_rows(s.passes, RayEnds::fine, d.reflected, d.cursor, d.gathered, cancel)) return false;
        if (slice.over()) return false;
    }
    if (!has_other_rows(s)) return true; // what arrives by them is known
    if (d.arriving.count == 0) d.arriving = ChannelField(s.receivers.count(), s.channels());
    const bool from_black = !s.solving || s.system.count() == 0; // then nothing arrives
    if (!from_black && d.arriving_cursor < d.arriving.count) {
        const ChannelField& radiosity = d.guess ? *d.guess : s.system.radiosity();
        if (!apply_rows(s.passes, RayEnds::coarse, radiosity, d.arriving_cursor, d.arriving, cancel)) return false;
        if (slice.over()) return false;
    }
    return true;
}

// Other rays: those that there are more of now start from what is known, and one reflection of direct light is as
// gathered by them.
void set_other_rows(State& s, State::RowsInTheMaking rows) {
    s.light_bases.forget();
    s.basis_in_the_making.reset();
    if (!s.solving || s.system.count() != s.receivers.count()) {
        s.system = GatherSystem(s.receivers.count(), s.channels(), receiver_areas(s));
        if (rows.guess) s.system.set_guess(std::move(*rows.guess));
    }
    s.system.set_rows(std::move(rows.arriving));
    s.rows_of_system = s.passes_traced;
}

void begin_sweeps(State& s) {
    s.solving = true;
    s.status.sweeps = 0;
    s.sweep_uncounted = false;
    if (!s.indirect_stale) refresh_indirect(s);
    s.phase = SolvePhase::solve;
}

// Of a dimmer or a spectrum: what is known of each luminaire alone, added up; false where not enough is.
bool add_up_luminaires(State& s) {
    s.light_bases.keep_for(room_for_bases(s), s.material_rho);
    auto known = s.light_bases.sum(s.luminaire_exitance);
    if (!known) return false;
    s.gathered_direct = std::move(known->gathered);
    s.system.set_sources(rho_of_receivers(s), s.gathered_direct, std::move(known->radiosity),
                         std::move(known->arriving));
    s.indirect_stale = false;
    begin_sweeps(s);
    return true;
}

// Planning wavelengths takes as long as several frames: paints that are dragged ask for them when the hand rests.
// False: they are not there yet, or it starts anew in others.
bool take_choice(State& s) {
    if (!s.choosing.valid()) plan_channels(s);
    if (!is_ready(s.choosing)) return false;
    const SameChannels same = take_channels(s, false);
    if (same.channels && same.sources) return true;
    if (!same.channels) s.solving = false;
    start_gathering(s, false);
    return false;
}

// New sources, paints or rays: one reflection of direct light is gathered anew, then the system holds them.
void take_rows(State& s, const std::atomic<bool>& cancel) {
    if (!prepare_rows(s, cancel) || (s.choice_waits && !take_choice(s))) return;
    s.rows_wait = false;
    State::RowsInTheMaking rows = *std::exchange(s.rows_in_the_making, std::nullopt);
    if (!s.solving) s.indirect_irradiance = {};         // of other channels, or another solver's
    s.indirect_stale = s.indirect_irradiance.count > 0; // a picture that is there stays until the next step
    s.gathered_direct = std::move(rows.gathered);
    if (has_other_rows(s)) set_other_rows(s, std::move(rows));
    s.system.set_sources(rho_of_receivers(s), s.gathered_direct);
    begin_sweeps(s);
}

std::uint32_t most_passes(const State& s) {
    constexpr int group = independent_sets * rays_per_pass;
    return independent_sets * std::max<std::uint32_t>(1, static_cast<std::uint32_t>(s.scene->solve.max_rays) / group);
}

// More rays? Asked each time there are as many as were wanted; the answer depends on the geometry only. The error of a
// quasi-random set falls somewhat faster than one over the root of its rays; two thirds of the way that would leave are
// gone at once. False: it had been answered.
bool plan_passes(State& s) {
    const std::uint32_t now = static_cast<std::uint32_t>(s.passes.size());
    if (s.rays_planned || now < s.passes_wanted) return false;
    const double target = ray_share * s.scene->solve.target_error;
    const double error = grey_ray_error(s.passes, std::span(s.direct->guessed_light()).first(fine_vertices_of_rays(s)),
                                        receiver_areas(s), smoothed_receivers(s));
    if (error <= target || now >= most_passes(s)) {
        s.rays_planned = true;
        return true;
    }
    const double needed = now * std::pow(error / target, 4.0 / 3);
    std::uint32_t next = now + std::max(1u, static_cast<std::uint32_t>(0.67 * (needed - now)));
    next = (next + independent_sets - 1) / independent_sets * independent_sets;
    s.passes_wanted = std::min(most_passes(s), next);
    return true;
}

} // namespace

void start_gathering(State& s, bool same_sources) {
    const bool has_sources = same_sources && !s.rows_wait;
    s.only_probes_left = s.rows_wait = false;
    s.rows_in_the_making.reset();
    if (std::exchange(s.pass_open, false)) s.passes.pop_back(); // half traced: again
    if (s.passes.empty()) {
        // The number of rays follows from the settings and the geometry, never from what was there before.
        s.passes_wanted = s.refined ? independent_sets : 1;
        s.rays_planned = false;
        s.phase = SolvePhase::transport;
        return;
    }
    s.status.sweeps = 0;
    s.phase = SolvePhase::solve;
    if (has_other_rows(s)) {
        const std::atomic<bool> never{false};
        s.rows_wait = true;
        while (s.rows_wait) take_rows(s, never);
    } else if (!has_sources && !add_up_luminaires(s)) {
        // Gathered in steps. What is shown meanwhile is the light there was, as the new paints reflect it.
        s.rows_wait = true;
        s.phase = SolvePhase::transport;
    }
}

void trace_gathering_rows(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = s.rows_wait ? SolveStage::solving : SolveStage::gathering_rays;
    if (s.rows_wait) return take_rows(s, cancel);
    if (!s.pass_open) {
        // Rays of the level before end elsewhere now, and are not traced again; on this one they are kept in turn, if
        // there is another to come.
        std::vector<RayHit> hits;
        const std::size_t rays = std::size_t(s.receivers.count()) * rays_per_pass;
        if (s.passes.size() < s.kept_hits.size()) hits = std::move(s.kept_hits[s.passes.size()]);
        if (!s.refined && s.passes.empty()) hits = hits_of_burial(s.receivers, std::exchange(s.around.hits, {}));
        if (!s.fully_refined()) hits.resize(rays);
        s.passes.push_back(make_gather_pass(s.mesh, s.receivers, std::move(hits)));
        s.pass_buried = s.all_buried();
        s.cursor = 0;
        s.pass_open = true;
    }
    const std::uint32_t pass = static_cast<std::uint32_t>(s.passes.size()) - 1;
    std::atomic<std::uint64_t> traced{0};
    const bool done =
        run_slice(s.cursor, s.receivers.count(), 64, cancel, [&](std::uint32_t first, std::uint32_t last) {
            traced.fetch_add(trace_gather_rays(*s.world, s.mesh, s.origins, s.receivers, s.pass_buried,
                                               s.scene->solve.seed, pass, first, last, s.passes.back()),
                             std::memory_order_relaxed);
        });
    s.status.rays += traced.load();
    if (!done) return;
    s.pass_open = false;
    ++s.passes_traced;
    if (s.fully_refined()) s.passes.back().hits = {};
    s.status.rays_per_receiver = static_cast<std::uint32_t>(s.passes.size()) * rays_per_pass;
    s.status.row_entries = std::uint64_t(s.receivers.count()) * s.status.rays_per_receiver;
    if (s.passes.size() < s.passes_wanted) return;
    if (s.passes.size() < s.kept_hits.size()) { // seen already, on the level before: no picture of them
        renew_smoothing(s);
        plan_passes(s);
        if (s.passes.size() < s.passes_wanted) return;
    }
    s.rows_wait = true;
    s.status.sweeps = 0; // over these
    take_rows(s, cancel);
}

// First what tells most: rays, as long as they are few, then shadows' edges and contacts.
void want_more_coarse_passes(State& s) {
    s.passes_wanted = std::min(coarse_passes, 2 * s.passes_wanted);
    s.phase = SolvePhase::transport;
}

void step_gathering(State& s, const std::atomic<bool>& cancel) {
    s.status.stage = SolveStage::solving;
    if (s.only_probes_left) {
        if (ask_probes(s, cancel)) settle(s);
        return;
    }
    TimeSlice slice(cancel);
    const bool begun = s.status.sweeps > 0 || s.sweep_uncounted || s.system.sweeping();
    if (!begun && has_no_finite_solution(s)) return fail(s, no_finite_solution);
    const double target = s.fully_refined() ? residual_target : first_residual_target;
    if (!s.indirect_stale && !s.sweep_uncounted && s.system.relative_residual() > target) {
        if (!s.system.sweep(s.passes, cancel)) return;
        s.indirect_stale = s.sweep_uncounted = true;
        if (s.system.diverged() || s.status.sweeps >= most_gathering_sweeps)
            return fail(s, "the solver does not converge on this scene; a reflectance is too close to 1");
        if (slice.over()) return;
    }
    if (s.indirect_stale) {
        refresh_indirect(s);
        if (slice.over()) return;
    }
    // Counted when all that comes of it is there, so that what is counted does not depend on the clock.
    const auto count_sweep = [&] { s.status.sweeps += std::exchange(s.sweep_uncounted, false); };
    s.status.unshot_share = unshot_flux_share(s);
    s.status.residual = s.system.relative_residual();
    if (s.system.relative_residual() > target) return count_sweep();
    s.rays_unjudged = true;
    const bool refined = s.fully_refined();
    if (refined && plan_passes(s)) return; // in a step of its own
    count_sweep();
    if (refined && s.passes.size() >= s.passes_wanted && s.probes.complete()) return settle(s);
    if (!s.direct->is_lit()) {
        s.phase = SolvePhase::light;
        return;
    }
    take_stock_of_gathering(s); // a settled solution is judged when it is shown
    if (refined) {
        s.only_probes_left = s.passes.size() >= s.passes_wanted;
        if (!s.only_probes_left) s.phase = SolvePhase::transport;
    } else if (!s.refined && s.passes.size() < coarse_passes) {
        want_more_coarse_passes(s);
    } else {
        s.phase = SolvePhase::refine;
    }
}

double gathering_progress(const State& s) {
    if (s.receivers.count() == 0 || s.passes_wanted == 0) return 0;
    const double traced = double(s.passes.size()) - (s.pass_open ? 1 - double(s.cursor) / s.receivers.count() : 0);
    return std::clamp(traced / s.passes_wanted, 0.0, 1.0);
}

std::vector<float> unshot_of_gathering(const State& s) {
    std::vector<float> unshot(s.indirect_irradiance.count);
    tbb::parallel_for(std::size_t(0), unshot.size(), [&](std::size_t v) {
        unshot[v] = static_cast<float>(std::abs(luminous(s, s.system.residual()[s.receivers.of_vertex[v]])));
    });
    return unshot;
}

} // namespace lueur
