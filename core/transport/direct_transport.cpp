#include "core/transport/direct_transport.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/transport/gather_rows.h"
#include "core/transport/many_lights.h"
#include "core/transport/sampling.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

constexpr float look_share = 0.3f;         // of what a place counts for, where one of many luminaires is only looked at
constexpr float small_size = 0.25f;        // of the coarse element size: what is smaller counts by its area
constexpr float long_edge_share = 0.4f;    // of the coarse element size: longer edges are looked at in any case
constexpr std::uint32_t places_a_task = 8; // one takes 40 us in an office of 14 luminaires: few, for steps are short

} // namespace

DirectTransport::DirectTransport(const World& world, Mesh& mesh, std::vector<Emitter> emitters,
                                 const DirectParams& params)
    : world_(world)
    , mesh_(mesh)
    , emitters_(std::move(emitters))
    , params_(params)
    , edges_(mesh) {
    weight_ = guessed_exitances(emitters_);
    origins_ = ray_origins(mesh_, world_.epsilon());
    factors_.assign(mesh_.vertices.size() * emitters_.size(), 0);
    deviations_ = factors_;
    area_ = vertex_areas(mesh_);
    buried_.assign(mesh_.vertices.size(), 0);
    known_ = buried_;
}

// size: m, across what this light stands for.
void DirectTransport::light(glm::vec3 origin, glm::vec3 normal, float size, Care care, float* factors,
                            float* deviations) const {
    const float part = params_.element_size > 0 ? std::min(1.0f, size / (small_size * params_.element_size)) : 1;
    const float share = part * part * (care == Care::looked_at && emitters_.size() > 1 ? look_share : 1);
    rays_.fetch_add(direct_form_factors(world_, emitters_, weight_, origin, normal, share, factors, deviations),
                    std::memory_order_relaxed);
}

float DirectTransport::guessed_light(const float* factors) const {
    float sum = 0;
    for (std::size_t l = 0; l < emitters_.size(); ++l) sum += weight_[l] * factors[l];
    return sum;
}

double DirectTransport::progress() const {
    if (sketch_cursor_ < mesh_.vertices.size() && vertex_cursor_ == 0)
        return double(sketch_cursor_) / double(mesh_.vertices.size());
    if (vertex_cursor_ < mesh_.vertices.size()) return double(vertex_cursor_) / double(mesh_.vertices.size());
    return refined_ || edges_.edges().empty() ? 1 : double(edge_cursor_) / double(edges_.edges().size());
}

bool DirectTransport::sketch(const std::atomic<bool>& cancel) {
    const std::uint32_t count = static_cast<std::uint32_t>(mesh_.vertices.size());
    return run_slice(sketch_cursor_, count, 128, cancel, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t v = first; v < last; ++v)
            for (std::size_t l = 0; l < emitters_.size(); ++l)
                factors_[std::size_t(v) * emitters_.size() + l] =
                    direct_form_factor_sketch(world_, emitters_[l], origins_[v], mesh_.vertices[v].normal,
                                              hash(v, static_cast<std::uint32_t>(l)));
        rays_.fetch_add(std::uint64_t(last - first) * emitters_.size(), std::memory_order_relaxed);
    });
}

bool DirectTransport::light_vertices(const std::atomic<bool>& cancel) {
    const std::uint32_t count = static_cast<std::uint32_t>(mesh_.vertices.size()), before = vertex_cursor_;
    const bool done =
        run_slice(vertex_cursor_, count, places_a_task, cancel, [&](std::uint32_t first, std::uint32_t last) {
            for (std::uint32_t v = first; v < last; ++v) {
                const std::size_t row = std::size_t(v) * emitters_.size();
                float* factors = factors_.data() + row;
                if (!known_[v])
                    light(origins_[v], mesh_.vertices[v].normal, std::sqrt(area_[v]), Care::kept, factors,
                          deviations_.data() + row);
                buried_[v] = 0;
                if (guessed_light(factors) == 0) find_buried(world_, mesh_, origins_, 0, v, v + 1, buried_);
            }
        });
    if (done && floor_ == 0 && count > 0) {
        double sum = 0;
        for (std::uint32_t v = 0; v < count; ++v) sum += guessed_light(at_vertex(v));
        floor_ = static_cast<float>(0.25 * sum / count); // darker than this, a relative error is not seen
    }
    if (!done || !spread_pending_) return done;
    if (before < count) return false; // the rest in a step of its own
    spread_deviations();
    spread_pending_ = false;
    return true;
}

bool DirectTransport::begin_level(const std::atomic<bool>& cancel) {
    // A short edge whose ends agree hides no more than a shadow thinner than itself.
    const float long_edge = long_edge_share * params_.element_size;
    const auto wanted = [&](std::uint32_t a, std::uint32_t b) {
        if (buried_[a] && buried_[b]) return false;
        const float one = guessed_light(at_vertex(a)), other = guessed_light(at_vertex(b));
        if (std::abs(one - other) > params_.tolerance * std::max({one, other, floor_})) return true;
        return glm::distance(mesh_.vertices[a].position, mesh_.vertices[b].position) > long_edge;
    };
    if (!edges_.collect(params_.smallest_edge, wanted, cancel)) return false;
    edge_cursor_ = 0;
    edge_factors_.assign(edges_.edges().size() * emitters_.size(), 0);
    edge_deviations_ = edge_factors_;
    return true;
}

void DirectTransport::judge() {
    std::vector<float> bent(edges_.edges().size(), 0); // the misfit where it is too large
    for (std::size_t e = 0; e < bent.size(); ++e) {
        const EdgeRefinement::Edge& edge = edges_.edges()[e];
        const float here = guessed_light(edge_factors_.data() + e * emitters_.size());
        const float guess = 0.5f * (guessed_light(at_vertex(edge.a)) + guessed_light(at_vertex(edge.b)));
        const float scale = std::max({here, guess, floor_});
        const float misfit = scale > 0 ? std::abs(here - guess) / scale : 0;
        const bool inside = buried_[edge.a] && buried_[edge.b];
        bent[e] = misfit > params_.tolerance && !inside ? misfit : 0;
        if (bent[e] == 0 && !inside) misfit_sum_ += double(misfit) * misfit, ++misfit_count_;
    }
    edges_.judge(std::move(bent));
}

void DirectTransport::split_bent() {
    const std::uint32_t before = static_cast<std::uint32_t>(mesh_.vertices.size());
    edges_.split(params_.most_vertices);
    follow_vertices();
    const std::uint32_t after = static_cast<std::uint32_t>(mesh_.vertices.size());
    // Of a single luminaire a new vertex at a middle that was looked at is lit already; the others are lit now.
    vertex_cursor_ = before;
    if (emitters_.size() == 1)
        for (std::uint32_t v = before; v < after; ++v)
            if (const std::uint32_t looked_at = edges_.edge_of(v); looked_at != no_index) {
                factors_[v] = edge_factors_[looked_at];
                deviations_[v] = edge_deviations_[looked_at];
                known_[v] = 1;
            }
    refined_ = after == before || after >= params_.most_vertices;
    if (refined_) {
        misfit_ = misfit_count_ > 0 ? std::sqrt(misfit_sum_ / double(misfit_count_)) : 0;
        spread_pending_ = true;
    }
}

// Beside a penumbra six probes that agree may still be wrong by what lies between them: a seventh of the luminaire.
void DirectTransport::spread_deviations() {
    constexpr float share_between_probes = 0.07f;
    const std::size_t emitters = emitters_.size();
    std::vector<float> beside(deviations_.size(), 0);
    for (const glm::uvec3& e : mesh_.elements)
        for (std::size_t l = 0; l < emitters; ++l) {
            float brightest = 0;
            bool mixed = false, lit = false, dark = false;
            for (int k = 0; k < 3; ++k) {
                const std::size_t at = e[k] * emitters + l;
                brightest = std::max(brightest, factors_[at]);
                mixed = mixed || deviations_[at] > 0.01f * factors_[at];
                lit = lit || factors_[at] > 0;
                dark = dark || factors_[at] == 0;
            }
            if (mixed || (lit && dark))
                for (int k = 0; k < 3; ++k)
                    beside[e[k] * emitters + l] =
                        std::max(beside[e[k] * emitters + l], share_between_probes * brightest / 3);
        }
    for (std::size_t i = 0; i < beside.size(); ++i) deviations_[i] = std::max(deviations_[i], beside[i]);
}

void DirectTransport::follow_mesh() {
    follow_vertices();
    if (!refined_) edges_.follow_mesh(); // refine() goes on from here
    part_ = Part::prepare;
}

// New vertices have what their parents have.
void DirectTransport::follow_vertices() {
    const std::uint32_t before = static_cast<std::uint32_t>(buried_.size());
    const std::uint32_t count = static_cast<std::uint32_t>(mesh_.vertices.size());
    factors_.resize(std::size_t(count) * emitters_.size(), 0);
    deviations_.resize(factors_.size(), 0);
    buried_.resize(count, 0);
    known_.resize(count, 0);
    for (std::uint32_t v = before; v < count; ++v) {
        const auto& p = mesh_.vertices[v].parents;
        buried_[v] = buried_[p[0]] && buried_[p[1]];
        for (std::size_t l = 0; l < emitters_.size(); ++l) {
            const std::size_t at = v * emitters_.size() + l, a = p[0] * emitters_.size() + l,
                              b = p[1] * emitters_.size() + l;
            factors_[at] = 0.5f * (factors_[a] + factors_[b]);
            deviations_[at] = std::max(deviations_[a], deviations_[b]);
        }
    }
    origins_ = ray_origins(mesh_, world_.epsilon());
    area_ = vertex_areas(mesh_);
}

bool DirectTransport::refine(const std::atomic<bool>& cancel, std::uint32_t levels) {
    if (refined() || level_ >= levels) return true;
    switch (part_) { // each a step of its own
    case Part::prepare:
        if (edges_.prepare(cancel)) part_ = Part::begin;
        return false;
    case Part::begin:
        if (begin_level(cancel)) part_ = Part::look;
        return false;
    case Part::look:
        if (!look(cancel)) return false;
        judge();
        part_ = Part::plan;
        return false;
    case Part::plan:
        if (edges_.plan_split(cancel)) part_ = Part::split;
        return false;
    case Part::split:
        split_bent();
        part_ = Part::prepare;
        edge_cursor_ = 0;
        ++level_;
        break;
    }
    return refined_ || level_ >= levels;
}

bool DirectTransport::look(const std::atomic<bool>& cancel) {
    const float epsilon = world_.epsilon();
    return run_slice(edge_cursor_, static_cast<std::uint32_t>(edges_.edges().size()), places_a_task, cancel,
                     [&](std::uint32_t first, std::uint32_t last) {
                         for (std::uint32_t e = first; e < last; ++e) {
                             const EdgeRefinement::Edge& edge = edges_.edges()[e];
                             const EdgeRefinement::Place middle = edges_.middle(edge, epsilon);
                             const float length =
                                 glm::distance(mesh_.vertices[edge.a].position, mesh_.vertices[edge.b].position);
                             light(middle.origin, middle.normal, length, Care::looked_at,
                                   edge_factors_.data() + std::size_t(e) * emitters_.size(),
                                   edge_deviations_.data() + std::size_t(e) * emitters_.size());
                         }
                     });
}

} // namespace lueur
