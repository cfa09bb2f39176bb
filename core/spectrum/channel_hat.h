// The functions that channels stand for.
#pragma once

#include "core/spectrum/wavelengths.h"

namespace lueur {

// A channel's hat function: 1 at its wavelength, falling to 0 at its neighbours'. The two end hats have one side.
// The hats sum to 1 over 400..700 nm. For the uniform rule.
Spectrum channel_hat(const Wavelengths& wavelengths, int channel);

// What an emission is averaged under: the same hats, but the end ones stay 1 out to 380 and 780 nm, so that they sum to
// 1 over the visible range and a line anywhere in it keeps its power.
Spectrum emission_hat(const Wavelengths& wavelengths, int channel);

// Y of linear RGB (1,1,1): 1 W spread evenly over the 400 nm from 380 to 780 nm, 182.46 lm.
double rgb_white_lumens();

} // namespace lueur
