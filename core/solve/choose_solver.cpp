#include "core/solve/choose_solver.h"

namespace lueur {

// Gathering, for it lies on the front of every scene charted so far. `lueur chart --quick` on two shared cores,
// relative RMS error after so many seconds of solving:
//   few triangles, a lamp (Cornell box, 32): gathering 7.6 % after 0.03, 4.5 % after 0.42, 1.3 % after 0.81;
//     shooting 21 % after 0.05, 8.7 % after 0.26, 6.6 % after 0.83. The rows of the full matrix of its 3,360 elements
//     alone take 8 s (hemisphere)
//   all surfaces emit (furnace, 12): gathering and shooting are below what the reference resolves, after 0.007 and
//     0.014
//   many triangles and lamps (gallery): gathering 15 % after 1.9, shooting 32 % after 1.6
SolverKind chosen_solver(const SolveSettings& settings) {
    return settings.solver == SolverKind::automatic ? SolverKind::gathering : settings.solver;
}

} // namespace lueur
