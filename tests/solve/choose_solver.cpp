// What `automatic` stands for, by the class of a scene.
#include "core/solve/choose_solver.h"

#include <gtest/gtest.h>

#include "core/scene/solver_words.h"
#include "tests/support/scenes.h"

using namespace lueur;

TEST(ChooseSolver, KnowsAScenesClass) {
    const Scene furnace = test::furnace(0.5), room = test::small_room();
    const SceneClass all_shine = class_of(furnace, furnace.solve), lamps = class_of(room, room.solve);
    EXPECT_EQ(all_shine.triangles, 12u);
    EXPECT_NEAR(all_shine.emitting_share, 1, 1e-9);
    EXPECT_EQ(all_shine.target_error, furnace.solve.target_error);
    // Walls 59 m2, block 4.16 m2 (its base too), lamps 0.24 m2 and 0.01 m2.
    EXPECT_NEAR(lamps.emitting_share, 0.25 / (59 + 4.16 + 0.25), 1e-4);
    SolveSettings settings = room.solve;
    settings.target_error = 0.3;
    EXPECT_EQ(class_of(room, settings).target_error, 0.3);
    EXPECT_EQ(class_of(Scene{}, SolveSettings{}).emitting_share, 0);
}

TEST(ChooseSolver, WhatIsAskedForIsTaken) {
    const Scene room = test::small_room();
    for (const SolverKind solver : all_solvers) {
        SolveSettings settings = room.solve;
        settings.solver = solver;
        const SolverKind chosen = chosen_solver(room, settings);
        EXPECT_NE(chosen, SolverKind::automatic);
        EXPECT_TRUE(chosen == solver || solver == SolverKind::automatic) << to_string(solver);
    }
}

// The front of the charts (choose_solver.cpp).
TEST(ChooseSolver, IsOnTheFrontOfWhatWasCharted) {
    for (const SceneClass& charted :
         {SceneClass{32, 0.01, 0.02}, SceneClass{12, 1, 0.02}, SceneClass{30000, 0.001, 0.02}})
        EXPECT_EQ(choose_solver(charted), SolverKind::gathering);
}

// Else the solver would change under the hand that drags the slider of a paint or a dimmer.
TEST(ChooseSolver, PaintsAndDimmersDoNotMatter) {
    Scene room = test::small_room();
    room.solve.solver = SolverKind::automatic;
    const SolverKind before = chosen_solver(room);
    for (Material& material : room.materials) material.reflectance = 0.99;
    for (Luminaire& luminaire : room.luminaires) luminaire.dimmer = 0;
    EXPECT_EQ(chosen_solver(room), before);
}
