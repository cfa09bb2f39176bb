// What becomes of a colour that the display cannot show. Hall 1989, "Illumination and Color in Computer Generated
// Imagery", section 5.3 (the lecture's chapter 11 takes its four rules from there); the negative components it leaves
// to the reader are defined here.
#pragma once

#include "core/display/display_settings.h"

namespace lueur {

// Linear RGB of the display, its white at 1 -> each component in 0..1. `luminance_weights`: Y of each primary, sum 1.
//   clamp              each component by itself
//   keep_chromaticity  negatives to 0 (no such light can be sent), then divided by the largest component if that is
//                      above 1: the chromaticity of what is left stays, the luminance gives way
//   desaturate         mixed with the grey of its own luminance, no more than brings each component into 0..1:
//   luminance
//                      and dominant hue stay, the saturation gives way; luminance above 1 is white, below 0 black
//   scale_all          the whole picture has been divided by its largest component before (core/display/display.h);
//                      what remains are negatives, to 0
Rgb clipped(const Rgb& rgb, ClipRule rule, const glm::dvec3& luminance_weights);

} // namespace lueur
