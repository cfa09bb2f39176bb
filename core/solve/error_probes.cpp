#include "core/solve/error_probes.h"

#include <algorithm>
#include <array>
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

constexpr int shadow_rays_of_set = ErrorProbes::shadow_rays / ErrorProbes::sets;

// What a direction towards a luminaire counts, of both sets of rays together. Irradiance for unit exitance is the
// integral of cos / pi, which rays by the cosine law have as their density; those to points of an area A have
// r^2 / (A cos'). rays: of a set by the cosine law; square: r^2; cosines: at the receiver and at the luminaire.
double count_of_hit(std::size_t rays, double square, double cos_receiver, double cos_emitter, double area) {
    const double by_cosine = double(rays) * cos_receiver / std::numbers::pi,
                 by_area = shadow_rays_of_set * square / (area * cos_emitter);
    return cos_receiver / std::numbers::pi / (by_cosine + by_area);
}

// D by points of the luminaire, which hemisphere rays add to.
double direct_of_points(const World& world, const Emitter& emitter, const ErrorProbes::Point& p,
                        std::size_t rays_of_set, glm::vec2 offset) {
    if (!(emitter.area > 0) || glm::dot(emitter.centre - p.origin, p.normal) <= -emitter.radius) return 0;
    std::array<glm::vec3, World::packet> targets;
    std::array<double, World::packet> counts;
    std::size_t waiting = 0;
    double sum = 0;
    const auto look = [&] {
        const std::uint32_t hidden = world.hidden(p.origin, {targets.data(), waiting});
        for (std::size_t k = 0; k < waiting; ++k)
            if (!(hidden >> k & 1)) sum += counts[k];
        waiting = 0;
    };
    for (std::uint32_t k = 0; k < shadow_rays_of_set; ++k) {
        const EmitterPoint point = emitter_point(emitter, r2_point(k, offset));
        if (emitter_kernel(p.origin, p.normal, point) <= 0) continue;
        const glm::dvec3 d = point.position - p.origin;
        const double square = glm::dot(d, d), r = std::sqrt(square);
        targets[waiting] = point.position;
        counts[waiting++] = count_of_hit(rays_of_set, square, glm::dot(d, glm::dvec3(p.normal)) / r,
                                         -glm::dot(d, glm::dvec3(point.normal)) / r, emitter.area);
        if (waiting == World::packet) look();
    }
    if (waiting > 0) look();
    return sum;
}

// What hemisphere rays that met luminaires add to their D.
void add_luminaires_met(const Mesh& mesh, const std::vector<Emitter>& emitters,
                        const std::vector<std::uint32_t>& luminaire_of_element, glm::vec3 normal,
                        const std::vector<glm::vec3>& directions, const std::vector<Hit>& hits, float* direct) {
    for (std::size_t k = 0; k < hits.size(); ++k) {
        const Hit& hit = hits[k];
        const std::uint32_t l = hit.element == no_index ? no_index : luminaire_of_element[hit.element];
        if (l == no_index) continue;
        const glm::uvec3& v = mesh.nodes[hit.element].vertices;
        const glm::vec3 n = glm::normalize(glm::cross(mesh.vertices[v.y].position - mesh.vertices[v.x].position,
                                                      mesh.vertices[v.z].position - mesh.vertices[v.x].position));
        const double cos_receiver = glm::dot(directions[k], normal), cos_emitter = -glm::dot(directions[k], n);
        if (cos_receiver > 0 && cos_emitter > 0)
            direct[l] += static_cast<float>(
                count_of_hit(hits.size(), double(hit.t) * hit.t, cos_receiver, cos_emitter, emitters[l].area));
    }
}

} // namespace

void place_probes(const World& world, const Mesh& mesh, const DirectTransport& direct,
                  const std::vector<std::uint8_t>& buried, std::vector<std::uint32_t> luminaire_of_element,
                  std::uint32_t count, int rays, std::uint32_t seed, ErrorProbes& probes) {
    probes = {};
    probes.rays = rays;
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
    probes.ends.assign(probes.points.size() * static_cast<std::size_t>(rays), no_index);
}

bool trace_probes(const World& world, const Mesh& mesh, const DirectTransport& direct,
                  const std::vector<std::uint8_t>& buried, std::uint32_t seed, const std::atomic<bool>& cancel,
                  ErrorProbes& probes) {
    const std::vector<Emitter>& emitters = direct.emitters();
    const auto rays_of_set = static_cast<std::uint32_t>(probes.rays / ErrorProbes::sets);
    const auto trace = [&](std::uint32_t i) {
        ErrorProbes::Point& p = probes.points[i];
        const Frame frame(p.normal);
        std::vector<glm::vec3> directions(rays_of_set);
        std::vector<Hit> hits(rays_of_set);
        std::ptrdiff_t near = 0;
        for (std::uint32_t set = 0; set < ErrorProbes::sets; ++set) {
            const std::uint32_t key = hash(hash(seed, 0x9e0b0000u + set), i);
            const std::size_t row = std::size_t(i) * ErrorProbes::sets + set;
            float* d = probes.direct.data() + row * emitters.size();
            for (std::uint32_t l = 0; l < emitters.size(); ++l)
                d[l] =
                    static_cast<float>(direct_of_points(world, emitters[l], p, rays_of_set, random_offset(key, l + 1)));
            const glm::vec2 offset = random_offset(key, 0);
            for (std::uint32_t k = 0; k < rays_of_set; ++k)
                directions[k] = frame.world(cosine_direction(r2_point(k, offset)));
            world.closest(p.origin, directions, hits);
            add_luminaires_met(mesh, emitters, probes.luminaire_of_element, p.normal, directions, hits, d);
            near += std::ranges::count_if(hits, [&](const Hit& h) { return h.element != no_index && h.t < p.reach; });
            for (std::uint32_t k = 0; k < rays_of_set; ++k)
                if (const Hit& hit = hits[k]; hit.element != no_index)
                    probes.ends[row * rays_of_set + k] =
                        pick(locate(mesh, hit.element, hit.b1, hit.b2), buried, unit_float(hash(key, k)));
        }
        p.near = static_cast<float>(near) / static_cast<float>(probes.rays);
    };
    return run_slice(probes.cursor, static_cast<std::uint32_t>(probes.points.size()), 1, cancel,
                     [&](std::uint32_t first, std::uint32_t last) {
                         for (std::uint32_t i = first; i < last; ++i) trace(i);
                     });
}

} // namespace lueur
