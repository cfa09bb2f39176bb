#include "ui/convergence_runs.h"

#include <algorithm>

#include "ui/solver_rows.h"

namespace lueur {

void ConvergenceRuns::note(const Snapshot& snapshot) {
    if (!snapshot.scene || snapshot.revision == revision) return;
    revision = snapshot.revision;
    if (geometry != snapshot.scene->geometry) runs.clear();
    geometry = snapshot.scene->geometry;
    if (snapshot.history.empty()) return;
    const std::string name = solver_label(snapshot.scene->solve);
    const auto known = std::ranges::find(runs, name, &ConvergenceRun::name);
    if (known == runs.end())
        runs.push_back({name, snapshot.history});
    else
        known->history = snapshot.history;
}

void ConvergenceRuns::forget_others(const std::string& name) {
    std::erase_if(runs, [&](const ConvergenceRun& run) { return run.name != name; });
}

} // namespace lueur
