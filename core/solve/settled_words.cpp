#include "core/solve/settled_words.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/solve/error_estimate.h"
#include "core/solve/solution_steps.h"
#include "core/transport/time_slice.h"

namespace lueur {

namespace {

using State = Solution::State;

constexpr double worth_a_word = 0.015;    // of the light, beyond twice the estimated error
constexpr double much_on_backs = 0.1;     // of the light
constexpr double overlap_share = 1e-3;    // of all area
constexpr double gap_share = 0.05;        // of all area
constexpr std::uint8_t most_near = 12;    // of burial_rays: next to one wall it is half of them
constexpr double single_precision = 6e-8; // rounding of one number

std::string name_of_surface(const State& s, std::uint32_t surface) {
    return s.scene->objects[at(s.scene->geometry->surfaces[surface].object)].name;
}

std::string words_of_overlap(const State& s) {
    double area = 0;
    for (const float a : s.mesh.coarse_area) area += double(a);
    if (s.overlap.surface == no_index || s.overlap.area < overlap_share * area) return {};
    const std::string both = fmt::format("\"{}\" and \"{}\" lie in one plane", name_of_surface(s, s.overlap.surface),
                                         name_of_surface(s, s.overlap.other));
    switch (s.solver()) {
    case SolverKind::automatic:
    case SolverKind::gathering:
    case SolverKind::reference: // a ray meets one of the two, and only that one lights others
        return {};
    case SolverKind::shooting:
    case SolverKind::overshooting:
    case SolverKind::jacobi:
    case SolverKind::gauss_seidel:
    case SolverKind::hierarchical:
        break;
    }
    return both + " and both shine: move one, or use the gathering solver";
}

std::string words_of_balance(const State& s, const Field& field, const FluxBalance& balance) {
    const double lost = balance.lost_share();
    if (s.overlap.surface != no_index) return {}; // light is counted on both faces
    if (std::abs(lost) <= 2 * field.scene_error + worth_a_word + balance.unsure / balance.emitted) return {};
    const std::string how_much = lost > 0 ? fmt::format("{:.0f} % of the light is lost", 100 * lost)
                                          : fmt::format("{:.0f} % more light than there is", -100 * lost);
    if (s.solver() == SolverKind::hierarchical && s.scene->solve.oracle != RefinementOracle::error)
        return how_much + ": links of this oracle lose what touching surfaces exchange; oracle = \"error\" keeps it";
    return how_much + ": the elements are too large for what is exchanged between them";
}

// Walls a millimetre apart: what one element sends the opposite one is not what their vertices or points see.
std::string words_of_gaps(const State& s) {
    switch (s.solver()) {
    case SolverKind::overshooting:
    case SolverKind::jacobi:
    case SolverKind::gauss_seidel: // form factors over the whole of both
    case SolverKind::reference:
        return {};
    case SolverKind::automatic:
    case SolverKind::gathering:
    case SolverKind::shooting:
    case SolverKind::hierarchical:
        break;
    }
    double gap = 0, area = 0;
    for (std::uint32_t v = 0; v < s.mesh.coarse_vertex_count; ++v) {
        if (s.buried[v]) continue;
        area += double(s.coarse_area[v]);
        if (s.around.near[v] >= most_near) gap += double(s.coarse_area[v]);
    }
    if (!(gap > gap_share * area)) return {};
    return fmt::format("{:.0f} % of the surfaces face others at less than {:.2g} of an element's {:.2g} m: smaller "
                       "elements would show what is lost at the edges",
                       100 * gap / area, s.around.near_distance / s.element_size, s.element_size);
}

// A sun beside a candle: what is left unsent of the sun outweighs the candle.
std::string words_of_unsent(const State& s) {
    if (s.solver() != SolverKind::overshooting) return {};
    const PatchSolve& p = s.patch_solve;
    for (std::uint32_t e = 0; e < s.mesh.coarse_element_count; ++e) {
        const auto l = s.luminaire_of(s.mesh.coarse_surface[e], s.mesh.coarse_back[e] != 0);
        if (!l) continue;
        const double* unshot = p.system.unshot()[p.of_element[e]];
        for (int c = 0; c < s.channels(); ++c)
            if (unshot[c] > 0.5 * s.luminaire_exitance[*l][static_cast<std::size_t>(c)] && unshot[c] > 0)
                return fmt::format(
                    "\"{}\" has not been sent out: it is less than the target error leaves of the others",
                    s.scene->luminaires[*l].name);
    }
    return {};
}

} // namespace

FluxBalance flux_balance(const State& s, const Field& field) {
    FluxBalance balance;
    const std::size_t count = field.irradiance_xyz.size();
    const ErrorMesh& mesh = error_mesh_of(s);
    const std::vector<float>& area = mesh.area;
    const std::vector<std::uint8_t>& buried = mesh.buried;
    std::vector<double> lit(count), back(count);
    for (std::size_t v = 0; v < count; ++v) {
        if (v < s.around.lit.size()) {
            lit[v] = double(s.around.lit[v]) / burial_rays, back[v] = double(s.around.back[v]) / burial_rays;
        } else {
            const auto& p = s.mesh.vertices[v].parents;
            lit[v] = 0.5 * (lit[p[0]] + lit[p[1]]), back[v] = 0.5 * (back[p[0]] + back[p[1]]);
        }
        const double emitted = std::numbers::pi * double(field.emitted_xyz[v].y);
        const double reflected = buried[v] ? 0 : std::numbers::pi * double(field.reflected_xyz[v].y);
        balance.emitted += double(area[v]) * emitted;
        balance.sent += double(area[v]) * (emitted + reflected) * lit[v];
        balance.on_backs += double(area[v]) * (emitted + reflected) * back[v];
        if (!buried[v]) balance.arriving += double(area[v]) * double(field.irradiance_xyz[v].y);
    }
    for (const glm::uvec3& e : s.mesh.elements) {
        const glm::vec3 a = s.mesh.vertices[e.x].position;
        const double third =
            double(glm::length(glm::cross(s.mesh.vertices[e.y].position - a, s.mesh.vertices[e.z].position - a))) / 6;
        const auto [least, most] = std::minmax({lit[e.x], lit[e.y], lit[e.z]});
        for (int k = 0; k < 3; ++k)
            balance.unsure += third * (most - least) * std::numbers::pi *
                              double(field.emitted_xyz[e[k]].y + field.reflected_xyz[e[k]].y);
    }
    return balance;
}

bool find_overlap(const Mesh& mesh, const World& world, const std::vector<std::uint8_t>& buried,
                  const std::atomic<bool>& cancel, Overlap& overlap) {
    const float lift = 4 * world.epsilon();
    overlap.of_element.resize(mesh.coarse_element_count, no_index);
    const auto look = [&](std::uint32_t e) {
        const glm::uvec3 v = mesh.nodes[e].vertices;
        if (buried[v.x] && buried[v.y] && buried[v.z]) return;
        const glm::vec3 a = mesh.vertices[v.x].position, b = mesh.vertices[v.y].position,
                        c = mesh.vertices[v.z].position;
        const glm::vec3 normal = glm::cross(b - a, c - a);
        const float length = glm::length(normal);
        if (!(length > 0)) return;
        // Not at the middle, where a diagonal of the other face may run.
        const glm::vec3 p = 0.42f * a + 0.31f * b + 0.27f * c, n = normal / length;
        const Hit hit = world.closest({p + lift * n, -n, 0, 2 * lift});
        if (hit.element != no_index && mesh.coarse_surface[hit.element] != mesh.coarse_surface[e])
            overlap.of_element[e] = mesh.coarse_surface[hit.element];
    };
    if (!run_slice(overlap.cursor, mesh.coarse_element_count, 64, cancel, [&](std::uint32_t first, std::uint32_t last) {
            for (std::uint32_t e = first; e < last; ++e) look(e);
        }))
        return false;
    for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e) {
        if (overlap.of_element[e] == no_index) continue;
        overlap.area += double(mesh.coarse_area[e]);
        overlap.surface = mesh.coarse_surface[e], overlap.other = overlap.of_element[e];
    }
    return true;
}

std::string settled_words(const State& s, const Field& field) {
    const FluxBalance balance = flux_balance(s, field);
    if (!(balance.emitted > 0)) return {};
    if (!(balance.arriving > 0) && balance.on_backs > 0)
        return "the luminaires' light meets only black backs of one-sided surfaces: nothing is lit";
    if (balance.on_backs > much_on_backs * balance.emitted)
        return fmt::format("{:.0f} % of the light falls on black backs of one-sided surfaces: turn them round or make "
                           "them two-sided",
                           100 * balance.on_backs / balance.emitted);
    if (std::string words = words_of_overlap(s); !words.empty()) return words;
    if (std::string words = words_of_unsent(s); !words.empty()) return words;
    if (const double rounding = single_precision * balance.arriving / balance.emitted;
        rounding > field.scene_error && rounding > 1e-3)
        return fmt::format("light is reflected {:.2g} times here: single precision leaves an error of about {:.1g} %",
                           balance.arriving / balance.emitted, 100 * rounding);
    if (s.solver() == SolverKind::hierarchical && s.hierarchy && s.hierarchy->limited())
        return fmt::format("{} links are the most that are kept: finer ones would be needed for the target",
                           s.hierarchy->link_count());
    if (std::string words = words_of_balance(s, field, balance); !words.empty()) return words;
    return words_of_gaps(s);
}

} // namespace lueur
