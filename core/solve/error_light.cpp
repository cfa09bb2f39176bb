#include "core/solve/error_light.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lueur {

namespace {

// Direct light is in what is shown, apart or through form factors; only shooting leaves out luminaires that have not
// shot yet.
bool is_shown(const Solution::State& s, std::size_t luminaire) {
    return s.solver() != SolverKind::shooting || s.luminaire_is_lit(luminaire);
}

} // namespace

ErrorLight error_light(const Solution::State& s, const ErrorMesh& mesh, const Field& field) {
    ErrorLight light;
    const std::size_t count = field.irradiance_xyz.size(), emitters = s.direct->emitter_count();
    std::vector<double> hidden; // of the luminaires that are not shown
    for (std::size_t l = 0; l < emitters; ++l) {
        const double y = xyz_from_channels(*s.wavelengths, std::span<const double>(s.luminaire_exitance[l])).y;
        light.exitance.push_back(is_shown(s, l) ? y : 0);
        hidden.push_back(y - light.exitance.back());
    }
    for (std::vector<float>* part :
         {&light.total, &light.direct, &light.indirect, &light.reflected, &light.direct_variance, &light.unlit})
        part->resize(count);
    // Direct light, its variance and what is not shown of it: three numbers a row.
    std::vector<float> at_rows(3 * std::size_t(s.direct->row_count())), read(3 * count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, s.direct->row_count(), 256), [&](const auto& range) {
        for (std::size_t r = range.begin(); r < range.end(); ++r) {
            double direct = 0, variance = 0, unlit = 0;
            for (const DirectShare& share : s.direct->rows()[r]) {
                direct += share.factor * light.exitance[share.emitter];
                const double deviation = share.deviation * light.exitance[share.emitter];
                variance += deviation * deviation;
                unlit += share.factor * hidden[share.emitter];
            }
            at_rows[3 * r] = static_cast<float>(direct);
            at_rows[3 * r + 1] = static_cast<float>(variance);
            at_rows[3 * r + 2] = static_cast<float>(unlit);
        }
    });
    s.direct->read_rows(at_rows, 3, read);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t v = range.begin(); v < range.end(); ++v) {
                              const float y = field.irradiance_xyz[v].y;
                              light.total[v] = y;
                              light.direct[v] = read[3 * v];
                              light.indirect[v] = y - light.direct[v];
                              light.reflected[v] = field.reflected_xyz[v].y * std::numbers::pi_v<float>;
                              light.direct_variance[v] = read[3 * v + 1];
                              light.unlit[v] = read[3 * v + 2];
                          }
                      });
    double caught = 0, emitted = 0;
    for (std::size_t v = 0; v < count; ++v) {
        if (mesh.buried[v]) continue;
        light.mean += double(mesh.area[v]) * light.total[v];
        light.mean_indirect += double(mesh.area[v]) * light.indirect[v];
        caught += double(mesh.area[v]) * light.direct[v];
    }
    for (std::size_t l = 0; l < emitters; ++l) emitted += light.exitance[l] * s.direct->emitters()[l].area;
    if (emitted > 0) light.caught = std::clamp(caught / emitted, 0.0, 1.0);
    if (mesh.seen_area > 0) light.mean /= mesh.seen_area, light.mean_indirect /= mesh.seen_area;
    return light;
}

double usual_light(const ErrorLight& light, const ErrorMesh& mesh, std::uint32_t vertices) {
    constexpr double brightest = 0.02;
    constexpr std::uint32_t enough = 4000; // vertices, for a mean
    vertices = std::min(vertices, static_cast<std::uint32_t>(light.total.size()));
    std::vector<std::uint32_t> order;
    double area = 0, sum = 0, counted = 0;
    for (std::uint32_t v = 0; v < vertices; v += 1 + vertices / enough)
        if (!mesh.buried[v]) order.push_back(v), area += mesh.area[v];
    std::ranges::sort(order, {}, [&](std::uint32_t v) { return std::pair(light.total[v], v); });
    for (const std::uint32_t v : order)
        if (counted < (1 - brightest) * area) sum += double(mesh.area[v]) * light.total[v], counted += mesh.area[v];
    return sum > 0 ? sum / counted : light.mean;
}

} // namespace lueur
