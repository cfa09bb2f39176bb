#include "core/transport/direct_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <span>

#include "core/transport/emitter_visibility.h"
#include "core/transport/polygon_form_factor.h"
#include "core/transport/sampling.h"

namespace lueur {

namespace {

constexpr int shadow_points = 36;               // in a penumbra of many triangles
constexpr int some_points = 16, few_points = 8; // where less is to be known: the first of those
constexpr int probe_points = 6;                 // settle the fully lit and the fully dark
constexpr float far_diameters = 4;              // from here on points replace the exact formula
constexpr std::size_t most_exact_triangles = 64;
constexpr std::size_t few_triangles = 4; // no dearer than the points
constexpr std::size_t most_parts = 16;   // of a luminaire
// Of the visible share when half is seen: an edge cuts about sqrt(n) of n strata, each of which is then in or out by
// chance: sqrt(sqrt(n) / 6) / n.
double penumbra_deviation(double points) {
    return std::sqrt(std::sqrt(points) / 6) / points;
}

double exact_form_factor(const Emitter& emitter, glm::vec3 origin, glm::vec3 normal) {
    double sum = 0;
    for (const EmitterTriangle& t : emitter.triangles) {
        if (glm::dot(origin - t.corners[0], t.normal) <= 0) continue; // behind this triangle
        const std::array<glm::dvec3, 3> polygon{t.corners[0], t.corners[1], t.corners[2]};
        sum += polygon_form_factor(origin, normal, polygon);
    }
    return sum;
}

bool nothing_arrives(const Emitter& emitter, glm::vec3 origin, glm::vec3 normal) {
    return emitter.area <= 0 || glm::dot(emitter.centre - origin, normal) <= -emitter.radius;
}

// Whether the exact formula is worth its time: near, where there are few triangles, or where the points tell little,
// for of a box or a ball few of them face a receiver.
bool is_exact(const Emitter& emitter, glm::vec3 origin) {
    const std::size_t count = emitter.triangles.size();
    if (count <= few_triangles || count > most_exact_triangles) return count <= few_triangles;
    const bool near = glm::length(emitter.centre - origin) < far_diameters * 2 * emitter.radius;
    return near || !emitter.flat;
}

double far_form_factor(const Emitter& emitter, glm::vec3 origin, glm::vec3 normal) {
    double sum = 0;
    for (const EmitterPoint& p : emitter.points) sum += double(emitter_kernel(origin, normal, p));
    return sum * emitter.area / (std::numbers::pi * static_cast<double>(emitter.points.size()));
}

struct PointsSeen {
    int facing = 0, count = 0;   // points that face the receiver, and of those the seen ones
    double all = 0, visible = 0; // the same, of cos cos / r^2
};

PointsSeen look_at(const World& world, std::span<const EmitterPoint> points, glm::vec3 origin, glm::vec3 normal) {
    PointsSeen seen;
    std::array<glm::vec3, World::packet> targets;
    std::array<double, World::packet> kernels;
    std::size_t waiting = 0;
    const auto trace = [&] {
        if (waiting == 0) return;
        const std::uint32_t hidden = world.hidden(origin, std::span(targets).first(waiting));
        for (std::size_t k = 0; k < waiting; ++k)
            if (!(hidden >> k & 1)) seen.count += 1, seen.visible += kernels[k];
        waiting = 0;
    };
    for (const EmitterPoint& p : points) {
        const double kernel = double(emitter_kernel(origin, normal, p));
        if (!(kernel > 0)) continue;
        seen.facing += 1, seen.all += kernel;
        targets[waiting] = p.position, kernels[waiting] = kernel;
        if (++waiting == World::packet) trace();
    }
    trace();
    return seen;
}

// Of each luminaire, in one look at the scene: of hundreds of luminaires, and a million triangles that do not shine.
std::vector<std::vector<EmitterTriangle>> luminaire_triangles(const Scene& scene) {
    std::vector<std::vector<EmitterTriangle>> triangles(scene.luminaires.size());
    const Geometry& geometry = *scene.geometry;
    std::vector<std::vector<std::size_t>> luminaires(scene.objects.size());
    for (std::size_t l = 0; l < triangles.size(); ++l)
        for (const ObjectIndex o : scene.luminaires[l].objects)
            if (auto& of_object = luminaires[at(o)]; of_object.empty() || of_object.back() != l) of_object.push_back(l);
    for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
        const auto& of_object = luminaires[at(geometry.surfaces[at(geometry.triangle_surface[t])].object)];
        if (of_object.empty()) continue;
        const glm::uvec3 v = geometry.triangles[t];
        const glm::vec3 a = geometry.vertices[v.x].position, b = geometry.vertices[v.y].position,
                        c = geometry.vertices[v.z].position;
        const glm::vec3 normal = glm::cross(b - a, c - a);
        const float length = glm::length(normal);
        if (!(length > 0)) continue;
        for (const std::size_t l : of_object) {
            if (scene.luminaires[l].side != EmitSide::back)
                triangles[l].push_back({{a, b, c}, normal / length, length / 2});
            if (scene.luminaires[l].side != EmitSide::front)
                triangles[l].push_back({{a, c, b}, -normal / length, length / 2});
        }
    }
    return triangles;
}

// Greedily the farthest from those chosen, of the stratified points and the corners, first the one farthest from the
// centre: the last that is seen of a lamp in a housing is a corner of it.
void choose_probes(Emitter& emitter) {
    std::vector<EmitterPoint> candidates = emitter.points;
    for (const EmitterTriangle& t : emitter.triangles)
        for (int k = 0; k < 3; ++k) {
            glm::vec3 weights(0);
            weights[k] = 1;
            candidates.push_back({inside_emitter(t, weights), t.normal});
        }
    std::vector<float> distance(candidates.size(), 1e30f);
    glm::vec3 last = emitter.centre;
    for (int k = 0; k < probe_points; ++k) {
        std::size_t best = 0;
        for (std::size_t p = 0; p < candidates.size(); ++p) {
            const glm::vec3 d = candidates[p].position - last;
            distance[p] = k == 1 ? glm::dot(d, d) : std::min(distance[p], glm::dot(d, d));
            if (distance[p] > distance[best]) best = p;
        }
        last = candidates[best].position;
        emitter.probes.push_back(candidates[best]);
    }
}

Emitter make_emitter(std::vector<EmitterTriangle> triangles, std::uint32_t number) {
    Emitter e;
    e.triangles = std::move(triangles);
    if (e.triangles.empty()) return e;
    glm::vec3 low(1e30f), high(-1e30f);
    for (const EmitterTriangle& t : e.triangles) {
        e.area += t.area;
        e.cumulative_area.push_back(e.area);
        e.flat = e.flat && glm::dot(t.normal, e.triangles[0].normal) > 0.999f;
        for (const glm::vec3& c : t.corners) low = glm::min(low, c), high = glm::max(high, c);
    }
    e.centre = 0.5f * (low + high);
    for (const EmitterTriangle& t : e.triangles)
        for (const glm::vec3& c : t.corners) e.radius = std::max(e.radius, glm::length(c - e.centre));
    for (int k = 0; k < shadow_points; ++k)
        e.points.push_back(emitter_point(e, r2_point(static_cast<std::uint32_t>(k), {0, 0})));
    e.one_point = e.points[hash(number) % shadow_points];
    choose_probes(e);
    return e;
}

// Halves, of those along the longest side, until there are few enough.
void halve(std::vector<std::vector<EmitterTriangle>> pieces, std::size_t most,
           std::vector<std::vector<EmitterTriangle>>& out) {
    if (most <= 1 || pieces.size() <= 1) {
        std::vector<EmitterTriangle> one;
        for (const auto& piece : pieces) one.insert(one.end(), piece.begin(), piece.end());
        if (!one.empty()) out.push_back(std::move(one));
        return;
    }
    glm::vec3 low(1e30f), high(-1e30f);
    for (const auto& piece : pieces)
        low = glm::min(low, piece[0].corners[0]), high = glm::max(high, piece[0].corners[0]);
    const glm::vec3 side = high - low;
    const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
    std::ranges::stable_sort(pieces, {}, [&](const auto& piece) { return piece[0].corners[0][axis]; });
    const auto middle = pieces.begin() + static_cast<std::ptrdiff_t>(pieces.size() / 2);
    halve({pieces.begin(), middle}, most / 2, out);
    halve({middle, pieces.end()}, most - most / 2, out);
}

// Triangles that hang together by their corners are one piece; of many small ones neighbours are put together.
std::vector<std::vector<EmitterTriangle>> pieces_apart(std::span<const EmitterTriangle> triangles) {
    std::vector<std::uint32_t> owner(triangles.size());
    std::iota(owner.begin(), owner.end(), 0u);
    const auto root = [&](std::uint32_t t) {
        while (owner[t] != t) t = owner[t] = owner[owner[t]];
        return t;
    };
    std::map<std::array<float, 3>, std::uint32_t> first_at; // a corner
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (const glm::vec3& c : triangles[t].corners) {
            const auto [found, fresh] = first_at.try_emplace({c.x, c.y, c.z}, t);
            const std::uint32_t a = root(found->second), b = root(t);
            owner[std::max(a, b)] = std::min(a, b);
        }
    std::map<std::uint32_t, std::vector<EmitterTriangle>> by_root;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) by_root[root(t)].push_back(triangles[t]);
    std::vector<std::vector<EmitterTriangle>> pieces, few;
    for (auto& [first, piece] : by_root) pieces.push_back(std::move(piece));
    if (pieces.size() <= most_parts) return pieces;
    halve(std::move(pieces), most_parts, few);
    return few;
}

} // namespace

glm::vec3 inside_emitter(const EmitterTriangle& triangle, glm::vec3 weights) {
    constexpr float rim = 0.0067f; // weight
    weights = glm::max(weights, rim);
    weights /= weights.x + weights.y + weights.z;
    return weights.x * triangle.corners[0] + weights.y * triangle.corners[1] + weights.z * triangle.corners[2];
}

float emitter_kernel(glm::vec3 origin, glm::vec3 normal, const EmitterPoint& p) {
    const glm::vec3 d = p.position - origin;
    const float r2 = glm::dot(d, d), cos_receiver = glm::dot(d, normal), cos_emitter = -glm::dot(d, p.normal);
    return cos_receiver > 0 && cos_emitter > 0 && r2 > 0 ? cos_receiver * cos_emitter / (r2 * r2) : 0;
}

bool sees(const World& world, glm::vec3 origin, glm::vec3 target) {
    return !world.occluded({origin, target - origin, 0, shadow_ray_end});
}

EmitterPoint emitter_point(const Emitter& emitter, glm::vec2 u) {
    const float target = u.x * emitter.area;
    const auto found = std::upper_bound(emitter.cumulative_area.begin(), emitter.cumulative_area.end(), target);
    const std::size_t t = std::min<std::size_t>(found - emitter.cumulative_area.begin(), emitter.triangles.size() - 1);
    const EmitterTriangle& triangle = emitter.triangles[t];
    const float before = t == 0 ? 0 : emitter.cumulative_area[t - 1];
    const glm::vec2 b = triangle_point({std::clamp((target - before) / triangle.area, 0.0f, 1.0f), u.y});
    return {triangle.corners[0] + b.x * (triangle.corners[1] - triangle.corners[0]) +
                b.y * (triangle.corners[2] - triangle.corners[0]),
            triangle.normal};
}

std::vector<Emitter> make_emitters(const Scene& scene) {
    std::vector<Emitter> emitters;
    std::uint32_t number = 0;
    for (std::vector<EmitterTriangle>& triangles : luminaire_triangles(scene)) {
        Emitter emitter = make_emitter(std::move(triangles), number++);
        std::vector<std::vector<EmitterTriangle>> pieces = pieces_apart(emitter.triangles);
        if (pieces.size() > 1)
            for (std::vector<EmitterTriangle>& piece : pieces)
                emitter.parts.push_back(make_emitter(std::move(piece), number++));
        emitters.push_back(std::move(emitter));
    }
    return emitters;
}

std::vector<float> guessed_exitances(std::span<const Emitter> emitters) {
    float area = 0, shining = 0;
    for (const Emitter& e : emitters)
        if (e.area > 0) area += e.area, shining += 1;
    std::vector<float> exitances;
    for (const Emitter& e : emitters) exitances.push_back(e.area > 0 ? 1 / e.area + shining / area : 0);
    return exitances;
}

float unshadowed_form_factor(const Emitter& emitter, glm::vec3 origin, glm::vec3 normal) {
    if (nothing_arrives(emitter, origin, normal)) return 0;
    return static_cast<float>(is_exact(emitter, origin) ? exact_form_factor(emitter, origin, normal)
                                                        : far_form_factor(emitter, origin, normal));
}

float direct_form_factor(const World& world, const Emitter& emitter, glm::vec3 origin, glm::vec3 normal,
                         VisibilityDetail detail, std::uint64_t& rays, float* deviation) {
    if (deviation) *deviation = 0;
    if (nothing_arrives(emitter, origin, normal)) return 0;
    if (!emitter.parts.empty()) {
        float sum = 0, variance = 0;
        for (const Emitter& part : emitter.parts) {
            float of_part = 0;
            sum += direct_form_factor(world, part, origin, normal, detail, rays, &of_part);
            variance += of_part * of_part;
        }
        if (deviation) *deviation = std::sqrt(variance);
        return sum;
    }
    const PointsSeen probes = look_at(world, emitter.probes, origin, normal);
    rays += static_cast<std::uint64_t>(probes.facing);
    const bool all_facing = probes.facing == static_cast<int>(emitter.probes.size());
    if (all_facing && probes.count == 0) return 0;

    const bool wholly_seen = all_facing && probes.count == probes.facing;
    const bool exact = is_exact(emitter, origin);
    if (exact && wholly_seen) return static_cast<float>(exact_form_factor(emitter, origin, normal));

    VisibleShare share{1, 0};
    const int points = detail == VisibilityDetail::few_points    ? few_points
                       : detail == VisibilityDetail::some_points ? some_points
                                                                 : shadow_points;
    if (!wholly_seen && points == shadow_points && emitter.triangles.size() <= most_subdivided_triangles) {
        share = visible_share(world, emitter, origin, normal, detail, rays);
    } else if (!wholly_seen) {
        // Not the probes: they lie at the rim, which a lamp's housing hides first.
        const PointsSeen seen = look_at(world, std::span(emitter.points).first(points), origin, normal);
        rays += static_cast<std::uint64_t>(seen.facing);
        if (seen.all > 0) {
            const double visible = seen.visible / seen.all;
            share = {visible, penumbra_deviation(points) * std::sqrt(4 * visible * (1 - visible))};
        } else
            share.share = probes.count > 0 ? 1 : 0;
    }
    const double f = exact ? exact_form_factor(emitter, origin, normal) : far_form_factor(emitter, origin, normal);
    // The points also stand for the formula itself: to 0.5 % at far_diameters for what is flat, of a ball to 5 %.
    const double formula = exact ? 0 : (emitter.flat ? 0.005 : 0.05) * share.share;
    if (deviation) *deviation = static_cast<float>(f * std::hypot(share.deviation, formula));
    return static_cast<float>(f * share.share);
}

float direct_form_factor_sampled(const World& world, const Emitter& emitter, glm::vec3 origin, glm::vec3 normal,
                                 int samples, glm::vec2 offset) {
    if (nothing_arrives(emitter, origin, normal)) return 0;
    double visible = 0, all = 0;
    for (int k = 0; k < samples; ++k) {
        const EmitterPoint p = emitter_point(emitter, r2_point(static_cast<std::uint32_t>(k), offset));
        const float g = emitter_kernel(origin, normal, p);
        if (g <= 0) continue;
        all += g;
        if (sees(world, origin, p.position)) visible += g;
    }
    const bool exact = emitter.triangles.size() <= most_exact_triangles;
    if (exact && all > 0) return static_cast<float>(exact_form_factor(emitter, origin, normal) * visible / all);
    return static_cast<float>(visible * emitter.area / (std::numbers::pi * samples));
}

} // namespace lueur
