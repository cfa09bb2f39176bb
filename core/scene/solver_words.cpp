#include "core/scene/solver_words.h"

#include <algorithm>

namespace lueur {

std::string to_string(SolverKind solver) {
    switch (solver) {
    case SolverKind::automatic:
        return "auto";
    case SolverKind::gathering:
        return "gathering";
    case SolverKind::shooting:
        return "shooting";
    case SolverKind::overshooting:
        return "overshooting";
    case SolverKind::jacobi:
        return "jacobi";
    case SolverKind::gauss_seidel:
        return "gauss_seidel";
    case SolverKind::hierarchical:
        return "hierarchical";
    case SolverKind::reference:
        return "reference";
    }
    return {};
}

std::string to_string(FormFactorMethod method) {
    switch (method) {
    case FormFactorMethod::automatic:
        return "auto";
    case FormFactorMethod::analytic:
        return "analytic";
    case FormFactorMethod::point_to_disk:
        return "point_to_disk";
    case FormFactorMethod::area_sampled:
        return "area_sampled";
    case FormFactorMethod::monte_carlo:
        return "monte_carlo";
    case FormFactorMethod::hemicube:
        return "hemicube";
    case FormFactorMethod::hemisphere:
        return "hemisphere";
    }
    return {};
}

std::string to_string(RefinementOracle oracle) {
    switch (oracle) {
    case RefinementOracle::form_factor:
        return "form_factor";
    case RefinementOracle::flux:
        return "flux";
    case RefinementOracle::error:
        return "error";
    }
    return {};
}

bool is_word(std::string_view text, std::string_view word) {
    return std::ranges::equal(text, word, [](char a, char b) { return a == b || (a == '-' && b == '_'); });
}

bool uses_form_factors(SolverKind solver) {
    switch (solver) {
    case SolverKind::overshooting:
    case SolverKind::jacobi:
    case SolverKind::gauss_seidel:
    case SolverKind::hierarchical:
        return true;
    case SolverKind::automatic:
    case SolverKind::gathering:
    case SolverKind::shooting:
    case SolverKind::reference:
        return false;
    }
    return false;
}

} // namespace lueur
