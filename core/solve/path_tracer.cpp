#include "core/solve/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/transport/sampling.h"

namespace lueur {

namespace {

constexpr int first_roulette = 2;
constexpr int most_bounces = 20000; // a hundredth of a second: what is cancelled ends within it

class Random {
public:
    explicit Random(std::uint32_t seed)
        : state_(hash(seed)) {}
    float next() {
        state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
        return unit_float(hash(static_cast<std::uint32_t>(state_ >> 32)));
    }
    glm::vec2 next2() {
        const float a = next();
        return {a, next()};
    }

private:
    std::uint64_t state_;
};

// Density per steradian of choosing the direction by a uniform point of an emitter over that by cosine.
double light_over_cosine(float r2, float cos_emitter, float area, double cos_receiver) {
    return double(r2) / (double(area) * cos_emitter) * std::numbers::pi / cos_receiver;
}

// One sample of the irradiance for unit exitance of an emitter, A cos cos / (pi r^2) * visibility, that was chosen with
// `probability`, weighted against finding it by a cosine-distributed ray.
double light_sample(const World& world, const Emitter& emitter, double probability, glm::vec3 origin, glm::vec3 normal,
                    glm::vec2 u) {
    const EmitterPoint p = emitter_point(emitter, u);
    const glm::vec3 d = p.position - origin;
    const float r2 = glm::dot(d, d), along_receiver = glm::dot(d, normal), along_emitter = -glm::dot(d, p.normal);
    if (!(along_receiver > 0) || !(along_emitter > 0) || !(r2 > 0)) return 0;
    if (world.occluded({origin, d, 0, shadow_ray_end})) return 0;
    const float r = std::sqrt(r2), cos_receiver = along_receiver / r, cos_emitter = along_emitter / r;
    const double ratio = probability * light_over_cosine(r2, cos_emitter, emitter.area, cos_receiver);
    const double kernel = double(emitter.area) * cos_receiver * cos_emitter / (std::numbers::pi * r2);
    return kernel / probability * (ratio / (1 + ratio));
}

} // namespace

PathLights make_path_lights(const Solution::State& s) {
    PathLights lights;
    const auto& emitters = s.direct->emitters();
    for (std::size_t l = 0; l < emitters.size(); ++l) {
        // What nobody sees still has to be found: its watts count a little.
        const double luminous = xyz_from_channels(*s.wavelengths, std::span<const double>(s.luminaire_exitance[l])).y;
        double largest = 0;
        for (const double e : s.luminaire_exitance[l]) largest = std::max(largest, std::abs(e));
        lights.flux.push_back((std::max(luminous, 0.0) + 1e-6 * largest) * emitters[l].area);
        lights.total += lights.flux.back();
    }
    lights.source = s.luminaire_exitance;
    return lights;
}

double trace_path(const Solution::State& s, const PathLights& lights, glm::vec3 origin, glm::vec3 normal,
                  std::uint32_t seed, std::uint32_t batch, std::uint32_t path, std::span<double> irradiance,
                  bool* cut_short) {
    if (!(lights.total > 0)) return 0;
    const World& world = *s.world;
    const auto& emitters = s.direct->emitters();
    const std::size_t channels = irradiance.size(), seen = s.wavelengths->xyz_weight.size();
    const float epsilon = world.epsilon();
    const std::uint32_t sequence = hash(seed, batch);
    Random random(hash(sequence, path));
    double luminous = 0;
    std::array<double, max_channels> throughput;
    std::fill_n(throughput.begin(), channels, 1.0);
    const auto deposit = [&](std::size_t l, double factor) {
        for (std::size_t c = 0; c < channels; ++c) {
            const double e = factor * throughput[c] * lights.source[l][c];
            irradiance[c] += e;
            if (c < seen) luminous += s.wavelengths->xyz_weight[c].y * e;
        }
    };
    // Every luminaire at the point itself: its variance counts most.
    const glm::vec2 offset = random_offset(sequence, 0);
    for (std::size_t l = 0; l < emitters.size(); ++l)
        if (emitters[l].area > 0) {
            const glm::vec2 u = r2_point(path, random_offset(sequence, static_cast<std::uint32_t>(l) + 1));
            const double d = light_sample(world, emitters[l], 1, origin, normal, u);
            if (d > 0) deposit(l, d);
        }
    glm::vec3 p = origin, n = normal;
    glm::vec2 u = r2_point(path, offset);
    for (int bounce = 0;; ++bounce) {
        if (bounce == most_bounces) {
            if (cut_short) *cut_short = true;
            break;
        }
        const glm::vec3 direction = Frame(n).world(cosine_direction(u));
        const Hit hit = world.closest({p, direction});
        if (hit.element == no_index) break;
        const glm::uvec3 corners = s.mesh.nodes[hit.element].vertices;
        const MeshVertex &a = s.mesh.vertices[corners.x], &b = s.mesh.vertices[corners.y],
                         &c = s.mesh.vertices[corners.z];
        const std::uint32_t surface = s.mesh.coarse_surface[hit.element];
        if (const auto l = s.luminaire_of(surface, s.mesh.coarse_back[hit.element] != 0); l && emitters[*l].area > 0) {
            const glm::vec3 flat = glm::normalize(glm::cross(b.position - a.position, c.position - a.position));
            const float cos_emitter = -glm::dot(flat, direction);
            const double probability = bounce == 0 ? 1 : lights.flux[*l] / lights.total;
            if (cos_emitter > 0) {
                const double ratio = probability * light_over_cosine(hit.t * hit.t, cos_emitter, emitters[*l].area,
                                                                     std::max(1e-6f, glm::dot(n, direction)));
                deposit(*l, 1 / (1 + ratio));
            }
        }
        const std::vector<double>& rho = s.material_rho[s.material_of(surface)];
        double largest = 0;
        for (std::size_t k = 0; k < channels; ++k) {
            throughput[k] *= rho[k];
            largest = std::max(largest, throughput[k]);
        }
        if (largest <= 0) break;
        if (bounce >= first_roulette) {
            // Fewer must not survive than are reflected: the weight of those that do would grow from bounce to bounce,
            // and from rho^2 > survival on the variance has no bound.
            const double survive = std::min(1.0, largest);
            if (random.next() >= survive) break;
            for (std::size_t k = 0; k < channels; ++k) throughput[k] /= survive;
        }
        const float b0 = 1 - hit.b1 - hit.b2;
        n = glm::normalize(b0 * a.normal + hit.b1 * b.normal + hit.b2 * c.normal);
        p = b0 * a.position + hit.b1 * b.position + hit.b2 * c.position + epsilon * n;
        double choice = random.next() * lights.total;
        std::size_t l = 0;
        while (l + 1 < lights.flux.size() && choice >= lights.flux[l]) choice -= lights.flux[l++];
        if (lights.flux[l] > 0) {
            const double d = light_sample(world, emitters[l], lights.flux[l] / lights.total, p, n, random.next2());
            if (d > 0) deposit(l, d);
        }
        u = random.next2();
    }
    return luminous;
}

double standard_error_of_batches(std::span<const double> means) {
    const double count = static_cast<double>(means.size());
    double mean = 0, square = 0;
    for (const double m : means) mean += m / count;
    for (const double m : means) square += (m - mean) * (m - mean);
    return count > 1 ? std::sqrt(square / (count * (count - 1))) : 0;
}

PathEstimate trace_irradiance(const Solution::State& s, const PathLights& lights, glm::vec3 origin, glm::vec3 normal,
                              int paths, std::uint32_t seed, const std::atomic<bool>& cancel) {
    PathEstimate result;
    result.channels.assign(static_cast<std::size_t>(s.wavelengths->size()), 0.0);
    const std::uint32_t per_batch = static_cast<std::uint32_t>(std::max(1, paths / path_batches));
    std::array<double, path_batches> means{};
    for (std::uint32_t path = 0; path < per_batch && !cancel.load(std::memory_order_relaxed); ++path)
        for (std::uint32_t batch = 0; batch < path_batches; ++batch)
            means[batch] += trace_path(s, lights, origin, normal, seed, batch, path, result.channels) / per_batch;
    for (double& e : result.channels) e /= double(per_batch) * path_batches;
    for (const double m : means) result.illuminance += m / path_batches;
    result.standard_error = standard_error_of_batches(means);
    return result;
}

} // namespace lueur
