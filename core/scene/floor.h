// What the lighting engineers' rule for MAXDISPLAY asks of a scene (core/display/max_display.h).
#pragma once

#include "core/scene/scene.h"

namespace lueur {

struct FloorFacts {
    double luminous_flux = 0;    // lm of all luminaires, dimmers included
    double floor_area = 0;       // m^2
    double mean_reflectance = 0; // luminous under equal energy, over the area of all surfaces that are no lamps
};

// The floor is what faces up (within 15 degrees) at the bottom of the scene: no more than a tenth of the scene's height
// above the lowest such triangle, so that a step or a carpet counts and a table does not. A scene with nothing of the
// kind (a street lamp over a slope) has the area of its bounding box seen from above.
FloorFacts floor_facts(const Scene& scene);

} // namespace lueur
