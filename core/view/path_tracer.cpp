#include "core/view/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/transport/sampling.h"

namespace lueur {

namespace {

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

// One sample of the direct irradiance for unit exitance of an emitter: A cos cos / (pi r^2) * visibility.
float direct_sample(const World& world, const Emitter& emitter, glm::vec3 origin, glm::vec3 normal, glm::vec2 u) {
    const EmitterPoint p = emitter_point(emitter, u);
    const glm::vec3 d = p.position - origin;
    const float r2 = glm::dot(d, d), cos_receiver = glm::dot(d, normal), cos_emitter = -glm::dot(d, p.normal);
    if (!(cos_receiver > 0) || !(cos_emitter > 0) || !(r2 > 0)) return 0;
    if (world.occluded({origin, d, 0, 1 - 1e-4f})) return 0;
    return emitter.area * cos_receiver * cos_emitter / (std::numbers::pi_v<float> * r2 * r2);
}

} // namespace

std::vector<double> trace_irradiance(const Solution::State& s, glm::vec3 origin, glm::vec3 normal, int paths,
                                     std::uint32_t seed, const std::atomic<bool>& cancel,
                                     std::span<double, 8> luminous_batches) {
    const World& world = *s.world;
    const auto& emitters = s.direct->emitters();
    const int channels = s.wavelengths->size();
    const float epsilon = world.epsilon();
    std::vector<double> irradiance(channels, 0);
    std::fill(luminous_batches.begin(), luminous_batches.end(), 0.0);
    std::array<int, 8> batch_paths{};

    // Luminaires are chosen by luminous flux.
    std::vector<double> flux, luminous_exitance;
    double total = 0;
    for (std::size_t l = 0; l < emitters.size(); ++l) {
        luminous_exitance.push_back(xyz_from_channels(*s.wavelengths, s.luminaire_exitance[l]).y);
        flux.push_back(luminous_exitance.back() * emitters[l].area);
        total += flux.back();
    }
    if (!(total > 0)) return irradiance;

    Random random(seed);
    const glm::vec2 offset = random.next2();
    std::vector<double> throughput(channels);
    for (int path = 0; path < paths && !cancel.load(std::memory_order_relaxed); ++path) {
        const int batch = path % 8;
        ++batch_paths[batch];
        const auto deposit = [&](std::size_t l, double factor) {
            double y = 0;
            for (int c = 0; c < channels; ++c) {
                const double e = factor * throughput[c] * s.luminaire_exitance[l][c];
                irradiance[c] += e;
                y += s.wavelengths->xyz_weight[c].y * e;
            }
            luminous_batches[batch] += y;
        };
        std::fill(throughput.begin(), throughput.end(), 1.0);
        for (std::size_t l = 0; l < emitters.size();
             ++l) // every luminaire at the point itself: its variance counts most
            if (emitters[l].area > 0) {
                const float d = direct_sample(
                    world, emitters[l], origin, normal,
                    r2_point(static_cast<std::uint32_t>(path), offset + random_offset(seed, std::uint32_t(l))));
                if (d > 0) deposit(l, d);
            }
        glm::vec3 p = origin, n = normal;
        glm::vec2 u = r2_point(static_cast<std::uint32_t>(path), offset);
        for (int bounce = 0; bounce < 1000; ++bounce) {
            const Hit hit = world.closest({p, Frame(n).world(cosine_direction(u))});
            if (hit.element == no_index) break;
            const std::vector<double>& rho = s.material_rho[s.material_of(s.mesh.coarse_surface[hit.element])];
            double largest = 0;
            for (int c = 0; c < channels; ++c) {
                throughput[c] *= rho[c];
                largest = std::max(largest, throughput[c]);
            }
            if (largest <= 0) break;
            if (bounce >= 2) {
                const double survive = std::min(0.95, largest);
                if (random.next() >= survive) break;
                for (double& t : throughput) t /= survive;
            }
            const MeshVertex &a = s.mesh.vertices[s.mesh.nodes[hit.element].vertices.x],
                             &b = s.mesh.vertices[s.mesh.nodes[hit.element].vertices.y],
                             &c = s.mesh.vertices[s.mesh.nodes[hit.element].vertices.z];
            const float b0 = 1 - hit.b1 - hit.b2;
            n = glm::normalize(b0 * a.normal + hit.b1 * b.normal + hit.b2 * c.normal);
            p = b0 * a.position + hit.b1 * b.position + hit.b2 * c.position + epsilon * n;
            double choice = random.next() * total;
            std::size_t l = 0;
            while (l + 1 < flux.size() && choice >= flux[l]) choice -= flux[l++];
            const float d = flux[l] > 0 ? direct_sample(world, emitters[l], p, n, random.next2()) : 0;
            if (d > 0) deposit(l, d * total / flux[l]);
            u = random.next2();
        }
    }
    for (double& e : irradiance) e /= std::max(1, paths);
    for (int k = 0; k < 8; ++k) luminous_batches[k] /= std::max(1, batch_paths[k]);
    return irradiance;
}

} // namespace lueur
