// False colour: a luminance or an illuminance as a colour on a scale, with contours (isolux lines). The window's shader
// does the same with the same numbers (ui/shaders/display.frag.glsl).
#pragma once

#include <span>
#include <vector>

#include "core/display/display_settings.h"

namespace lueur {

// Encoded sRGB of 0..1: viridis as a polynomial of degree 6 (after M. Zucker's fit of matplotlib's table), dark violet
// to yellow, monotone in lightness and told apart by colour-blind eyes.
glm::vec3 false_colour(double t);

// Place of a value on the scale, 0..1; what lies outside is at the nearer end.
double place_on_scale(const FalseColourSettings& scale, double value);

// Round numbers within the scale, for its legend: 1, 2 and 5 times powers of ten on a logarithmic scale (powers alone
// where that would be more than `most`), even steps of such a number on a linear one.
std::vector<double> scale_ticks(const FalseColourSettings& scale, std::size_t most = 10);

// With automatic, low and high from the values: round numbers around their 2nd and 99th percentile, but no more than
// three decades, since the insides of closed things are dark; a linear scale from (nearly) 0. `weights`, where there
// are any: how much each value counts. Values that are not above 0 do not count; without any the scale stays as it is.
FalseColourSettings fitted(FalseColourSettings scale, std::span<const float> values,
                           std::span<const float> weights = {});

// The contours to draw: the scale's own, or its ticks.
std::vector<double> isoline_levels(const FalseColourSettings& scale);

// Of a colour difference (CIEDE2000): from what nobody sees to another colour.
const FalseColourSettings& colour_difference_scale();
// Of an estimated error, in per cent.
const FalseColourSettings& error_scale();

// How much of a pixel the contours of a quantity cover, 0..1. A contour runs where |value - level| is less than half
// its width times the gradient; the gradient takes on each axis the smaller of the differences to both neighbours, so
// that the edge of an object is no contour. Neighbours of 0 or less are not there. `width` in pixels.
struct Neighbours {
    double left = 0, right = 0, above = 0, below = 0;
};
double isoline_strength(std::span<const double> levels, double value, const Neighbours& neighbours, double width);

inline constexpr double isoline_width = 1.6; // pixels

// White on dark colours, black on bright ones; the same on one contour, since it has one colour beneath it.
glm::vec3 with_isoline(const glm::vec3& colour, double strength);

} // namespace lueur
