#include "core/solve/error_probes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/transport/direct_light.h"
#include "core/transport/sampling.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

// How uncertain direct light is at each vertex, all luminaires of one flux, relative to the mean light.
std::vector<float> direct_uncertainty(const Mesh& mesh, const DirectTransport& direct) {
    std::vector<float> uncertainty(mesh.vertices.size(), 0);
    double mean = 0;
    std::vector<float> at_rows(direct.row_count(), 0);
    for (std::size_t r = 0; r < at_rows.size(); ++r)
        for (const DirectShare& share : direct.rows()[r])
            if (const float area = direct.emitters()[share.emitter].area; area > 0)
                at_rows[r] += share.deviation / area;
    direct.read_rows(at_rows, 1, uncertainty);
    for (const float light : direct.guessed_light()) mean += double(light);
    mean /= std::max<double>(1, double(uncertainty.size()));
    for (float& u : uncertainty) u = mean > 0 ? static_cast<float>(u / mean) : 0;
    return uncertainty;
}

// One of three by weight, among those not buried.
std::uint32_t pick(const Located& at, const std::vector<std::uint8_t>& buried, float u) {
    float sum = 0;
    glm::vec3 w = at.weights;
    for (int k = 0; k < 3; ++k) sum += w[k] = buried[at.vertices[k]] ? 0 : std::max(0.0f, w[k]);
    if (!(sum > 0)) return no_index;
    u *= sum;
    for (int k = 0; k < 2; ++k) {
        if (u < w[k]) return at.vertices[k];
        u -= w[k];
    }
    return w[2] > 0 ? at.vertices[2] : (w[1] > 0 ? at.vertices[1] : at.vertices[0]);
}

constexpr int rays_of_set = ErrorProbes::rays / ErrorProbes::sets,
              shadow_rays_of_set = ErrorProbes::shadow_rays / ErrorProbes::sets;

// What a direction towards a luminaire counts, of both sets of rays together. Irradiance for unit exitance is the
// integral of cos / pi, which rays by the cosine law have as their density; those to points of an area A have
// r^2 / (A cos'). square: r^2; cosines: at the receiver and at the luminaire.
double count_of_hit(double square, double cos_receiver, double cos_emitter, double area) {
    const double by_cosine = rays_of_set * cos_receiver / std::numbers::pi,
                 by_area = shadow_rays_of_set * square / (area * cos_emitter);
    return cos_receiver / std::numbers::pi / (by_cosine + by_area);
}

// D by points of the luminaire, which hemisphere rays add to.
double direct_of_points(const World& world, const Emitter& emitter, glm::vec3 origin, glm::vec3 normal,
                        glm::vec2 offset) {
    if (!(emitter.area > 0) || glm::dot(emitter.centre - origin, normal) <= -emitter.radius) return 0;
    double sum = 0;
    for (std::uint32_t k = 0; k < shadow_rays_of_set; ++k) {
        const EmitterPoint p = emitter_point(emitter, r2_point(k, offset));
        if (emitter_kernel(origin, normal, p) <= 0 || !sees(world, origin, p.position)) continue;
        const glm::dvec3 d = p.position - origin;
        const double square = glm::dot(d, d), r = std::sqrt(square);
        sum += count_of_hit(square, glm::dot(d, glm::dvec3(normal)) / r, -glm::dot(d, glm::dvec3(p.normal)) / r,
                            emitter.area);
    }
    return sum;
}

} // namespace

void place_probes(const World& world, const Mesh& mesh, const DirectTransport& direct,
                  const std::vector<std::uint8_t>& buried, std::vector<std::uint32_t> luminaire_of_element,
                  std::uint32_t count, std::uint32_t seed, ErrorProbes& probes) {
    probes = {};
    probes.luminaire_of_element = std::move(luminaire_of_element);
    const std::vector<float> uncertainty = direct_uncertainty(mesh, direct);
    const std::vector<glm::vec3> origins = ray_origins(mesh, world.epsilon());
    // Elements by area, more of it where direct light is uncertain, and more where elements are small: reveals, slats
    // and books err most, and one probe that stood for two square metres of them would decide the figure of a room.
    std::vector<double> area, density(mesh.elements.size(), 0);
    double all = 0, uncertain = 0, small = 0;
    for (const glm::uvec3& e : mesh.elements) {
        const glm::vec3 a = mesh.vertices[e.x].position;
        area.push_back(
            0.5 * double(glm::length(glm::cross(mesh.vertices[e.y].position - a, mesh.vertices[e.z].position - a))));
        all += area.back();
        small += std::sqrt(area.back());
        uncertain += area.back() * double(uncertainty[e.x] + uncertainty[e.y] + uncertainty[e.z]);
    }
    if (!(all > 0)) return;
    double sum = 0;
    std::vector<double> until;
    for (std::size_t e = 0; e < density.size(); ++e) {
        const glm::uvec3& v = mesh.elements[e];
        density[e] = 0.4 / all;
        if (uncertain > 0)
            density[e] += 0.3 * double(uncertainty[v.x] + uncertainty[v.y] + uncertainty[v.z]) / uncertain;
        if (area[e] > 0) density[e] += 0.3 * std::sqrt(area[e]) / small / area[e];
        until.push_back(sum += area[e] * density[e]);
    }
    // Systematic sampling: as well spread over the list of elements, which is spread over the scene, as can be.
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t bits = hash(seed, k);
        const double at = sum * (k + double(unit_float(bits))) / count;
        const std::size_t e =
            std::min<std::size_t>(std::upper_bound(until.begin(), until.end(), at) - until.begin(), until.size() - 1);
        const glm::uvec3 v = mesh.elements[e];
        const std::uint32_t more = hash(bits);
        ErrorProbes::Point p{};
        p.area = static_cast<float>(1 / (density[e] * count));
        p.between = k % 2 == 1;
        p.reach = 2 * std::sqrt(2 * mesh.coarse_area[mesh.element_coarse[e]]);
        if (p.between) {
            const glm::vec2 b = triangle_point({unit_float(more), unit_float(hash(more))});
            p.vertices = v;
            p.weights = {1 - b.x - b.y, b.x, b.y};
            const glm::vec3 at_point = p.weights.x * mesh.vertices[v.x].position +
                                       p.weights.y * mesh.vertices[v.y].position +
                                       p.weights.z * mesh.vertices[v.z].position;
            const glm::vec3 n = p.weights.x * mesh.vertices[v.x].normal + p.weights.y * mesh.vertices[v.y].normal +
                                p.weights.z * mesh.vertices[v.z].normal;
            p.normal = glm::dot(n, n) > 0 ? glm::normalize(n) : mesh.vertices[v.x].normal;
            const glm::vec3 centre =
                (mesh.vertices[v.x].position + mesh.vertices[v.y].position + mesh.vertices[v.z].position) / 3.0f;
            p.origin = ray_origin(at_point, p.normal, centre, world.epsilon());
        } else {
            const std::uint32_t vertex = v[static_cast<int>(more % 3)];
            p.vertices = glm::uvec3(vertex);
            p.weights = {1, 0, 0};
            p.normal = mesh.vertices[vertex].normal;
            p.origin = origins[vertex];
        }
        // Inside a solid nobody looks, and the field there is made up.
        if (p.between ? world.closest({p.origin, p.normal}).back_face || buried[v.x] + buried[v.y] + buried[v.z] == 3
                      : buried[p.vertices.x] != 0)
            continue;
        probes.points.push_back(p);
    }
    probes.direct.assign(probes.points.size() * ErrorProbes::sets * direct.emitter_count(), 0);
    probes.ends.assign(probes.points.size() * ErrorProbes::rays, no_index);
}

bool trace_probes(const World& world, const Mesh& mesh, const DirectTransport& direct,
                  const std::vector<std::uint8_t>& buried, std::uint32_t seed, const std::atomic<bool>& cancel,
                  ErrorProbes& probes) {
    const std::size_t emitters = direct.emitter_count();
    return run_slice(
        probes.cursor, static_cast<std::uint32_t>(probes.points.size()), 1, cancel,
        [&](std::uint32_t first, std::uint32_t last) {
            for (std::uint32_t i = first; i < last; ++i) {
                ErrorProbes::Point& p = probes.points[i];
                std::uint32_t near = 0;
                const Frame frame(p.normal);
                for (std::uint32_t set = 0; set < ErrorProbes::sets; ++set) {
                    const std::uint32_t key = hash(hash(seed, 0x9e0b0000u + set), i);
                    float* d = probes.direct.data() + (std::size_t(i) * ErrorProbes::sets + set) * emitters;
                    for (std::size_t l = 0; l < emitters; ++l)
                        d[l] =
                            static_cast<float>(direct_of_points(world, direct.emitters()[l], p.origin, p.normal,
                                                                random_offset(key, static_cast<std::uint32_t>(l) + 1)));
                    const glm::vec2 offset = random_offset(key, 0);
                    for (std::uint32_t k = 0; k < rays_of_set; ++k) {
                        const glm::vec3 way = frame.world(cosine_direction(r2_point(k, offset)));
                        const Hit hit = world.closest({p.origin, way});
                        if (hit.element == no_index) continue;
                        near += hit.t < p.reach;
                        if (const std::uint32_t l = probes.luminaire_of_element[hit.element]; l != no_index) {
                            const glm::uvec3& v = mesh.nodes[hit.element].vertices;
                            const glm::vec3 n =
                                glm::normalize(glm::cross(mesh.vertices[v.y].position - mesh.vertices[v.x].position,
                                                          mesh.vertices[v.z].position - mesh.vertices[v.x].position));
                            const double cos_receiver = glm::dot(way, p.normal), cos_emitter = -glm::dot(way, n);
                            if (cos_receiver > 0 && cos_emitter > 0)
                                d[l] += static_cast<float>(count_of_hit(double(hit.t) * hit.t, cos_receiver,
                                                                        cos_emitter, direct.emitters()[l].area));
                        }
                        const std::uint32_t end =
                            pick(locate(mesh, hit.element, hit.b1, hit.b2), buried, unit_float(hash(key, k)));
                        if (end != no_index)
                            probes.ends[std::size_t(i) * ErrorProbes::rays + set * rays_of_set + k] = end;
                    }
                }
                p.near = static_cast<float>(near) / ErrorProbes::rays;
            }
        });
}

} // namespace lueur
