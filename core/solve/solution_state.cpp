// What a solution shows of the solver at work.
#include "core/scene/solver_words.h"
#include "core/solve/solution_steps.h"
#include "core/solve/traced_field.h"

namespace lueur {

Solution::State::State() = default;
Solution::State::~State() = default;

bool Solution::State::is_traced() const {
    return solver() == SolverKind::reference && solving && traced && traced->passes > 0;
}

std::vector<std::uint8_t> Solution::State::all_buried() const {
    std::vector<std::uint8_t> all = direct->buried();
    for (std::size_t v = 0; v < buried.size(); ++v) all[v] = all[v] || buried[v];
    return all;
}

std::uint32_t Solution::State::material_of(std::uint32_t surface) const {
    return static_cast<std::uint32_t>(at(scene->objects[at(scene->geometry->surfaces[surface].object)].material));
}

std::optional<std::size_t> Solution::State::luminaire_of(std::uint32_t surface, bool back) const {
    const auto& luminaire = object_luminaire[at(scene->geometry->surfaces[surface].object)];
    if (!luminaire) return std::nullopt;
    const EmitSide side = scene->luminaires[at(*luminaire)].side;
    if (side != EmitSide::both && (side == EmitSide::back) != back) return std::nullopt;
    return at(*luminaire);
}

SolverKind Solution::State::solver() const {
    return chosen;
}

bool Solution::State::luminaire_is_lit(std::size_t luminaire) const {
    switch (solver()) {
    case SolverKind::shooting:
        return solving && shooting.luminaire_has_shot()[luminaire] != 0;
    case SolverKind::overshooting:
    case SolverKind::jacobi:
    case SolverKind::gauss_seidel:
        return !solving; // then it is in the patches' irradiance
    case SolverKind::automatic:
    case SolverKind::gathering:
    case SolverKind::reference:
        return true;
    case SolverKind::hierarchical:
        return direct_light_apart() || !solving || shown_round == 0; // then it is in the leaves' irradiance
    }
    return true;
}

bool Solution::State::direct_light_apart() const {
    return solver() != SolverKind::hierarchical || scene->solve.oracle == RefinementOracle::error;
}

const ChannelField& Solution::State::indirect() const {
    switch (solver()) {
    case SolverKind::shooting:
        return shooting.indirect();
    case SolverKind::overshooting:
    case SolverKind::jacobi:
    case SolverKind::gauss_seidel:
        return patch_solve.irradiance;
    case SolverKind::automatic:
    case SolverKind::gathering:
    case SolverKind::hierarchical:
    case SolverKind::reference:
        return indirect_irradiance;
    }
    return indirect_irradiance;
}

std::vector<float> Solution::State::ambient() const {
    if (solver() != SolverKind::shooting || !solving) return {};
    // It stands for light on its way. What little of it is left in the end may be a sun's, and would outshine a candle
    // in a cellar.
    if (phase == SolvePhase::settled) return std::vector<float>(static_cast<std::size_t>(channels()), 0.0f);
    return shooting.ambient();
}

std::vector<float> Solution::State::unshot_at_vertices() const {
    switch (solver()) {
    case SolverKind::automatic:
    case SolverKind::gathering:
        return unshot_of_gathering(*this);
    case SolverKind::shooting:
        return shooting.unshot_at_vertices();
    case SolverKind::overshooting:
    case SolverKind::jacobi:
    case SolverKind::gauss_seidel:
        return unshot_of_matrix(*this);
    case SolverKind::hierarchical:
    case SolverKind::reference:
        break;
    }
    return std::vector<float>(mesh.coarse_vertex_count, 0);
}

} // namespace lueur
