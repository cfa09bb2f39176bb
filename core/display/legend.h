// The legend of a false-colour picture, drawn into it: files have to say by themselves what their colours mean.
#pragma once

#include <string_view>

#include "core/display/display.h"

namespace lueur {

// A bar with its round numbers in the lower left corner, on black. `unit`: "lx" or "cd/m2". Pictures that are too small
// for it (less than 240 x 120 pixels) are left as they are.
void draw_legend(DisplayImage& image, const FalseColourSettings& scale, std::string_view unit);
void draw_legend(DeepDisplayImage& image, const FalseColourSettings& scale, std::string_view unit);

} // namespace lueur
