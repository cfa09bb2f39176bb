// MAXDISPLAY: the luminance that is shown as full white.
#pragma once

#include <vector>

#include "core/display/display_settings.h"

namespace lueur {

// The lighting engineers' rule of the lecture (chapter 11, with corrections 17 and 18). All light of the lamps is taken
// to fall on the floor, which reflects the mean of the scene: L_ref = rho_ave Phi / (pi A_floor), of equal energy at
// all wavelengths; in RGB of the display, MAXDISPLAY = 2 max_c(L_ref,c). Phi in lm, A in m^2; 0 where one of them is
// not above 0 or not finite: there is nothing to go by.
double lecture_max_display(double luminous_flux, double floor_area, double mean_reflectance, const RgbSpace& primaries);

// MAXDISPLAY that shows `share` (0..1) of the pixels' or vertices' luminances unclipped, with 10 % headroom; ignores
// zeros and what is not finite.
double auto_max_display(std::vector<float> luminances, double share = 0.98);

// exp of the mean of log L over what is above 0 and finite; 0 where nothing is. cd m^-2.
double geometric_mean_luminance(const std::vector<float>& luminances);

// The settings with the numbers that their rules choose: MAXDISPLAY and the adaptation luminance, from the luminances
// of the picture and `lecture`, what lecture_max_display gives. A rule that has nothing to go by (0) leaves the number
// as it was.
DisplaySettings resolved(DisplaySettings settings, const std::vector<float>& luminances, double lecture);

} // namespace lueur
