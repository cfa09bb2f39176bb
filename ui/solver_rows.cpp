#include "ui/solver_rows.h"

#include <array>

#include <fmt/format.h>

#include "core/scene/solver_words.h"
#include "core/solve/choose_solver.h"
#include "core/solve/form_factor_matrix.h"
#include "ui/widgets.h"

namespace lueur {

const char* solver_name(SolverKind solver) {
    switch (solver) {
    case SolverKind::automatic:
        return "Automatic";
    case SolverKind::gathering:
        return "Gathering";
    case SolverKind::shooting:
        return "Shooting";
    case SolverKind::overshooting:
        return "Overshooting";
    case SolverKind::jacobi:
        return "Jacobi";
    case SolverKind::gauss_seidel:
        return "Gauss-Seidel";
    case SolverKind::hierarchical:
        return "Hierarchical";
    case SolverKind::reference:
        return "Traced paths";
    }
    return "";
}

const char* form_factor_name(FormFactorMethod method) {
    switch (method) {
    case FormFactorMethod::automatic:
        return "Automatic";
    case FormFactorMethod::analytic:
        return "Analytic";
    case FormFactorMethod::point_to_disk:
        return "Point to disk";
    case FormFactorMethod::area_sampled:
        return "Area sampled";
    case FormFactorMethod::monte_carlo:
        return "Monte Carlo";
    case FormFactorMethod::hemicube:
        return "Hemicube";
    case FormFactorMethod::hemisphere:
        return "Hemisphere";
    }
    return "";
}

std::string solver_label(const Scene& scene) {
    const SolveSettings& settings = scene.solve;
    const SolverKind solver = chosen_solver(scene);
    std::string label = solver_name(solver);
    if (uses_form_factors(solver) && settings.form_factors != FormFactorMethod::automatic)
        label += fmt::format(", {}", form_factor_name(settings.form_factors));
    return label;
}

namespace {

const char* solver_tip(SolverKind solver) {
    switch (solver) {
    case SolverKind::automatic:
        return "The method with the least error for its time on scenes like this one: see the chart";
    case SolverKind::gathering:
        return "Direct light apart, rays gathered once and kept, sweeps over the kept rows";
    case SolverKind::shooting:
        return "Progressive refinement: the patch with most unshot light shoots it, and an ambient term stands for the "
               "rest";
    case SolverKind::overshooting:
        return "Shooting on the full matrix, where a patch also shoots what it will still receive";
    case SolverKind::jacobi:
        return "Full matrix of form factors; each sweep gathers from the radiosities of the one before";
    case SolverKind::gauss_seidel:
        return "Full matrix of form factors; each patch gathers from the newest radiosities";
    case SolverKind::hierarchical:
        return "Links between elements of a quadtree, refined where they carry error";
    case SolverKind::reference:
        return "Paths traced from each vertex, without radiosity: slow and unbiased";
    }
    return "";
}

const char* form_factor_tip(FormFactorMethod method) {
    switch (method) {
    case FormFactorMethod::automatic:
        return "For each pair the cheapest method that is exact enough there";
    case FormFactorMethod::analytic:
        return "Contour integrals, exact; visibility sampled behind many occluders";
    case FormFactorMethod::point_to_disk:
        return "Sub-elements as disks: cheap, wrong for close and grazing patches";
    case FormFactorMethod::area_sampled:
        return "Exact element to polygon at sub-elements, with shadow rays";
    case FormFactorMethod::monte_carlo:
        return "Random pairs of points with shadow rays: noisy for patches that touch";
    case FormFactorMethod::hemicube:
        return "Rasterised item buffers: small patches may fall between pixels";
    case FormFactorMethod::hemisphere:
        return "Ray-cast item buffers: rows that sum to 1 in a closed room";
    }
    return "";
}

const char* oracle_name(RefinementOracle oracle) {
    switch (oracle) {
    case RefinementOracle::form_factor:
        return "Form factor";
    case RefinementOracle::flux:
        return "Flux";
    case RefinementOracle::error:
        return "Error";
    }
    return "";
}

const char* oracle_tip(RefinementOracle oracle) {
    switch (oracle) {
    case RefinementOracle::form_factor:
        return "Refine links with large form factors, lit or dark";
    case RefinementOracle::flux:
        return "Refine links that carry much light";
    case RefinementOracle::error:
        return "Refine links by the estimated error of the light they carry, visibility included";
    }
    return "";
}

template <typename Enum, std::size_t N>
bool word_combo(UiState& state, const char* id, const std::array<Enum, N>& all, const char* (*name)(Enum),
                const char* (*tip)(Enum), Enum& value) {
    bool any = false;
    const bool open = ImGui::BeginCombo(fmt::format("##{}", id).c_str(), name(value), ImGuiComboFlags_HeightLargest);
    state.layout_log.widget(id);
    if (!open) {
        tooltip(state, tip(value));
        return false;
    }
    for (const Enum one : all) {
        if (ImGui::Selectable(name(one), value == one) && value != one) {
            value = one;
            any = true;
        }
        state.layout_log.widget(fmt::format("{}:{}", id, name(one)));
        tooltip(state, tip(one));
    }
    ImGui::EndCombo();
    return any;
}

bool keeps_matrix(SolverKind solver) {
    return uses_form_factors(solver) && solver != SolverKind::hierarchical;
}

bool form_factor_rows(UiState& state, SolveSettings& solve) {
    row_label(state, "Form factors", "How the share of light from patch to patch is found.");
    bool any = word_combo(state, "form_factors", all_form_factor_methods, form_factor_name, form_factor_tip,
                          solve.form_factors);
    row_label(state, "Samples", "Sub-elements, rays, or pixels along the hemicube's edge.");
    static constexpr std::array samples{0, 1, 4, 16, 64, 256, 1024};
    const auto text = [](int n) { return n > 0 ? fmt::format("{}", n) : std::string("the method's own"); };
    if (ImGui::BeginCombo("##samples", text(solve.form_factor_samples).c_str())) {
        for (const int n : samples)
            if (ImGui::Selectable(text(n).c_str(), n == solve.form_factor_samples)) {
                solve.form_factor_samples = n;
                any = true;
            }
        ImGui::EndCombo();
    }
    state.layout_log.widget("form_factor_samples");
    return any;
}

bool matrix_row(const Snapshot& snapshot, UiState& state, SolveSettings& solve) {
    row_label(state, "Matrix at most",
              "Memory that the full matrix of form factors may take. Elements are its patches "
              "where that fits, else larger patches.");
    static constexpr std::array mib{64, 256, 1024, 4096, 16384};
    const auto text = [](int n) { return bytes_text(std::uint64_t(n) << 20); };
    const std::string now =
        snapshot.status.matrix_patches > 0
            ? fmt::format("{}: {} patches, {}", text(solve.matrix_memory), whole_number(snapshot.status.matrix_patches),
                          bytes_text(snapshot.status.matrix_bytes))
            : text(solve.matrix_memory);
    bool any = false;
    if (ImGui::BeginCombo("##matrix", now.c_str())) {
        for (const int n : mib)
            if (ImGui::Selectable(text(n).c_str(), n == solve.matrix_memory)) {
                solve.matrix_memory = n;
                any = true;
            }
        ImGui::EndCombo();
    }
    state.layout_log.widget("matrix_memory");
    return any;
}

} // namespace

bool solver_rows(const Snapshot& snapshot, UiState& state, SolveSettings& solve) {
    row_label(state, "Solver");
    bool any = word_combo(state, "solver", all_solvers, solver_name, solver_tip, solve.solver);
    const SolverKind solver = chosen_solver(solve);
    if (uses_form_factors(solver)) any = form_factor_rows(state, solve) || any;
    if (keeps_matrix(solver)) any = matrix_row(snapshot, state, solve) || any;
    if (solver == SolverKind::hierarchical) {
        row_label(state, "Oracle", "What links between elements are refined by.");
        any = word_combo(state, "oracle", all_oracles, oracle_name, oracle_tip, solve.oracle) || any;
    }
    return any;
}

} // namespace lueur
