// Which MAXDISPLAY and adaptation luminance the window uses.
//
// Where the scene's rules say so they come from its own picture or lamps: once when the first useful light has arrived
// and once more when the solution has settled for the first time. After that they stay, whatever is edited, until the
// user asks, takes another rule or takes off the lock.
#pragma once

#include <cstdint>
#include <optional>

#include "core/display/display.h"
#include "core/scene/scene.h"
#include "editor/snapshot.h"

namespace lueur {

struct Exposure {
    std::optional<double> chosen; // MAXDISPLAY, cd m^-2; unused while the scene says its own
    double adaptation = 0;        // cd m^-2, chosen with it
    bool final = false;           // chosen from a settled solution
    bool asked = false;           // "auto now" was pressed
    std::uint64_t settled_revision = 0;
    DisplaySettings rules; // that it was chosen by
};

// Does anything of the display follow the picture?
bool follows_picture(const DisplaySettings& display);

// The settings to display with.
DisplaySettings display_in_use(const DisplaySettings& scene, const Exposure& exposure);

// The settings as their rules choose them for what the camera sees now; nothing while there is no light to see.
std::optional<DisplaySettings> display_for(const Snapshot& snapshot, const DisplaySettings& display,
                                           const Camera& camera, double aspect);

// Looks at a new snapshot of the scene; true when the exposure changed.
bool update_exposure(Exposure& exposure, const DisplaySettings& scene, const Snapshot& snapshot, const Camera& camera,
                     double aspect);

} // namespace lueur
