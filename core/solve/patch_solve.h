// What the solvers of the full matrix keep in a solution.
#pragma once

#include <vector>

#include "core/solve/channel_field.h"
#include "core/solve/form_factor_matrix.h"
#include "core/solve/matrix_system.h"

namespace lueur {

struct PatchSolve {
    // What the matrix was made with.
    FormFactorMethod method = FormFactorMethod::automatic;
    int samples = 0;
    std::uint32_t seed = 0;
    int memory = 0; // MiB

    bool of_elements = true;               // patches are the coarse elements; false: the mesh's patches
    std::vector<std::uint32_t> of_element; // patch of each coarse element
    PatchScene scene;
    bool announced = false;  // its memory has been stated
    FormFactorMatrix matrix; // n = 0: none yet
    std::uint32_t cursor = 0;
    bool complete = false;
    FormFactorCost cost;
    RowSums sums;

    MatrixSystem system;
    ChannelField irradiance;     // at the coarse vertices
    double smoothing = 0;        // relative RMS difference between patches and the mean of their vertices
    double arriving = 0;         // luminous flux on all patches, lm
    std::vector<double> history; // share missing after each sweep, or round of as many shots as there are patches
    std::vector<double> unshot_history; // share unshot after each sweep
};

} // namespace lueur
