// The steps of a solution, for core/solve only: what solution.cpp calls in which phase.
//
// A solver plugs in with start (sources, paints or its transport are new: says in which phase it goes on), its
// transport if it keeps one, and step; solution.cpp has one switch for each. What it shows: Solution::State's
// indirect(), luminaire_is_lit(), ambient() and unshot_at_vertices(), in solution_state.cpp.
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include "core/solve/solution_state.h"
#include "core/transport/time_slice.h"

namespace lueur {

inline constexpr const char* no_finite_solution =
    "no finite solution: the scene is closed and every surface reflects everything; some reflectance must be below 1";

// What a thread of its own makes: waits for a step's time at most.
template <typename T>
bool is_ready(std::future<T>& future) {
    return future.wait_for(std::chrono::duration<double>(step_seconds)) == std::future_status::ready;
}

// A closed scene in which every surface reflects everything: the radiosity would grow without end. Of geometry and
// paints alone, so that a solver without rows can say so before it begins.
bool absorbs_nothing(const Solution::State& s);
// Of the flux that leaves the surfaces the share that meets a lit one, as far as the burial rays can tell: 1 in a
// closed scene; mean over the area.
double mean_lit_share(const Solution::State& s);

void settle(Solution::State& s);
void fail(Solution::State& s, std::string message);

// Sends the chosen solver on its way on whatever transport there is. same_sources: neither exitances nor reflectances
// have changed since it last ran.
void start_solver(Solution::State& s, bool same_sources = false);

// Channels: solution_channels.cpp.
struct SameChannels {
    bool channels, sources;
};
void plan_channels(Solution::State& s); // begins to, while the mesh is made
void make_channels(Solution::State& s);
// Anew; what stayed the same. may_wait: whether other paints ask for other wavelengths can be asked later
// (choice_waits).
SameChannels take_channels(Solution::State& s, bool may_wait);
double luminous(const Solution::State& s, const float* channels); // Y of channels
double mean_luminous_reflectance(const Solution::State& s);       // over the area of the scene
// Of each channel in "the largest unshot flux": luminous, and a little of all wavelengths so that blue is not
// forgotten.
std::vector<float> flux_weights(const Solution::State& s);

// Transport that all share: solution_transport.cpp.
void publish_mesh(Solution::State& s, std::shared_ptr<const Mesh> copy = nullptr); // the mesh has grown
void step_mesh(Solution::State& s); // what a thread of its own makes, then the channels
void step_sketch(Solution::State& s, const std::atomic<bool>& cancel);
void step_light(Solution::State& s, const std::atomic<bool>& cancel);
void step_burial(Solution::State& s, const std::atomic<bool>& cancel);
// Places and traces the points where the solution is asked whether it is right; true at the end.
bool ask_probes(Solution::State& s, const std::atomic<bool>& cancel);
void step_refine(Solution::State& s, const std::atomic<bool>& cancel); // direct light on the fine mesh

// Gathering on kept rows: solution_gathering.cpp, and of its error and of edits to come solution_gathering_*.cpp.
void start_gathering(Solution::State& s, bool same_sources);
void trace_gathering_rows(Solution::State& s, const std::atomic<bool>& cancel);
void step_gathering(Solution::State& s, const std::atomic<bool>& cancel);
void want_more_coarse_passes(Solution::State& s);
void take_stock_of_gathering(Solution::State& s); // the error that its rays leave, where it has changed
bool prepare_gathering_edits(Solution::State& s, const std::atomic<bool>& cancel); // false: nothing is left to prepare
double gathering_progress(const Solution::State& s);
std::vector<float> unshot_of_gathering(const Solution::State& s);

// Progressive shooting: solution_shooting.cpp.
void start_shooting(Solution::State& s);
void step_shooting(Solution::State& s, const std::atomic<bool>& cancel, bool one_shot);

// Jacobi, Gauss-Seidel and overshooting on the full matrix: solution_matrix.cpp.
void start_matrix(Solution::State& s, bool same_sources);
void build_matrix(Solution::State& s, const std::atomic<bool>& cancel);
void step_matrix(Solution::State& s, const std::atomic<bool>& cancel, bool one_shot);
std::vector<float> unshot_of_matrix(const Solution::State& s);
struct MatrixSize {
    bool of_elements;
    std::uint32_t patches;
};
MatrixSize matrix_size(const Mesh& mesh, int memory_mib); // elements where their matrix fits, else patches

// Hierarchical radiosity: solution_hierarchical.cpp.
void start_hierarchical(Solution::State& s, bool same_sources);
void make_links(Solution::State& s, const std::atomic<bool>& cancel);
void step_hierarchical(Solution::State& s, const std::atomic<bool>& cancel);

// Traced paths: solution_reference.cpp.
void start_reference(Solution::State& s, bool same_sources);
void step_reference(Solution::State& s, const std::atomic<bool>& cancel);

} // namespace lueur
