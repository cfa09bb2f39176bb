// Solvers, form-factor methods and oracles as words: in scene files, on the command line, in reports and metadata.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene/scene.h"

namespace lueur {

inline constexpr std::array all_solvers{SolverKind::automatic,    SolverKind::gathering, SolverKind::shooting,
                                        SolverKind::overshooting, SolverKind::jacobi,    SolverKind::gauss_seidel,
                                        SolverKind::hierarchical, SolverKind::reference};
inline constexpr std::array all_form_factor_methods{FormFactorMethod::automatic,     FormFactorMethod::analytic,
                                                    FormFactorMethod::point_to_disk, FormFactorMethod::area_sampled,
                                                    FormFactorMethod::monte_carlo,   FormFactorMethod::hemicube,
                                                    FormFactorMethod::hemisphere};
inline constexpr std::array all_oracles{RefinementOracle::form_factor, RefinementOracle::flux, RefinementOracle::error};

std::string to_string(SolverKind solver); // "gauss_seidel"; automatic is "auto"
std::string to_string(FormFactorMethod method);
std::string to_string(RefinementOracle oracle);

// A word may have hyphens for underscores: gauss-seidel.
bool is_word(std::string_view text, std::string_view word);
template <typename Enum, std::size_t N>
std::optional<Enum> from_word(std::string_view text, const std::array<Enum, N>& all) {
    for (const Enum one : all)
        if (is_word(text, to_string(one))) return one;
    return {};
}
template <typename Enum, std::size_t N>
std::string words_of(const std::array<Enum, N>& all) { // "jacobi, gauss_seidel"
    std::string words;
    for (const Enum one : all) words += (words.empty() ? "" : ", ") + to_string(one);
    return words;
}

// The solver needs form factors between patches: the method and its samples mean something to it.
bool uses_form_factors(SolverKind solver);

} // namespace lueur
