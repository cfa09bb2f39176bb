// How far apart two colours look; 1 is about the smallest difference seen side by side.
#pragma once

#include "core/spectrum/cielab.h"
#include "core/spectrum/cieluv.h"

namespace lueur {

double delta_e_ab(const Lab& first, const Lab& second); // CIE 1976
double delta_e_uv(const Luv& first, const Luv& second); // CIE 1976
// CIEDE2000 (ISO/CIE 11664-6:2014) as Sharma, Wu & Dalal 2005 write it, with k_L = k_C = k_H = 1.
double delta_e_2000(const Lab& first, const Lab& second);

} // namespace lueur
