#include "core/transport/many_lights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lueur {

namespace {

// Of the light that arrives: what counts for less is looked at less closely, so that each errs by about a hundredth of
// all light where its shadow's edge falls.
constexpr float two_cuts_from = 0.4f, one_cut_from = 0.2f, some_points_from = 0.06f, few_points_from = 0.03f;
// Where a shadow is refined its vertices are small: they must not be less sure of it than their neighbours, or what
// bends is the error and is refined further (specks around the gallery's frames).
constexpr float least_size_share = 0.5f;
constexpr float shadow_share = 0.1f; // of the light there would be without shadows: darker is not told from dark
// One ray decides for all of a luminaire; where its shadow's edge lies is not known, and few receivers are in one.
constexpr float one_ray_deviation = 0.1f;
// However small the receiver is: a speck that is seen is one of a luminaire that counts.
constexpr float one_ray_share = 0.1f;
constexpr float tail_share = 0.05f; // of all light, by the faintest luminaires together
constexpr std::size_t fewest_in_tail = 8, tail_rays = 4;

// What an emitter of some flux would give without any shadow, roughly.
float rough_light(const Emitter& emitter, glm::vec3 origin, glm::vec3 normal) {
    if (emitter.area <= 0) return 0;
    const glm::vec3 d = emitter.centre - origin;
    const float r2 = glm::dot(d, d) + emitter.radius * emitter.radius;
    return std::max(0.0f, glm::dot(d, normal) + emitter.radius) / (r2 * std::sqrt(r2));
}

// A luminaire, or one of its parts.
struct Candidate {
    const Emitter* emitter;
    std::uint32_t luminaire, number;
    float light; // rough_light times exitance
    bool seen = false;
};

VisibilityDetail detail_of(float counts) {
    if (counts > two_cuts_from) return VisibilityDetail::two_cuts;
    if (counts > one_cut_from) return VisibilityDetail::one_cut;
    return counts > some_points_from ? VisibilityDetail::some_points : VisibilityDetail::few_points;
}

// The one point where it faces the receiver; of a ball or a box a point that does, for it hides its own far side.
glm::vec3 facing_point(const Emitter& emitter, glm::vec3 origin, glm::vec3 normal) {
    const EmitterPoint* best = &emitter.one_point;
    float most = emitter_kernel(origin, normal, emitter.one_point);
    if (most <= 0)
        for (const EmitterPoint& p : emitter.probes)
            if (const float kernel = emitter_kernel(origin, normal, p); kernel > most) most = kernel, best = &p;
    return best->position;
}

// Whether one point of each is seen.
void look_at_one_point(const World& world, glm::vec3 origin, glm::vec3 normal, std::span<Candidate> candidates) {
    std::array<glm::vec3, World::packet> targets;
    for (std::size_t first = 0; first < candidates.size(); first += World::packet) {
        const std::span<Candidate> some = candidates.subspan(first, std::min(World::packet, candidates.size() - first));
        for (std::size_t k = 0; k < some.size(); ++k) targets[k] = facing_point(*some[k].emitter, origin, normal);
        const std::uint32_t hidden = world.hidden(origin, std::span(targets).first(some.size()));
        for (std::size_t k = 0; k < some.size(); ++k) some[k].seen = !(hidden >> k & 1);
    }
}

void add(float f, float of_it, const Candidate& c, float* factors, float* deviations) {
    factors[c.luminaire] += f;
    deviations[c.luminaire] = std::hypot(deviations[c.luminaire], of_it);
}

// The faintest: all of them as much in the light as a few drawn by share are.
void light_by_sample(const World& world, glm::vec3 origin, glm::vec3 normal, std::span<Candidate> tail, float* factors,
                     float* deviations) {
    float all = 0, squares = 0;
    for (const Candidate& c : tail) all += c.light, squares += c.light * c.light;
    std::array<Candidate, tail_rays> drawn{};
    float before = 0;
    std::size_t next = 0;
    for (const Candidate& c : tail) {
        before += c.light;
        while (next < tail_rays && before > all * (float(next) + 0.5f) / tail_rays) drawn[next++] = c;
    }
    while (next < tail_rays) drawn[next++] = tail.back();
    look_at_one_point(world, origin, normal, drawn);
    const auto seen = static_cast<float>(std::ranges::count(drawn, true, &Candidate::seen));
    const float share = seen / tail_rays, believed = (seen + 1) / (tail_rays + 2);
    // Variance of the sum of all of them, shared among them as if each erred by itself.
    const float deviation = std::sqrt(all * all / squares * believed * (1 - believed) / tail_rays);
    for (const Candidate& c : tail) {
        const float f = unshadowed_form_factor(*c.emitter, origin, normal);
        add(f * share, f * deviation, c, factors, deviations);
    }
}

// Those that shine here, were there no shadows, the brightest first. Their light together.
float list_candidates(std::span<const Emitter> emitters, std::span<const float> exitances, glm::vec3 origin,
                      glm::vec3 normal, std::vector<Candidate>& candidates) {
    candidates.clear();
    float all = 0;
    for (std::uint32_t l = 0; l < emitters.size(); ++l) {
        const std::span<const Emitter> parts =
            emitters[l].parts.empty() ? emitters.subspan(l, 1) : std::span(emitters[l].parts);
        for (const Emitter& part : parts)
            if (const float light = exitances[l] * part.area * rough_light(part, origin, normal); light > 0) {
                candidates.push_back({&part, l, static_cast<std::uint32_t>(candidates.size()), light});
                all += light;
            }
    }
    std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
        return a.light != b.light ? a.light > b.light : a.number < b.number;
    });
    return all;
}

} // namespace

std::uint64_t direct_form_factors(const World& world, std::span<const Emitter> emitters,
                                  std::span<const float> exitances, glm::vec3 origin, glm::vec3 normal,
                                  float size_share, float* factors, float* deviations) {
    std::fill_n(factors, emitters.size(), 0.0f);
    std::fill_n(deviations, emitters.size(), 0.0f);
    thread_local std::vector<Candidate> candidates;
    const float all = list_candidates(emitters, exitances, origin, normal, candidates);
    if (candidates.empty()) return 0;
    std::uint64_t rays = 0;
    std::span<Candidate> shining(candidates);
    float visible = all;
    if (candidates.size() > 1) { // of a single one the probes say all there is to say
        float tail = 0;
        std::size_t end = candidates.size();
        while (end > 0 && tail + candidates[end - 1].light <= tail_share * all) tail += candidates[--end].light;
        if (candidates.size() - end >= fewest_in_tail) {
            light_by_sample(world, origin, normal, shining.subspan(end), factors, deviations);
            rays += tail_rays;
            shining = shining.first(end);
        }
        look_at_one_point(world, origin, normal, shining);
        rays += shining.size();
        visible = shadow_share * all;
        for (const Candidate& c : shining) visible += c.seen ? c.light : 0;
    }
    for (const Candidate& c : shining) {
        const float counts = std::max(size_share, least_size_share) * c.light / visible;
        float f = 0, deviation = 0;
        if (counts < few_points_from && c.light < one_ray_share * visible && candidates.size() > 1) {
            f = c.seen ? unshadowed_form_factor(*c.emitter, origin, normal) : 0;
            deviation = one_ray_deviation * f;
        } else
            f = direct_form_factor(world, *c.emitter, origin, normal, detail_of(counts), rays, &deviation);
        add(f, deviation, c, factors, deviations);
    }
    return rays;
}

} // namespace lueur
