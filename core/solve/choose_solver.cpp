#include "core/solve/choose_solver.h"

#include <algorithm>
#include <vector>

namespace lueur {

SceneClass class_of(const Scene& scene, const SolveSettings& settings) {
    SceneClass result;
    result.triangles = scene.geometry->triangles.size();
    result.target_error = settings.target_error;
    std::vector<bool> emits(scene.objects.size(), false);
    for (const Luminaire& luminaire : scene.luminaires)
        for (const ObjectIndex object : luminaire.objects)
            if (at(object) < emits.size()) emits[at(object)] = true;
    double emitting = 0, all = 0;
    const Geometry& geometry = *scene.geometry;
    for (std::size_t s = 0; s < std::min(geometry.surfaces.size(), geometry.surface_area.size()); ++s) {
        const std::size_t object = at(geometry.surfaces[s].object);
        all += geometry.surface_area[s];
        if (object < emits.size() && emits[object]) emitting += geometry.surface_area[s];
    }
    result.emitting_share = all > 0 ? emitting / all : 0;
    return result;
}

SolverKind choose_solver(const SceneClass&) {
    return SolverKind::gathering;
}

SolverKind chosen_solver(const Scene& scene, const SolveSettings& settings) {
    return settings.solver == SolverKind::automatic ? choose_solver(class_of(scene, settings)) : settings.solver;
}

} // namespace lueur
