// What `automatic` stands for.
#include "core/solve/choose_solver.h"

#include <gtest/gtest.h>

#include "core/scene/solver_words.h"
#include "tests/support/scenes.h"

using namespace lueur;

TEST(ChooseSolver, WhatIsAskedForIsTaken) {
    const Scene room = test::small_room();
    for (const SolverKind solver : all_solvers) {
        SolveSettings settings = room.solve;
        settings.solver = solver;
        const SolverKind chosen = chosen_solver(settings);
        EXPECT_NE(chosen, SolverKind::automatic);
        EXPECT_TRUE(chosen == solver || solver == SolverKind::automatic) << to_string(solver);
    }
}
