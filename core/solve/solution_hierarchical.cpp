// Hierarchical radiosity in a solution: links made and refined, then gathered over, pushed and pulled.
#include "core/solve/solution_steps.h"

namespace lueur {

using State = Solution::State;

void start_hierarchical(State& s, bool) {
    fail(s, "the hierarchical solver is not in this build");
}

void make_links(State&, const std::atomic<bool>&) {}

void step_hierarchical(State&, const std::atomic<bool>&) {}

} // namespace lueur
