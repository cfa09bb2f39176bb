// The rows of the solver panel that choose a solver and what it works with.
#pragma once

#include <string>

#include "core/scene/scene.h"
#include "editor/snapshot.h"
#include "ui/ui_state.h"

namespace lueur {

const char* solver_name(SolverKind solver);
const char* form_factor_name(FormFactorMethod method);

// "Jacobi, hemicube": what tells one curve of convergence from another.
std::string solver_label(const SolveSettings& settings);

// Changes `solve`; true when something is changed for good.
bool solver_rows(const Snapshot& snapshot, UiState& state, SolveSettings& solve);

} // namespace lueur
