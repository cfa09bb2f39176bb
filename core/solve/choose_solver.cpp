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

// Gathering, for it lies on the front of every class charted so far; nothing in the class has yet been seen to change
// that. `lueur chart --quick` on two shared cores, relative RMS error after so many seconds of solving:
//   few triangles, a lamp (Cornell box, 32): gathering 7.6 % after 0.03, 4.5 % after 0.42, 1.3 % after 0.81;
//     shooting 21 % after 0.05, 8.7 % after 0.26, 6.6 % after 0.83. The rows of the full matrix of its 3,360 elements
//     alone take 8 s (hemisphere)
//   all surfaces emit (furnace, 12): gathering and shooting are below what the reference resolves, after 0.007 and
//     0.014
//   many triangles and lamps (gallery): gathering 15 % after 1.9, shooting 32 % after 1.6
SolverKind choose_solver(const SceneClass&) {
    return SolverKind::gathering;
}

SolverKind chosen_solver(const Scene& scene, const SolveSettings& settings) {
    return settings.solver == SolverKind::automatic ? choose_solver(class_of(scene, settings)) : settings.solver;
}

} // namespace lueur
