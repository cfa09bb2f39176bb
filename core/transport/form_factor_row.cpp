// Rows of form factors from one patch of a scene to all.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "core/transport/form_factor_methods.h"
#include "core/transport/hemicube.h"
#include "core/transport/hemisphere.h"

namespace lueur {

namespace {

PlanarPolygon triangle(const Mesh& mesh, glm::uvec3 v) {
    std::vector<glm::dvec3> corners{glm::dvec3(mesh.vertices[v.x].position), glm::dvec3(mesh.vertices[v.y].position),
                                    glm::dvec3(mesh.vertices[v.z].position)};
    const glm::dvec3 vector = 0.5 * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double area = glm::length(vector);
    // A degenerate one gets no area and takes no part.
    return {std::move(corners), area > 0 ? vector / area : glm::dvec3(0, 0, 1), area};
}

struct Eye {
    glm::dvec3 at;
    double turn;
};
// Spread over the patch, each turned differently; one alone stands in the middle.
Eye eye_of(const PlanarPolygon& patch, std::uint32_t i, int k, const FormFactorSettings& settings) {
    RandomStream of_patch(settings.seed, i),
        own(settings.seed + 1, (std::uint64_t(i) << 20) + static_cast<unsigned>(k));
    const double turn = 2 * std::numbers::pi * own.next();
    if (settings.samples == 1) return {centre(patch), turn};
    return {polygon_point(patch, spread_point(static_cast<std::uint64_t>(k), of_patch.next2())), turn};
}

void hemicube_row(const PatchScene& scene, std::uint32_t i, const FormFactorSettings& settings,
                  std::vector<double>& sums, FormFactorCost& cost) {
    Hemicube cube(settings.resolution);
    const PlanarPolygon& patch = scene.patches[i];
    constexpr std::uint32_t black = Hemicube::nothing - 1;
    for (int k = 0; k < settings.samples; ++k) {
        const Eye eye = eye_of(patch, i, k, settings);
        cube.place(eye.at, patch.normal, eye.turn);
        // Fronts before backs, and a back hides only what it clearly stands before: of a wall built of two one-sided
        // surfaces back to back, the front is seen.
        for (const bool front : {true, false}) {
            cube.margin = front ? 1 : 1 + 1e-6;
            for (std::uint32_t j = 0; j < scene.size(); ++j) {
                const PlanarPolygon& other = scene.patches[j];
                if (j == i || !(other.area > 0)) continue;
                const bool faces = glm::dot(other.normal, eye.at - other.corners[0]) > 0;
                if (faces != front || (!front && scene.twin[j] != no_index)) continue;
                cube.draw(other.corners, other.normal, front ? j : black);
            }
        }
        for (std::size_t pixel = 0; pixel < cube.size(); ++pixel)
            if (cube.item(pixel) < black) sums[cube.item(pixel)] += cube.delta(pixel);
        cost.cost += cube.size();
    }
    for (double& sum : sums) sum /= settings.samples;
}

void hemisphere_row(const PatchScene& scene, std::uint32_t i, const FormFactorSettings& settings,
                    std::vector<double>& sums, FormFactorCost& cost) {
    const PlanarPolygon& patch = scene.patches[i];
    for (int k = 0; k < settings.samples; ++k) {
        const Eye eye = eye_of(patch, i, k, settings);
        const Axes axes(patch.normal, eye.turn);
        RandomStream random(settings.seed + 2, (std::uint64_t(i) << 20) + static_cast<unsigned>(k));
        const HemisphereRays rays(settings.resolution, settings.cells, random.next2());
        const glm::vec3 origin(eye.at + double(scene.world->epsilon()) * patch.normal);
        for (std::uint32_t n = 0; n < rays.count(); ++n) {
            const HemisphereRay ray = rays.ray(n);
            const Hit hit = scene.world->closest(
                {origin, glm::vec3(ray.direction.x * axes.x + ray.direction.y * axes.y + ray.direction.z * axes.z)});
            if (hit.element == no_index) continue;
            const std::uint32_t j = scene.patch_of_element[hit.element];
            if (j != no_index && j != i) sums[j] += ray.delta;
        }
        cost.cost += rays.count();
    }
    for (double& sum : sums) sum /= settings.samples;
}

bool behind(const PlanarPolygon& polygon, const PlanarPolygon& other) {
    return std::ranges::none_of(polygon.corners,
                                [&](const glm::dvec3& p) { return glm::dot(other.normal, p - other.corners[0]) > 0; });
}

// What of the scene is too small for the pixels of a row that is made, and what they have missed.
void count_below_pixels(const PatchScene& scene, std::uint32_t i, FormFactorMethod method, int resolution,
                        std::span<const float> row, FormFactorCost& cost) {
    const PlanarPolygon& patch = scene.patches[i];
    const glm::dvec3 middle = centre(patch) + double(scene.world->epsilon()) * patch.normal;
    for (std::uint32_t j = 0; j < scene.size(); ++j) {
        const PlanarPolygon& other = scene.patches[j];
        if (j == i || !(other.area > 0) || behind(other, patch) || behind(patch, other)) continue;
        ++cost.pairs;
        if (!is_below_pixels(patch, other, method, resolution)) continue;
        ++cost.warned;
        if (row[j] > 0) continue;
        const glm::dvec3 there = centre(other) + double(scene.world->epsilon()) * other.normal - middle;
        if (glm::dot(there, patch.normal) <= 0 || glm::dot(there, other.normal) >= 0) continue;
        cost.missed += !scene.world->occluded({glm::vec3(middle), glm::vec3(there), 0, 1 - 1e-5f});
        ++cost.cost;
    }
}

} // namespace

PatchScene make_patch_scene(const Mesh& mesh, const World& world) {
    PatchScene scene;
    scene.world = &world;
    for (const glm::uvec3& corners : mesh.patches) scene.patches.push_back(triangle(mesh, corners));
    scene.patch_of_element = mesh.coarse_patch;
    scene.twin.assign(mesh.patches.size(), no_index);
    for (std::uint32_t element = 0; element < mesh.coarse_element_count; ++element)
        if (mesh.coarse_twin[element] != no_index)
            scene.twin[mesh.coarse_patch[element]] = mesh.coarse_patch[mesh.coarse_twin[element]];
    return scene;
}

PatchScene make_element_scene(const Mesh& mesh, const World& world) {
    PatchScene scene;
    scene.world = &world;
    for (std::uint32_t element = 0; element < mesh.coarse_element_count; ++element) {
        scene.patches.push_back(triangle(mesh, mesh.nodes[element].vertices));
        scene.patch_of_element.push_back(element);
    }
    scene.twin = mesh.coarse_twin;
    return scene;
}

FormFactorSettings row_settings(FormFactorMethod method, int samples, std::uint32_t seed) {
    FormFactorSettings settings;
    settings.seed = seed;
    switch (method) {
    case FormFactorMethod::automatic:
    case FormFactorMethod::point_to_disk:
    case FormFactorMethod::area_sampled:
        settings.samples = samples > 0 ? samples : 4;
        break;
    case FormFactorMethod::analytic:
        settings.samples = samples > 0 ? samples : 16;
        break;
    case FormFactorMethod::monte_carlo:
        settings.samples = samples > 0 ? samples : 64;
        break;
    case FormFactorMethod::hemicube:
        settings.samples = 4;
        settings.resolution = std::min(samples > 0 ? samples : 64, most_hemicube_resolution);
        break;
    case FormFactorMethod::hemisphere: // samples: rays, spread over four points
        settings.samples = 4;
        settings.resolution =
            samples > 0 ? std::clamp(static_cast<int>(std::lround(std::sqrt(samples / 4.0))), 1, 16384) : 32;
        break;
    }
    return settings;
}

void form_factor_row(const PatchScene& scene, std::uint32_t i, FormFactorMethod method, const FormFactorSettings& given,
                     std::span<float> row, FormFactorCost& cost) {
    const auto start = std::chrono::steady_clock::now();
    std::ranges::fill(row, 0.0f);
    const PlanarPolygon& patch = scene.patches[i];
    if (patch.area > 0) {
        FormFactorSettings settings = given;
        const FormFactorSettings defaults = row_settings(method, 0, given.seed);
        if (settings.samples <= 0) settings.samples = defaults.samples;
        if (settings.resolution <= 0) settings.resolution = std::max(1, defaults.resolution);
        if (method == FormFactorMethod::hemicube || method == FormFactorMethod::hemisphere) {
            std::vector<double> sums(scene.size(), 0);
            if (method == FormFactorMethod::hemicube)
                hemicube_row(scene, i, settings, sums, cost);
            else
                hemisphere_row(scene, i, settings, sums, cost);
            std::ranges::transform(sums, row.begin(), [](double sum) { return static_cast<float>(sum); });
            count_below_pixels(scene, i, method, settings.resolution, row, cost);
        } else {
            for (std::uint32_t j = 0; j < scene.size(); ++j) {
                const PlanarPolygon& other = scene.patches[j];
                if (j == i || !(other.area > 0) || behind(other, patch) || behind(patch, other)) continue;
                // Pairs are sampled anew, each with its own seed, the same in any order.
                settings.seed = static_cast<std::uint32_t>((given.seed * 0x9e3779b9u + i) * 0x85ebca6bu + j);
                const FormFactorEstimate found = form_factor(patch, other, {{}, scene.world}, method, settings);
                row[j] = static_cast<float>(found.value);
                cost.cost += found.cost;
                ++cost.pairs;
                cost.warned += !found.warning.empty();
            }
        }
    }
    cost.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace lueur
