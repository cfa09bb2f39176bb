#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/scene/luminaire.h"
#include "core/scene/scene_file.h"

namespace lueur {

namespace {

struct Checker {
    std::vector<std::string> faults;

    void expect(bool good, std::string_view what, std::string_view allowed) {
        if (!good) faults.push_back(fmt::format("{}; {} is allowed", what, allowed));
    }
    void range(double value, double low, double high, std::string_view what, std::string_view allowed) {
        expect(value >= low && value <= high, fmt::format("{} is {}", what, value), allowed); // false for NaN
    }
};

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_material(Checker& checker, const Material& material) {
    for (const std::string& fault : faults_of(material.reflectance))
        checker.faults.push_back(fmt::format("material \"{}\": {}", material.name, fault));
    if (material.texture)
        checker.expect(material.texture->image != nullptr,
                       fmt::format("material \"{}\": the texture has no picture", material.name), "a picture");
}

void check_luminaire(Checker& checker, const Scene& scene, const Luminaire& luminaire) {
    const std::string what = fmt::format("luminaire \"{}\": ", luminaire.name);
    const std::size_t before = checker.faults.size();
    checker.range(luminaire.power, 0, 1e12, what + "power", "0..1e12");
    checker.range(luminaire.dimmer, 0, 1e6, what + "dimmer", "0..1e6");
    checker.expect(!luminaire.objects.empty(), what + "it names no object", "at least one");
    for (const ObjectIndex object : luminaire.objects)
        checker.expect(at(object) < scene.objects.size(), fmt::format("{}object {} is not there", what, at(object)),
                       "an object of the scene");
    for (const std::string& fault : faults_of(luminaire.spectrum)) checker.faults.push_back(what + fault);
    if (checker.faults.size() != before || luminaire.power == 0 || luminaire.dimmer == 0) return;
    if (!(emitting_area(scene, luminaire) > 0)) {
        checker.faults.push_back(what + "its objects have no area, so it emits nothing");
        return;
    }
    if (!(radiant_flux(scene, luminaire) > 0))
        checker.faults.push_back(what + "its spectrum has no power in 380..780 nm, so it emits nothing");
}

} // namespace

std::vector<std::string> check(const Scene& scene) {
    Checker checker;
    for (const Material& material : scene.materials) check_material(checker, material);
    for (const Object& object : scene.objects)
        checker.expect(at(object.material) < scene.materials.size(),
                       fmt::format("object \"{}\": material {} is not there", object.name, at(object.material)),
                       "a material of the scene");
    for (const Luminaire& luminaire : scene.luminaires) check_luminaire(checker, scene, luminaire);

    const Camera& camera = scene.camera;
    checker.expect(finite(camera.position) && finite(camera.target) && finite(camera.up),
                   "camera: a position or direction is not finite", "a finite number");
    const glm::dvec3 forward = camera.target - camera.position;
    checker.expect(glm::length(forward) > 0, "camera: the target is where the camera stands", "another point");
    if (glm::length(forward) > 0)
        checker.expect(glm::length(glm::cross(forward, camera.up)) >
                           1e-9 * glm::length(forward) * glm::length(camera.up),
                       "camera: it looks along its up direction", "any other up");
    checker.range(camera.vertical_fov_degrees, 1, 170, "camera: vertical field of view", "1..170 degrees");

    const SolveSettings& solve = scene.solve;
    checker.expect(solve.target_error > 0 && solve.target_error <= 1,
                   fmt::format("solve: target error is {}", solve.target_error), "more than 0, at most 1");
    checker.expect(solve.colour_error > 0 && solve.colour_error <= 100,
                   fmt::format("solve: colour error is {}", solve.colour_error),
                   "more than 0, at most 100 (CIEDE2000)");
    checker.range(solve.element_size, 0, 1e12, "solve: element size", "0 or more");
    checker.range(solve.max_rays, 1, 1 << 20, "solve: most rays a receiver", "1..1048576");
    checker.range(solve.form_factor_samples, 0, most_form_factor_samples, "solve: form factor samples", "0..1048576");
    checker.range(solve.link_tolerance, 0, 1e12, "solve: link tolerance", "0 or more");
    checker.range(solve.matrix_memory, 1, most_matrix_memory, "solve: memory of the matrix", "1..1048576 MiB");
    for (const std::string& fault : check(scene.display)) checker.faults.push_back(fault);
    return std::move(checker.faults);
}

} // namespace lueur
