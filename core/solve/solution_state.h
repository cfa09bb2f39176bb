// The inside of a Solution, for core/solve and core/view only.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "core/solve/error_mesh.h"
#include "core/solve/error_probes.h"
#include "core/solve/gather_system.h"
#include "core/solve/hierarchy.h"
#include "core/solve/hierarchy_field.h"
#include "core/solve/hierarchy_final.h"
#include "core/solve/hierarchy_view.h"
#include "core/solve/light_bases.h"
#include "core/solve/patch_solve.h"
#include "core/solve/shooting.h"
#include "core/solve/smoothing.h"
#include "core/solve/solution.h"
#include "core/solve/wavelengths_choice.h"
#include "core/transport/direct_transport.h"
#include "core/transport/gather_rows.h"
#include "core/transport/indirect_refinement.h"

namespace lueur {

struct TracedField; // traced_field.h

// Faces that lie in the plane of another, lit from the same side: which of the two is seen is left to rounding.
struct Overlap {
    double area = 0; // m^2
    std::uint32_t surface = no_index, other = no_index;
    std::vector<std::uint32_t> of_element; // of each coarse element: in the plane of which surface it lies
    std::uint32_t cursor = 0;
};

// Mesh to refine make what all solvers stand on; transport is a solver's own (rays, a matrix, links), solve its sweeps
// or shots. A solver may begin before refine, which gives it a first picture early.
enum class SolvePhase { mesh, sketch, light, burial, refine, transport, solve, settled, failed };

struct Solution::State {
    std::shared_ptr<const Scene> scene;
    SolverKind chosen = SolverKind::gathering; // what solves it: chosen_solver (choose_solver.h)
    SolvePhase phase = SolvePhase::mesh;
    SolveStatus status;
    std::uint32_t cursor = 0; // of the phase's time slices

    // Made of geometry alone, on a thread of its own.
    struct MadeMesh {
        Mesh mesh;
        std::shared_ptr<const Mesh> published;
        std::shared_ptr<const World> world;
        std::vector<glm::vec3> origins;
        std::vector<float> area;
        LightSamples samples;
    };
    std::future<MadeMesh> making_mesh;
    std::vector<std::future<MadeMesh>> left_meshes; // of scenes before, whose threads go on to their end

    // Transport: geometry only.
    Mesh mesh;                                  // grows while direct light refines it
    std::shared_ptr<const Mesh> published_mesh; // as of the last level
    std::shared_ptr<const World> world;
    std::unique_ptr<DirectTransport> direct;
    // Of the vertices where indirect light is gathered: the coarse ones, and once `refined` those of the mesh's level
    // of indirect light.
    std::vector<glm::vec3> origins;
    std::vector<std::uint8_t> buried;
    std::vector<float> indirect_area;     // m^2
    std::vector<float> indirect_distance; // m, to what is around, harmonic mean
    Smoothing smoothing;                  // of what is gathered there
    Receivers receivers;                  // who gathers for them
    Surroundings around;                  // of coarse vertices
    Overlap overlap;
    std::unique_ptr<IndirectRefinement> indirect_refinement; // cuts `mesh` first
    struct IndirectLevel {                                   // what came of it
        std::uint32_t vertices = 0, nodes = 0;
        std::vector<glm::uvec3> elements;
        std::vector<glm::vec3> origins;
        std::vector<std::uint8_t> buried;
        std::vector<float> distance;
    };
    std::optional<IndirectLevel> indirect_level; // not in use yet: rows that are there refer to the coarse one
    std::vector<GatherPass> passes;
    std::uint64_t passes_traced = 0; // in all, also those that are not kept any more: tells rows from other rows
    std::vector<std::vector<RayHit>> kept_hits; // of each pass, while the mesh it was traced on still grows
    std::vector<std::uint8_t> pass_buried;      // all_buried() while it is being traced
    bool pass_open = false;                     // the last pass is being traced
    std::uint32_t passes_wanted = 1;            // from the geometry alone: see passes_for
    bool only_probes_left = false;              // gathering is solved, and asks how right it is
    bool rays_planned = false;                  // passes_wanted will not grow any more
    bool refined = false;           // the level of indirect light is in use; direct light may still cut its own finer
    double element_size = 0;        // m, longest coarse edge in use
    std::vector<float> coarse_area; // m^2 of each coarse vertex
    ErrorProbes probes;             // where the solution is asked whether it is right
    mutable ErrorMesh error_mesh;   // made when a field is first asked for its error, and kept as long as the mesh

    // What a solver knows of the error of its own indirect light, lx where it is gathered, one standard deviation;
    // empty: nothing. Error estimates start from it (error_estimate.h).
    std::vector<float> indirect_deviation;

    // Sources and paints, in channels: those of `wavelengths`, then those of `trichromatic`.
    std::shared_ptr<const Wavelengths> wavelengths; // of `choice`; null until the mesh is there
    std::optional<Wavelengths> trichromatic;        // when the two are compared
    WavelengthsChoice choice;
    std::future<WavelengthsChoice> choosing;             // valid: on its way, on a thread of its own
    bool choice_waits = false;                           // it is of other paints, and to be made anew before sweeps
    std::shared_ptr<const Scene> scene_of_channels;      // that the following are of
    std::vector<std::vector<double>> material_rho;       // per material
    std::vector<std::vector<double>> luminaire_exitance; // per luminaire, W m^-2 nm^-1
    std::vector<std::optional<LuminaireIndex>> object_luminaire;

    GatherSystem system;
    std::uint64_t rows_of_system = 0;    // passes_traced when it was given its rows
    std::uint64_t rows_of_smoothing = 0; // and when the smoothing was made
    // What new rows, or the rows of new sources, make of the light there is, in slices, before the system is given
    // them. An edit drops it.
    struct RowsInTheMaking {
        ChannelField reflected, gathered;
        std::optional<ChannelField> guess; // where there are more receivers than before
        ChannelField arriving;             // of the radiosity there is
        std::uint32_t cursor = 0, arriving_cursor = 0;
    };
    std::optional<RowsInTheMaking> rows_in_the_making;
    bool rows_wait = false;       // rows or sources are not yet given to the system
    bool sweep_uncounted = false; // of a sweep that is through not all is shown
    bool indirect_stale = false;  // indirect_irradiance is of the sweep before
    LightBases light_bases;       // of the rows of `system`
    struct BasisInTheMaking {
        static constexpr std::size_t all_as_they_are = no_index; // in place of one luminaire
        Exitances exitance;                                      // what it is the solution of
        Exitances rho;                                           // it is made for
        std::uint32_t sweeps;
        ChannelField gathered;
        GatherSystem system;
    };
    std::optional<BasisInTheMaking> basis_in_the_making;
    bool rays_unjudged = false;       // indirect_deviation is of another solution
    ChannelField gathered_direct;     // irradiance at receivers after one reflection of direct light
    ChannelField indirect_irradiance; // gathered_direct + W U where it is gathered, refreshed after sweeps
    Shooting shooting;
    PatchSolve patch_solve; // Jacobi, Gauss-Seidel, overshooting
    std::unique_ptr<Hierarchy> hierarchy;
    // On their way, each on a thread of its own: their trees and tables take longer than a step may.
    std::future<std::unique_ptr<Hierarchy>> making_hierarchy;
    std::future<std::unique_ptr<LeafMesh>> making_leaf_mesh;
    enum class ShowLeaves { no, make, cut, light, read, values };
    ShowLeaves show_leaves = ShowLeaves::no; // which part of it is going on
    std::unique_ptr<LeafMesh> leaf_mesh;     // cuts `mesh`, from the first round on
    // What is shown of the leaves, made on a thread of its own that reads hierarchy, leaf_mesh and mesh: they may not
    // change meanwhile.
    struct ShownLeaves {
        std::shared_ptr<const HierarchyView> view;
        ChannelField irradiance; // at the mesh's vertices
    };
    std::future<ShownLeaves> making_shown;
    bool sources_wait = false; // new ones, until it is through
    std::uint32_t shown_round = 0;
    std::unique_ptr<FinalGather> final_gather;           // at the mesh's vertices, of the links of this round:
    std::uint32_t final_round = 0;                       //
    FinalGather::Count final_count;                      //
    bool final_counted = false;                          // all its factors
    bool final_done = false;                             // all its rays are traced, or it would be too large
    ChannelField final_irradiance;                       // what it gathers of the light there is now,
    std::uint32_t final_cursor = 0;                      // at so many vertices
    std::vector<glm::vec3> vertex_origins;               // of all vertices of the mesh
    std::shared_ptr<const HierarchyView> hierarchy_view; // as of the last round of refinement
    std::unique_ptr<TracedField> traced;                 // of the reference solver
    bool solving = false;                                // system or shooting hold this scene's sources
    std::shared_ptr<const Field> stock;                  // the field of a solution that does not move any more
    bool edit_open = true;                               // last_edit_seconds is still to be set

    int channels() const { return wavelengths->size() + (trichromatic ? trichromatic->size() : 0); }
    bool fully_refined() const { return refined && direct->refined(); }
    // Coarse vertices by their own rays, fine ones where they are dark and inside a solid.
    std::vector<std::uint8_t> all_buried() const;
    std::uint32_t material_of(std::uint32_t surface) const;
    std::optional<std::size_t> luminaire_of(std::uint32_t surface, bool back) const; // that shines on this side
    bool luminaire_is_lit(std::size_t luminaire) const;                              // shooting: it has shot
    // Irradiance at coarse vertices, at those of the level of indirect light (gathering), or at all (hierarchical).
    const ChannelField& indirect() const;
    std::vector<float> ambient() const; // irradiance to be added for display; only shooting has some
    // Luminous exitance that is still to be sent on, at the first vertices.
    std::vector<float> unshot_at_vertices() const;
    bool direct_light_apart() const; // all of it shown by DirectTransport, not by the solver
    SolverKind solver() const;       // that is at work, never automatic
    bool is_traced() const;          // fine vertices have their whole irradiance from paths

    State();
    ~State();
};

std::shared_ptr<const Field> compose_field(const Solution::State& state);

// Adds the direct irradiance of luminaires of this exitance at all vertices, per channel; those without any channels
// are left out. `irradiance` has at least as many rows.
void read_direct(const Solution::State& state, const Exitances& exitance, ChannelField& irradiance);

// Reflected radiosity per channel at a point of a coarse element: rho (H_direct + H_indirect). `radiosity` has one
// entry a channel, or stops before the trichromatic ones.
void add_reflected_radiosity(const Solution::State& state, std::uint32_t element, float b1, float b2, double factor,
                             std::span<double> radiosity);

// Irradiance per channel (those of the trichromatic approach last) at a point of a coarse element, as the window shows
// it.
std::vector<double> irradiance_at(const Solution::State& state, std::uint32_t element, float b1, float b2);

} // namespace lueur
