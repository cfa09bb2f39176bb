// Form factors by item buffers at points of the patch: hemicube and hemisphere, for a pair.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/transport/form_factor_methods.h"
#include "core/transport/hemicube.h"
#include "core/transport/hemisphere.h"

namespace lueur {

namespace {

// Item buffers at spread points of the patch, each turned differently, so that their aliasing is independent: the
// spread of their values is that of the points and of the pixels together.
struct Placement {
    glm::dvec3 eye;
    double turn;
};
Placement placement(const PlanarPolygon& polygon, int k, int count, std::uint64_t seed) {
    if (count == 1) return {centre(polygon), 0}; // the lecture's
    RandomStream shared(seed, 0), own(seed, static_cast<std::uint64_t>(k) + 1);
    return {polygon_point(polygon, spread_point(static_cast<std::uint64_t>(k), shared.next2())),
            2 * std::numbers::pi * own.next()};
}

// `pixel`: the largest form factor of one; what no buffer has seen may still be that large.
MethodEstimate mean_of(const std::vector<double>& values, double pixel, std::uint64_t cost) {
    const auto n = static_cast<double>(values.size());
    double sum = 0, squares = 0;
    for (const double value : values) sum += value;
    const double mean = sum / n;
    for (const double value : values) squares += (value - mean) * (value - mean);
    if (values.size() < 2) return {mean, -1, cost};
    return {mean, std::sqrt(squares / (n * (n - 1)) + pixel * pixel / n), cost};
}

// Distance along a ray at which it goes through a polygon; 0: it does not.
double ray_distance(const PlanarPolygon& polygon, glm::dvec3 origin, glm::dvec3 direction) {
    const double across = glm::dot(polygon.normal, direction),
                 away = glm::dot(polygon.normal, polygon.corners[0] - origin);
    if (!(away * across > 0)) return 0;
    const std::size_t n = polygon.corners.size();
    const double side = away > 0 ? 1 : -1;
    for (std::size_t k = 0; k < n; ++k) {
        const glm::dvec3 plane =
            glm::cross(polygon.corners[k] - origin, polygon.corners[(k + 1) % n] - polygon.corners[k]);
        if (side * glm::dot(plane, direction) < 0) return 0;
    }
    return away / across;
}

} // namespace

MethodEstimate hemicube(const PolygonPair& pair, const FormFactorSettings& settings) {
    Hemicube cube(settings.resolution);
    std::vector<double> values;
    std::uint64_t cost = 0;
    for (int k = 0; k < settings.samples; ++k) {
        const Placement at = placement(pair.from, k, settings.samples, settings.seed);
        cube.place(at.eye, pair.from.normal, at.turn);
        cube.draw(pair.to.corners, pair.to.normal, 0);
        for (const PlanarPolygon& occluder : pair.occluders.polygons) cube.draw(occluder.corners, occluder.normal, 1);
        double sum = 0;
        for (std::size_t pixel = 0; pixel < cube.size(); ++pixel) {
            if (cube.item(pixel) != 0) continue;
            if (pair.occluders.world) { // nothing of it is drawn: a ray through each pixel that shows the patch
                const glm::dvec3 direction = cube.direction(pixel);
                const double t = ray_distance(pair.to, at.eye, direction);
                if (t > 0 && !is_visible(pair, at.eye, at.eye + t * direction)) continue;
            }
            sum += cube.delta(pixel);
        }
        cost += cube.size();
        values.push_back(sum);
    }
    const double step = 2.0 / settings.resolution;
    return mean_of(values, step * step / std::numbers::pi, cost);
}

MethodEstimate hemisphere(const PolygonPair& pair, const FormFactorSettings& settings) {
    std::vector<double> values;
    std::uint64_t cost = 0;
    double largest = 0;
    for (int k = 0; k < settings.samples; ++k) {
        const Placement at = placement(pair.from, k, settings.samples, settings.seed);
        const Axes axes(pair.from.normal, at.turn);
        RandomStream random(settings.seed, static_cast<std::uint64_t>(k) + 0x10000);
        const HemisphereRays rays(settings.resolution, settings.cells, random.next2());
        double sum = 0;
        for (std::uint32_t n = 0; n < rays.count(); ++n) {
            const HemisphereRay ray = rays.ray(n);
            largest = std::max(largest, ray.delta);
            const glm::dvec3 direction = ray.direction.x * axes.x + ray.direction.y * axes.y + ray.direction.z * axes.z;
            const double t = ray_distance(pair.to, at.eye, direction);
            if (t > 0 && is_visible(pair, at.eye, at.eye + t * direction)) sum += ray.delta;
        }
        cost += rays.count();
        values.push_back(sum);
    }
    return mean_of(values, largest, cost);
}

} // namespace lueur
