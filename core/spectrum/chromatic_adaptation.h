// How a colour seen under one white looks the same under another.
#pragma once

#include "core/spectrum/wavelengths.h"

namespace lueur {

// The linear Bradford transform (ICC.1:2010, annex E; Lam 1985 without its non-linear blue): XYZ under `from` -> the
// XYZ that matches it under `to`; `from` becomes `to` exactly. Both whites in one unit, each number above 0.
glm::dmat3 bradford_adaptation(const Xyz& from, const Xyz& to);

} // namespace lueur
