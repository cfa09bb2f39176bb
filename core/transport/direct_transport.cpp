#include "core/transport/direct_transport.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "core/transport/gather_rows.h"
#include "core/transport/many_lights.h"
#include "core/transport/sampling.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr std::uint32_t most_sketched = 32; // pieces of luminaires that a first guess asks
constexpr float sketched_exactly = 2;       // radii: closer luminaires are too unlike what one point of them tells
constexpr float look_share = 0.3f;         // of what a place counts for, where one of many luminaires is only looked at
constexpr float small_size = 0.25f;        // of the coarse element size: what is smaller counts by its area
constexpr float long_edge_share = 0.4f;    // of the coarse element size: longer edges are looked at in any case
constexpr std::uint32_t places_a_task = 8; // one takes 40 us in an office of 14 luminaires: few, for steps are short

} // namespace

DirectTransport::DirectTransport(const World& world, Mesh& mesh, std::vector<Emitter> emitters,
                                 const DirectParams& params, LightSamples samples)
    : world_(world)
    , mesh_(mesh)
    , emitters_(std::move(emitters))
    , params_(params)
    , samples_(std::move(samples))
    , edges_(mesh, params.most_vertices, params.room) {
    weight_ = guessed_exitances(emitters_);
    for (std::uint32_t l = 0; l < emitters_.size(); ++l)
        for (const Emitter& piece :
             emitters_[l].parts.empty() ? std::span<const Emitter>(&emitters_[l], 1) : emitters_[l].parts)
            if (piece.area > 0) pieces_.push_back({&piece, l});
    buried_.assign(mesh_.vertices.size(), 0);
    rows_.resize(mesh_.vertices.size() - sampled_vertices() + samples_.count());
    known_.assign(rows_.size(), 0);
    guessed_.assign(mesh_.vertices.size(), 0);
    follow_places();
}

// Where rays start, and what each row stands for.
void DirectTransport::follow_places() {
    origins_ = ray_origins(mesh_, world_.epsilon());
    const std::vector<float> area = vertex_areas(mesh_);
    row_area_.assign(rows_.size(), 0);
    for (std::uint32_t v = 0; v < area.size(); ++v)
        row_area_[v < sampled_vertices() ? samples_.of_vertex[v] : row_of(v)] += area[v];
}

void DirectTransport::read_guessed_light() {
    std::vector<float> at_rows;
    at_rows.reserve(rows_.size());
    for (const DirectRow& row : rows_) at_rows.push_back(guessed_light(row));
    guessed_.assign(mesh_.vertices.size(), 0);
    read_rows(at_rows, 1, guessed_);
}

// size: m, across what this light stands for.
DirectRow DirectTransport::row_at(glm::vec3 origin, glm::vec3 normal, float size, Care care) const {
    static thread_local std::vector<float> factors, deviations;
    factors.resize(emitters_.size());
    deviations.resize(emitters_.size());
    const float part = params_.element_size > 0 ? std::min(1.0f, size / (small_size * params_.element_size)) : 1;
    const float share = part * part * (care == Care::looked_at && emitters_.size() > 1 ? look_share : 1);
    rays_.fetch_add(
        direct_form_factors(world_, emitters_, weight_, origin, normal, share, factors.data(), deviations.data()),
        std::memory_order_relaxed);
    std::size_t seen = 0;
    for (std::size_t l = 0; l < emitters_.size(); ++l) seen += factors[l] != 0 || deviations[l] != 0;
    DirectRow row;
    row.reserve(seen);
    for (std::uint32_t l = 0; l < emitters_.size(); ++l)
        if (factors[l] != 0 || deviations[l] != 0) row.push_back({l, factors[l], deviations[l]});
    return row;
}

float DirectTransport::guessed_light(const DirectRow& row) const {
    float sum = 0;
    for (const DirectShare& share : row) sum += weight_[share.emitter] * share.factor;
    return sum;
}

void DirectTransport::read_rows(std::span<const float> at_rows, std::size_t stride,
                                std::span<float> at_vertices) const {
    const auto count = static_cast<std::uint32_t>(mesh_.vertices.size());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 1024), [&](const auto& range) {
        for (std::uint32_t v = range.begin(); v < range.end(); ++v) {
            float* out = at_vertices.data() + v * stride;
            const auto add = [&](std::uint32_t row, float weight) {
                for (std::size_t k = 0; k < stride; ++k) out[k] += weight * at_rows[row * stride + k];
            };
            if (const std::uint32_t row = row_of(v); row != no_index)
                add(row, 1);
            else
                for (const LightSamples::Reading& r : samples_.readings_of(v)) add(r.sample, r.weight);
        }
    });
}

std::size_t DirectTransport::bytes() const {
    std::size_t sum = rows_.size() * sizeof(DirectRow);
    for (const DirectRow& row : rows_) sum += row.capacity() * sizeof(DirectShare);
    return sum;
}

double DirectTransport::progress() const {
    const std::uint32_t count = row_count();
    if (sketch_cursor_ < count && row_cursor_ == 0) return double(sketch_cursor_) / count;
    if (row_cursor_ < count) return double(row_cursor_) / count;
    return refined_ || edges_.edges().empty() ? 1 : double(edge_cursor_) / double(edges_.edges().size());
}

// A first guess: one ray to each piece of a luminaire, or to a few drawn by what they would give without shadows, each
// for as many as it was drawn among (systematic sampling: all of even light are drawn in turn).
DirectRow DirectTransport::sketched_row(std::uint32_t v) const {
    const glm::vec3 origin = origins_[v], normal = mesh_.vertices[v].normal;
    static thread_local std::vector<float> shares;
    shares.assign(pieces_.size(), 0.0f);
    float all = 0;
    const auto target = [&](std::uint32_t p) -> const EmitterPoint& {
        const std::vector<EmitterPoint>& points = pieces_[p].emitter->points;
        return points[hash(v, p) % points.size()];
    };
    std::uint32_t shining = 0;
    for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
        const Emitter& piece = *pieces_[p].emitter;
        shares[p] = glm::distance(origin, piece.centre) < sketched_exactly * piece.radius
                        ? unshadowed_form_factor(piece, origin, normal)
                        : emitter_kernel(origin, normal, target(p)) * piece.area / std::numbers::pi_v<float>;
        all += weight_[pieces_[p].luminaire] * shares[p];
        shining += shares[p] > 0;
    }
    DirectRow row;
    const float step = shining > most_sketched ? all / most_sketched : 0;
    float next = step * unit_float(hash(v));
    for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
        if (!(shares[p] > 0)) continue;
        const std::uint32_t l = pieces_[p].luminaire;
        float counts = 1;
        if (step > 0) {
            counts = 0;
            const float light = weight_[l] * shares[p];
            for (next -= light; next < 0; next += step) counts += step / light;
        }
        if (!(counts > 0) || !sees(world_, origin, target(p).position)) continue;
        if (row.empty() || row.back().emitter != l) row.push_back({l, 0, 0});
        row.back().factor += counts * shares[p];
    }
    return row;
}

bool DirectTransport::sketch(const std::atomic<bool>& cancel) {
    const bool done = run_slice(sketch_cursor_, row_count(), 128, cancel, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t r = first; r < last; ++r) rows_[r] = sketched_row(vertex_of(r));
        rays_.fetch_add(std::uint64_t(last - first) * std::min<std::size_t>(most_sketched, pieces_.size()),
                        std::memory_order_relaxed);
    });
    if (done) read_guessed_light();
    return done;
}

bool DirectTransport::light_vertices(const std::atomic<bool>& cancel) {
    const std::uint32_t count = row_count(), before = row_cursor_;
    if (lit_rows_ == count && !spread_pending_) return true;
    const bool done =
        run_slice(row_cursor_, count, places_a_task, cancel, [&](std::uint32_t first, std::uint32_t last) {
            for (std::uint32_t r = first; r < last; ++r) {
                const std::uint32_t v = vertex_of(r);
                if (!known_[r])
                    rows_[r] = row_at(origins_[v], mesh_.vertices[v].normal, std::sqrt(row_area_[r]), Care::kept);
                buried_[v] = 0;
                if (guessed_light(rows_[r]) == 0) find_buried(world_, mesh_, origins_, 0, v, v + 1, buried_);
            }
        });
    if (!done) return false;
    if (lit_rows_ != count) {
        lit_rows_ = count;
        for (std::uint32_t v = 0; v < sampled_vertices(); ++v)
            buried_[v] = buried_[samples_.vertex[samples_.of_vertex[v]]];
        read_guessed_light();
    }
    if (floor_ == 0 && count > 0) {
        double sum = 0;
        for (const float light : guessed_) sum += light;
        floor_ = static_cast<float>(0.25 * sum / double(guessed_.size())); // darker: a relative error is not seen
    }
    if (!spread_pending_) return true;
    if (before < count) return false; // the rest in a step of its own
    spread_deviations();
    spread_pending_ = false;
    return true;
}

bool DirectTransport::begin_level(const std::atomic<bool>& cancel) {
    // A short edge whose ends agree hides no more than a shadow thinner than itself; one shorter than a group is wide,
    // between vertices that read samples, is not looked at.
    const float long_edge = long_edge_share * params_.element_size;
    const auto wanted = [&](std::uint32_t a, std::uint32_t b) {
        if (buried_[a] && buried_[b]) return false;
        const float length = glm::distance(mesh_.vertices[a].position, mesh_.vertices[b].position);
        if (!samples_.stands_alone(a) && !samples_.stands_alone(b) && length <= samples_.cell) return false;
        const float at_a = guessed_[a], at_b = guessed_[b];
        return length > long_edge || std::abs(at_a - at_b) > params_.tolerance * std::max({at_a, at_b, floor_});
    };
    if (!edges_.collect(params_.smallest_edge, wanted, cancel)) return false;
    edge_cursor_ = 0;
    edge_rows_.assign(edges_.edges().size(), {});
    return true;
}

std::vector<float> DirectTransport::bent_edges() {
    edge_cursor_ = 0;
    std::vector<float> bent(edges_.edges().size(), 0); // the misfit where it is too large
    for (std::size_t e = 0; e < bent.size(); ++e) {
        const EdgeRefinement::Edge& edge = edges_.edges()[e];
        if (!edges_.is_asked(edge)) continue;
        const float here = guessed_light(edge_rows_[e]);
        const float guess = 0.5f * (guessed_[edge.a] + guessed_[edge.b]);
        const float scale = std::max({here, guess, floor_});
        const float misfit = scale > 0 ? std::abs(here - guess) / scale : 0;
        const bool inside = buried_[edge.a] && buried_[edge.b];
        bent[e] = misfit > params_.tolerance && !inside ? misfit : 0;
        if (bent[e] == 0 && !inside) misfit_sum_ += double(misfit) * misfit, ++misfit_count_;
    }
    return bent;
}

void DirectTransport::split_bent() {
    const std::uint32_t before = static_cast<std::uint32_t>(mesh_.vertices.size());
    const std::uint32_t first_row = row_count();
    edges_.split();
    follow_vertices();
    const std::uint32_t after = static_cast<std::uint32_t>(mesh_.vertices.size());
    // Of a single luminaire a new vertex at a middle that was looked at is lit already; the others are lit now.
    row_cursor_ = first_row;
    if (emitters_.size() == 1)
        for (std::uint32_t v = before; v < after; ++v)
            if (const std::uint32_t looked_at = edges_.edge_of(v); looked_at != no_index) {
                rows_[row_of(v)] = std::move(edge_rows_[looked_at]);
                known_[row_of(v)] = 1;
            }
    refined_ = after == before || after >= params_.most_vertices;
    if (refined_) {
        misfit_ = misfit_count_ > 0 ? std::sqrt(misfit_sum_ / double(misfit_count_)) : 0;
        edge_rows_ = {};
        spread_pending_ = true;
    }
}

// Beside a penumbra six probes that agree may still be wrong by what lies between them: a seventh of the luminaire.
void DirectTransport::spread_deviations() {
    constexpr float share_between_probes = 0.07f;
    std::vector<std::vector<std::pair<std::uint32_t, float>>> beside(rows_.size());
    for (const glm::uvec3& e : mesh_.elements) {
        const std::array<std::uint32_t, 3> rows{row_of(e.x), row_of(e.y), row_of(e.z)};
        if (std::ranges::count(rows, no_index) > 0) continue;
        std::array<std::size_t, 3> next{};
        for (;;) { // one emitter after the other
            std::uint32_t l = no_index;
            for (std::size_t k = 0; k < 3; ++k)
                if (next[k] < rows_[rows[k]].size()) l = std::min(l, rows_[rows[k]][next[k]].emitter);
            if (l == no_index) break;
            float brightest = 0;
            bool mixed = false, lit = false, dark = false;
            for (std::size_t k = 0; k < 3; ++k) {
                float factor = 0, deviation = 0;
                const DirectRow& row = rows_[rows[k]];
                if (next[k] < row.size() && row[next[k]].emitter == l)
                    factor = row[next[k]].factor, deviation = row[next[k]].deviation, ++next[k];
                brightest = std::max(brightest, factor);
                mixed = mixed || deviation > 0.01f * factor;
                lit = lit || factor > 0;
                dark = dark || factor == 0;
            }
            if (mixed || (lit && dark))
                for (const std::uint32_t row : rows) beside[row].emplace_back(l, share_between_probes * brightest / 3);
        }
    }
    tbb::parallel_for(std::size_t(0), rows_.size(), [&](std::size_t r) {
        DirectRow& row = rows_[r];
        std::sort(beside[r].begin(), beside[r].end());
        const auto known = static_cast<std::ptrdiff_t>(row.size());
        for (const auto& [l, deviation] : beside[r]) { // the largest of an emitter comes last
            const auto found = std::lower_bound(row.begin(), row.begin() + known, l,
                                                [](const DirectShare& s, std::uint32_t e) { return s.emitter < e; });
            if (found != row.begin() + known && found->emitter == l)
                found->deviation = std::max(found->deviation, deviation);
            else if (static_cast<std::ptrdiff_t>(row.size()) > known && row.back().emitter == l)
                row.back().deviation = deviation;
            else
                row.push_back({l, 0, deviation});
        }
        std::inplace_merge(row.begin(), row.begin() + known, row.end(),
                           [](const DirectShare& a, const DirectShare& b) { return a.emitter < b.emitter; });
        row.shrink_to_fit();
        beside[r] = {};
    });
}

void DirectTransport::follow_mesh() {
    follow_vertices();
    if (!refined_) edges_.follow_mesh(); // refine() goes on from here
}

// New vertices have what their parents have.
void DirectTransport::follow_vertices() {
    const std::uint32_t before = static_cast<std::uint32_t>(buried_.size());
    const std::uint32_t count = static_cast<std::uint32_t>(mesh_.vertices.size());
    rows_.resize(rows_.size() + (count - before));
    known_.resize(rows_.size(), 0);
    buried_.resize(count, 0);
    guessed_.resize(count, 0);
    std::vector<float> factors(emitters_.size()), deviations(emitters_.size());
    for (std::uint32_t v = before; v < count; ++v) {
        const auto& p = mesh_.vertices[v].parents;
        buried_[v] = buried_[p[0]] && buried_[p[1]];
        guessed_[v] = 0.5f * (guessed_[p[0]] + guessed_[p[1]]);
        std::ranges::fill(factors, 0.0f);
        std::ranges::fill(deviations, 0.0f);
        for (const std::uint32_t parent : p)
            each_share(parent, [&](const DirectShare& share, float part) {
                factors[share.emitter] += 0.5f * part * share.factor;
                deviations[share.emitter] = std::max(deviations[share.emitter], part * share.deviation);
            });
        DirectRow& row = rows_[row_of(v)];
        for (std::uint32_t l = 0; l < emitters_.size(); ++l)
            if (factors[l] != 0 || deviations[l] != 0) row.push_back({l, factors[l], deviations[l]});
    }
    follow_places();
}

bool DirectTransport::refine(const std::atomic<bool>& cancel, std::uint32_t levels) {
    if (refined() || level_ >= levels) return true;
    const EdgeRefinement::Level level{[&] { return begin_level(cancel); }, [&] { return look(cancel); },
                                      [&] { return bent_edges(); }, [&] { split_bent(); }, 1};
    if (!edges_.step(level, cancel)) return false;
    edge_cursor_ = 0;
    ++level_;
    return refined_ || level_ >= levels;
}

bool DirectTransport::look(const std::atomic<bool>& cancel) {
    const float epsilon = world_.epsilon();
    return run_slice(edge_cursor_, static_cast<std::uint32_t>(edges_.edges().size()), places_a_task, cancel,
                     [&](std::uint32_t first, std::uint32_t last) {
                         for (std::uint32_t e = first; e < last; ++e) {
                             const EdgeRefinement::Edge& edge = edges_.edges()[e];
                             if (!edges_.is_asked(edge)) continue;
                             const EdgeRefinement::Place middle = edges_.middle(edge, epsilon);
                             const float length =
                                 glm::distance(mesh_.vertices[edge.a].position, mesh_.vertices[edge.b].position);
                             edge_rows_[e] = row_at(middle.origin, middle.normal, length, Care::looked_at);
                         }
                     });
}

} // namespace lueur
