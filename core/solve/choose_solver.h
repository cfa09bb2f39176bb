// What `automatic` stands for: the solver on the front of error against time for a scene of this class.
#pragma once

#include <cstddef>

#include "core/scene/scene.h"

namespace lueur {

// What decides, of the things that are known before anything is traced and that no paint or dimmer changes (or the
// solver would change under the hand that drags a slider).
struct SceneClass {
    std::size_t triangles = 0;
    double emitting_share = 0; // of the area of all surfaces, one side counted
    double target_error = 0.02;
};
SceneClass class_of(const Scene& scene, const SolveSettings& settings);

SolverKind choose_solver(const SceneClass& scene); // never `automatic`

// The solver itself, or what `automatic` stands for.
SolverKind chosen_solver(const Scene& scene, const SolveSettings& settings);
inline SolverKind chosen_solver(const Scene& scene) {
    return chosen_solver(scene, scene.solve);
}

} // namespace lueur
