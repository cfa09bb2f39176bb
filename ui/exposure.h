// Which MAXDISPLAY the window uses.
//
// A scene that says max_display_auto gets it from its own picture: once when the first useful light has arrived and
// once more when the solution has settled for the first time. After that it stays, whatever is edited, until the user
// asks or takes off the lock.
#pragma once

#include <cstdint>
#include <optional>

#include "core/display/display.h"
#include "core/scene/scene.h"
#include "editor/snapshot.h"

namespace lueur {

struct Exposure {
    std::optional<double> chosen; // cd m^-2, from the picture; unused while the scene says its own
    bool final = false;           // chosen from a settled solution
    bool asked = false;           // "auto now" was pressed
    std::uint64_t settled_revision = 0;
};

// The settings to display with.
DisplaySettings display_in_use(const DisplaySettings& scene, const Exposure& exposure);

// MAXDISPLAY of the picture the camera sees now; nothing while there is no light to see.
std::optional<double> max_display_of(const Snapshot& snapshot, const Camera& camera, double aspect);

// Looks at a new snapshot of the scene; true when the exposure changed.
bool update_exposure(Exposure& exposure, const DisplaySettings& scene, const Snapshot& snapshot, const Camera& camera,
                     double aspect);

} // namespace lueur
