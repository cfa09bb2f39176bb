// Points to measure at.
#pragma once

#include "core/view/surface_points.h"

namespace lueur::test {

using lueur::surface_points;

} // namespace lueur::test
