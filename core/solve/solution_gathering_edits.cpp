// What a settled gathering solution does while it is idle: bases of luminaires, for edits to come (light_bases.h).
#include "core/solve/gathering_sources.h"
#include "core/solve/solution_steps.h"

namespace lueur {

namespace {

constexpr double residuals_in_a_sum = 4; // a sum of bases may have more of it than each

using State = Solution::State;

} // namespace

// One sweep, or what comes before the first: of what one luminaire does alone, or of what is shown, from which edits
// start while not all luminaires have a basis. Both are solved further than what is shown, for sums add residuals up.
bool prepare_gathering_edits(State& s, const std::atomic<bool>& cancel) {
    using Making = State::BasisInTheMaking;
    LightBases& bases = s.light_bases;
    if (s.passes.empty() || s.status.emitted_lumens <= 0) return false;
    bases.keep_for(room_for_bases(s), s.material_rho);
    std::optional<std::size_t> luminaire = bases.next();
    if (luminaire && !bases.has_reference(s.luminaire_exitance)) luminaire = Making::all_as_they_are;
    if (!luminaire) {
        s.basis_in_the_making.reset();
        return false;
    }
    const std::uint32_t n = s.receivers.count();
    Exitances exitance = s.luminaire_exitance;
    if (*luminaire != Making::all_as_they_are) {
        exitance.assign(exitance.size(), {});
        exitance[*luminaire].assign(static_cast<std::size_t>(s.channels()), 1.0);
    }
    if (!s.basis_in_the_making || s.basis_in_the_making->exitance != exitance ||
        s.basis_in_the_making->rho != s.material_rho) {
        Making making{exitance, s.material_rho, 0, s.gathered_direct, s.system};
        if (*luminaire != Making::all_as_they_are) {
            if (!apply_rows(s.passes, RayEnds::fine, reflected_direct(s, exitance), making.gathered, cancel))
                return true;
            making.system = GatherSystem(n, s.channels(), receiver_areas(s));
            making.system.set_sources(rho_of_receivers(s), making.gathered);
        }
        s.basis_in_the_making = std::move(making);
        return true;
    }
    Making& making = *s.basis_in_the_making;
    if (making.system.relative_residual() > residual_target / residuals_in_a_sum) {
        if (!making.system.sweep(s.passes, cancel)) return true;
        if (making.system.diverged() || ++making.sweeps > most_gathering_sweeps) {
            if (*luminaire == Making::all_as_they_are) return false;
            bases.give_up(*luminaire);
        }
        return true;
    }
    LightSolution solution{std::move(making.gathered), making.system.radiosity(), making.system.gathered()};
    if (*luminaire == Making::all_as_they_are)
        bases.set_reference(exitance, std::move(solution));
    else
        bases.add(*luminaire, std::move(solution));
    s.basis_in_the_making.reset();
    return true;
}

} // namespace lueur
