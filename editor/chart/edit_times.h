// What an edit costs on a scene that has settled: the other half of "how fast", beside error against time.
#pragma once

#include <atomic>
#include <optional>

#include "core/scene/scene.h"

namespace lueur {

// As by hand: between two edits the solver has the time to prepare for the next (Solution::prepare_edits).
struct EditTimes {          // s of solving until the scene has settled again; medians of five edits
    double reflectance = 0; // of one material after the other
    double dimmer = 0;      // of one luminaire after the other
    double spectrum = 0;    // ditto: another black body
};

// With the scene's own solver and target error, within `time_limit` s of solving for the first solution. Nothing: it
// did not settle within that time, there is nothing to edit, or it was cancelled.
std::optional<EditTimes> edit_times(Scene scene, double time_limit, const std::atomic<bool>& cancel);

} // namespace lueur
