// What `automatic` stands for: the solver on the front of error against time.
#pragma once

#include "core/scene/scene.h"

namespace lueur {

// The solver itself, or what `automatic` stands for: never `automatic`. No paint and no dimmer changes it, or the
// solver would change under the hand that drags a slider.
SolverKind chosen_solver(const SolveSettings& settings);

inline SolverKind chosen_solver(const Scene& scene) {
    return chosen_solver(scene.solve);
}

} // namespace lueur
