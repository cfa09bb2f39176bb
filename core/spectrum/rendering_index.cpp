#include "core/spectrum/rendering_index.h"

#include <algorithm>
#include <cmath>

#include "core/spectrum/observer.h"
#include "core/spectrum/reflectance_nodes.h"

namespace lueur {

namespace {

constexpr int thousandths[test_colour_count][node_count] = {
#include "core/spectrum/test_colour_samples_table.inc"
};

using TestColours = std::array<Spectrum, test_colour_count>;

const TestColours& test_colours() {
    static const TestColours colours = [] {
        TestColours all;
        for (std::size_t i = 0; i < all.size(); ++i)
            for (int k = 0; k < node_count; ++k) {
                all[i].nm.push_back(node_nm(k));
                all[i].value.push_back(thousandths[i][k] / 1000.0);
            }
        return all;
    }();
    return colours;
}

// The light's own colour and those of the test colours under it; Y of the light is 100.
struct Colours {
    Xyz light{0};
    std::array<Xyz, test_colour_count> sample{};
};

Colours colours_under(const Spectrum& light) {
    const NodeWeights node = node_weights(light); // one integral a node serves all the test colours
    Colours colours;
    for (std::size_t k = 0; k < node.size(); ++k) {
        colours.light += node[k];
        for (std::size_t i = 0; i < colours.sample.size(); ++i)
            colours.sample[i] += test_colours()[i].value[k] * node[k];
    }
    const double scale = 100 / colours.light.y;
    colours.light *= scale;
    for (Xyz& sample : colours.sample) sample *= scale;
    return colours;
}

// CIE 13.3-1995, 5.6 and 5.7: the coordinates that von Kries' adaptation scales.
double c_of(const Uv1960& uv) {
    return (4 - uv.u - 10 * uv.v) / uv.v;
}
double d_of(const Uv1960& uv) {
    return (1.708 * uv.v + 0.404 - 1.481 * uv.u) / uv.v;
}

struct Uvw {
    double u, v, w; // U*, V*, W* of CIE 1964
};
Uvw uvw_from(double luminance, const Uv1960& uv, const Uv1960& white) {
    const double w = 25 * std::cbrt(luminance) - 17;
    return {13 * w * (uv.u - white.u), 13 * w * (uv.v - white.v), w};
}

} // namespace

const Spectrum& test_colour_sample(int number) {
    return test_colours()[static_cast<std::size_t>(std::clamp(number, 1, test_colour_count) - 1)];
}

bool within_reference(const ColourRendering& rendering) {
    return rendering.reference_distance <= most_reference_distance;
}

std::optional<ColourRendering> colour_rendering(const Spectrum& light) {
    const auto temperature = colour_temperature(xyz_from_spectrum(light));
    if (!temperature) return {};
    const double kelvin = temperature->kelvin;
    const Colours under = colours_under(light);
    const Colours under_reference = colours_under(kelvin < 5000 ? blackbody(kelvin) : daylight(kelvin));

    // The symbols of CIE 13.3: k the light, r the reference, i the test colour.
    const Uv1960 k = uv1960_from_xyz(under.light), r = uv1960_from_xyz(under_reference.light);
    const double c_gain = c_of(r) / c_of(k), d_gain = d_of(r) / d_of(k);
    ColourRendering rendering{*temperature, std::hypot(k.u - r.u, k.v - r.v)};
    for (std::size_t i = 0; i < rendering.special.size(); ++i) {
        const Uv1960 seen = uv1960_from_xyz(under.sample[i]);
        const double c = c_gain * c_of(seen), d = d_gain * d_of(seen);
        const double below = 16.518 + 1.481 * c - d;
        const Uv1960 adapted{(10.872 + 0.404 * c - 4 * d) / below, 5.520 / below};
        const Uvw a = uvw_from(under.sample[i].y, adapted, r);
        const Uvw b = uvw_from(under_reference.sample[i].y, uv1960_from_xyz(under_reference.sample[i]), r);
        rendering.special[i] = 100 - 4.6 * std::hypot(a.u - b.u, a.v - b.v, a.w - b.w);
    }
    for (int i = 0; i < 8; ++i) rendering.general += rendering.special[static_cast<std::size_t>(i)] / 8;
    return rendering;
}

} // namespace lueur
