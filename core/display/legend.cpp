#include "core/display/legend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "core/display/false_colour.h"

namespace lueur {

namespace {

constexpr int glyph_width = 5, glyph_height = 7;

// Rows from the top, the leftmost of five dots is bit 4.
struct Glyph {
    char letter;
    std::array<std::uint8_t, glyph_height> rows;
};
constexpr Glyph font[] = {
    {'0', {0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110}},
    {'1', {0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110}},
    {'2', {0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111}},
    {'3', {0b01110, 0b10001, 0b00001, 0b00110, 0b00001, 0b10001, 0b01110}},
    {'4', {0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010}},
    {'5', {0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110}},
    {'6', {0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110}},
    {'7', {0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b01000, 0b01000}},
    {'8', {0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110}},
    {'9', {0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100}},
    {'.', {0b00000, 0b00000, 0b00000, 0b00000, 0b00000, 0b01100, 0b01100}},
    {'+', {0b00000, 0b00100, 0b00100, 0b11111, 0b00100, 0b00100, 0b00000}},
    {'-', {0b00000, 0b00000, 0b00000, 0b11111, 0b00000, 0b00000, 0b00000}},
    {'/', {0b00001, 0b00010, 0b00010, 0b00100, 0b01000, 0b01000, 0b10000}},
    {'E', {0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b11111}},
    {'c', {0b00000, 0b00000, 0b01111, 0b10000, 0b10000, 0b10000, 0b01111}},
    {'d', {0b00001, 0b00001, 0b01111, 0b10001, 0b10001, 0b10001, 0b01111}},
    {'e', {0b00000, 0b00000, 0b01110, 0b10001, 0b11111, 0b10000, 0b01110}},
    {'l', {0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110}},
    {'m', {0b00000, 0b00000, 0b11010, 0b10101, 0b10101, 0b10101, 0b10101}},
    {'x', {0b00000, 0b00000, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001}},
};

template <typename Code>
struct Canvas {
    CodeImage<Code>& image;
    int dot; // pixels a dot of the font has along its edges

    void fill(int left, int top, int width, int height, const glm::vec3& colour) {
        std::array<Code, 3> code{};
        for (std::size_t c = 0; c < 3; ++c)
            code[c] = static_cast<Code>(
                std::lround(std::numeric_limits<Code>::max() * static_cast<double>(colour[static_cast<int>(c)])));
        for (int y = std::max(top, 0); y < std::min(top + height, image.height); ++y)
            for (int x = std::max(left, 0); x < std::min(left + width, image.width); ++x)
                image.rgb[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                          static_cast<std::size_t>(x)] = code;
    }
    int width_of(std::string_view text) const {
        return text.empty() ? 0 : dot * (static_cast<int>(text.size()) * (glyph_width + 1) - 1);
    }
    void write(int left, int top, std::string_view text) {
        for (const char letter : text) {
            for (const Glyph& glyph : font) {
                if (glyph.letter != letter) continue;
                for (int row = 0; row < glyph_height; ++row)
                    for (int column = 0; column < glyph_width; ++column)
                        if (glyph.rows[static_cast<std::size_t>(row)] >> (glyph_width - 1 - column) & 1)
                            fill(left + column * dot, top + row * dot, dot, dot, glm::vec3(0.9f));
            }
            left += dot * (glyph_width + 1);
        }
    }
};

template <typename Code>
void draw(CodeImage<Code>& image, const FalseColourSettings& scale, std::string_view unit) {
    if (image.width < 240 || image.height < 120) return;
    Canvas<Code> canvas{image, std::max(1, image.height / 700)};
    const int dot = canvas.dot, gap = 4 * dot, text = glyph_height * dot, bar = 10 * dot;
    const int width = std::min(260 * dot, image.width - 6 * gap);
    const int left = 3 * gap, top = image.height - 3 * gap - 2 * text - 2 * gap - bar;
    canvas.fill(left - 2 * gap, top - 2 * gap, width + 4 * gap, 2 * text + bar + 6 * gap, glm::vec3(0.07f));
    canvas.write(left, top, unit);
    const int bar_top = top + text + gap;
    for (int x = 0; x < width; ++x) canvas.fill(left + x, bar_top, 1, bar, false_colour((x + 0.5) / width));
    const auto place = [&](double value) {
        return left + static_cast<int>(place_on_scale(scale, value) * (width - 1));
    };
    for (const double level : isoline_levels(scale))
        if (level >= scale.low && level <= scale.high)
            canvas.fill(place(level), bar_top, dot, bar, with_isoline(false_colour(place_on_scale(scale, level)), 1));
    int taken_to = -1000000;
    for (const double tick : scale_ticks(scale)) {
        const std::string number = fmt::format("{:.4g}", tick);
        const int own = canvas.width_of(number);
        const int from = std::clamp(place(tick) - own / 2, left, left + width - own);
        if (from < taken_to + 2 * gap) continue;
        canvas.write(from, bar_top + bar + gap, number);
        taken_to = from + own;
    }
}

} // namespace

void draw_legend(DisplayImage& image, const FalseColourSettings& scale, std::string_view unit) {
    draw(image, scale, unit);
}

void draw_legend(DeepDisplayImage& image, const FalseColourSettings& scale, std::string_view unit) {
    draw(image, scale, unit);
}

} // namespace lueur
