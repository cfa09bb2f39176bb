// The solvers of the full matrix in a solution: the matrix built in slices, then sweeps or shots.
#include "core/solve/solution_steps.h"

namespace lueur {

using State = Solution::State;

void start_matrix(State& s, bool) {
    fail(s, "the matrix solver is not in this build");
}

void build_matrix(State&, const std::atomic<bool>&) {}

void step_matrix(State&, const std::atomic<bool>&, bool) {}

} // namespace lueur
