#include "core/display/calibration.h"

#include <algorithm>
#include <cmath>

namespace lueur {

DisplayImage calibration_picture(int width, int height, TransferCurve curve, const glm::dvec3& gamma) {
    DisplayImage picture{std::max(width, 0), std::max(height, 0), {}};
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const int column = calibration_column_count * x / picture.width,
                      row = calibration_row_count * y / picture.height;
            const auto within = [](int at, int cells, int size) { // place in its cell, 0..1
                const double place = (at + 0.5) * cells / size;
                return place - std::floor(place);
            };
            const double u = within(x, calibration_column_count, picture.width),
                         v = within(y, calibration_row_count, picture.height);
            const int quarters = row + 1; // of white's light
            const bool solid = std::abs(u - 0.5) < 0.25 && std::abs(v - 0.5) < 0.25;
            // Of four lines one, two or three are lit; two are not neighbours.
            const int line = y % 4;
            const bool lit = quarters == 1 ? line == 0 : quarters == 2 ? line % 2 == 0 : line != 0;
            std::array<std::uint8_t, 3> code{};
            for (std::size_t c = 0; c < 3; ++c) {
                if (column < 3 && static_cast<int>(c) != column) continue;
                const double light = 0.25 * quarters;
                const double value = !solid                         ? (lit ? 1.0 : 0.0)
                                     : curve == TransferCurve::srgb ? srgb_encode(light)
                                                                    : std::pow(light, 1 / gamma[static_cast<int>(c)]);
                code[c] = static_cast<std::uint8_t>(std::lround(255 * value));
            }
            picture.rgb.push_back(code);
        }
    return picture;
}

} // namespace lueur
