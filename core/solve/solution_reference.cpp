// Traced paths in a solution: irradiance of each vertex, path by path.
#include "core/solve/solution_steps.h"

namespace lueur {

using State = Solution::State;

void start_reference(State& s, bool) {
    fail(s, "the reference solver is not in this build");
}

void step_reference(State&, const std::atomic<bool>&) {}

} // namespace lueur
