// `lueur form-factors --failures`: what each method makes of the pairs that are hard for it.
#pragma once

#include "editor/commands/batch_session.h"
#include "editor/commands/form_factor_cases.h"

namespace lueur {

// Touching, nearly coplanar, small, elongated, grazing, behind a thin bar, far, behind the plane, large and small in
// absolute size.
std::vector<FormFactorCase> hard_form_factor_cases();

// Without sampling of what is between; to 1e-9 of its value, behind occluders to 1e-6 or what its bound says.
struct TrueFormFactor {
    double value, bound;
};
TrueFormFactor true_form_factor(const FormFactorCase& one, const std::atomic<bool>* cancel);

// Writes form_factor_failures.csv, form_factor_failures.svg and form_factor_aliasing.svg into the folder
// command.output; the exit status.
int write_form_factor_failures(const FormFactorsCommand& command, BatchSession& session);

} // namespace lueur
