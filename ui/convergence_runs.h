// Curves of the solvers that ran before on this scene, to be drawn under the one that runs now.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "editor/snapshot.h"

namespace lueur {

struct ConvergenceRun {
    std::string name; // solver_label
    std::vector<ConvergencePoint> history;
};

struct ConvergenceRuns {
    std::vector<ConvergenceRun> runs; // in the order they first ran; the present one among them
    std::shared_ptr<const Geometry> geometry;
    std::uint64_t revision = 0;

    // Keeps the newest curve of each solver and form-factor method; another scene's geometry forgets them all.
    void note(const Snapshot& snapshot);
    void forget_others(const std::string& name); // all but this
};

} // namespace lueur
