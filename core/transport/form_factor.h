// Form factors between planar polygons: the lecture's methods behind one enum.
//
// F_ij is the share of the diffuse flux that leaves patch i and reaches patch j (Bouatouch; Cohen & Wallace 1993,
// eq. 4.2): F_ij = 1/(pi A_i) int int h cos cos / r^2 dA_j dA_i, h = 1 where nothing stands between. Dimensionless.
// Polygons radiate from their front only; occluders are opaque from both sides. Nothing here throws or gives NaN; every
// function may run from any number of threads, and gives the same for one seed whatever their number.
//
//   analytic       contour integrals, exact. Behind up to 32 occluders the visible part of j is found exactly too and
//                  only the integral over i is done by quadrature; behind more the visible share is sampled with rays
//   point_to_disk  R sub-elements a patch, A_j cos cos / (pi r^2 + A_j) and a shadow ray between each pair
//   area_sampled   R sub-elements of i, Lambert's exact element to polygon formula, visible share by shadow rays
//   monte_carlo    random pairs of points, one shadow ray each
//   hemicube       rasterised item buffers of five faces at points of i
//   hemisphere     ray-cast item buffers at points of i
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"
#include "core/transport/planar_polygon.h"
#include "core/transport/world.h"

namespace lueur {

enum class HemisphereCells {
    theta_phi, // the lecture's: rings of equal angle
    equal,     // directions spread by the cosine law, each of the same form factor
};

struct FormFactorSettings {
    // 0 means the method's default.
    int samples = 0;    // R sub-elements a patch (16), pairs of points (4096), item buffers a patch (16)
    int resolution = 0; // pixels along an edge of the hemicube (128); square root of a hemisphere's rays (64)
    HemisphereCells cells = HemisphereCells::equal;
    std::uint32_t seed = 1;
    const std::atomic<bool>* cancel = nullptr; // set: what is under way ends soon, with a value of no meaning
    bool is_cancelled() const { return cancel && cancel->load(std::memory_order_relaxed); }
};
// From SolveSettings::form_factor_samples, which is the one number that matters most to each method. Rows of a matrix
// are made with fewer samples than single pairs: many patches share the error.
FormFactorSettings row_settings(FormFactorMethod method, int samples, std::uint32_t seed);

struct FormFactorEstimate {
    double value = 0;
    double standard_error = -1; // of the value, estimated, or a bound of it; below 0: none is known
    std::uint64_t cost = 0;     // rays, kernel or contour evaluations, pixels
    double seconds = 0;
    std::string warning; // why the method is not to be trusted here, one line; empty: it is
    FormFactorMethod method = FormFactorMethod::automatic; // that gave it
};

// What may stand between two polygons: plain polygons, tested one after the other in double precision, or a scene.
struct Occluders {
    std::vector<PlanarPolygon> polygons;
    const World* world = nullptr; // also of the two patches themselves; not owned
};

// F from `from` to `to`. `automatic` takes the cheapest method that is exact enough and within its region.
FormFactorEstimate form_factor(const PlanarPolygon& from, const PlanarPolygon& to, const Occluders& occluders,
                               FormFactorMethod method, const FormFactorSettings& settings);
// What `automatic` takes.
FormFactorMethod chosen_method(const PlanarPolygon& from, const PlanarPolygon& to, const Occluders& occluders);

// Patches of a scene.
struct PatchScene {
    std::vector<PlanarPolygon> patches;
    std::vector<std::uint32_t> twin;             // of each patch: its other side; no_index: one-sided
    std::vector<std::uint32_t> patch_of_element; // of each coarse element that the World's hits name
    const World* world = nullptr;                // not owned
    std::uint32_t size() const { return static_cast<std::uint32_t>(patches.size()); }
};
PatchScene make_patch_scene(const Mesh& mesh, const World& world);   // mesh.patches
PatchScene make_element_scene(const Mesh& mesh, const World& world); // its coarse elements

struct FormFactorCost {
    std::uint64_t cost = 0; // as FormFactorEstimate::cost
    double seconds = 0;
    std::uint64_t pairs = 0;  // that face each other
    std::uint64_t warned = 0; // pairs for which the method is outside its region; item buffers: below their resolution
    std::uint64_t missed = 0; // pairs that no pixel of an item buffer met, though their middles see each other
};

// F_ij from patch i to all, row[j]; all of it is written. hemicube and hemisphere make whole item buffers; the others
// go pair by pair. row sums are what the method gives: above 1 for some, see tests/transport.
void form_factor_row(const PatchScene& scene, std::uint32_t i, FormFactorMethod method,
                     const FormFactorSettings& settings, std::span<float> row, FormFactorCost& cost);

} // namespace lueur
