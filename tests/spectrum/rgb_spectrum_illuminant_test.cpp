// RGB -> smooth spectrum -> the same colour, over the whole sRGB cube, under daylight and under lamps.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "core/spectrum/chromatic_adaptation.h"
#include "core/spectrum/colour.h"
#include "core/spectrum/colour_difference.h"
#include "core/spectrum/quadrature.h"
#include "core/spectrum/reflectance_nodes.h"
#include "core/spectrum/rgb_spectrum.h"
#include "tests/spectrum/illuminants.h"

namespace lueur {
namespace {

const Xyz srgb_white = xyz_from_rgb(srgb) * Rgb(1);

double difference(const Rgb& a, const Rgb& b) { // dE2000 of linear sRGB
    return delta_e_2000(lab_from_xyz(xyz_from_rgb(srgb) * a, srgb_white),
                        lab_from_xyz(xyz_from_rgb(srgb) * b, srgb_white));
}

struct Seen { // by an eye adapted to the light
    NodeWeights weight;
    glm::dmat3 rgb_from;
};

Seen seen_under(const Spectrum& light) {
    Seen seen{node_weights(light), {}};
    Xyz white(0);
    for (const Xyz& weight : seen.weight) white += weight;
    seen.rgb_from = rgb_from_xyz(srgb) * bradford_adaptation(white, srgb_white);
    return seen;
}

Rgb rgb_of(const Spectrum& reflectance, const Seen& seen) {
    Xyz sum(0);
    for (std::size_t k = 0; k < seen.weight.size(); ++k) sum += reflectance.value[k] * seen.weight[k];
    return seen.rgb_from * sum;
}

// How far along n any reflectance from 0 to 1 reaches: 1 wherever that helps, 0 elsewhere.
double furthest_along(const Rgb& n, const Seen& seen) {
    double sum = 0;
    for (const Xyz& weight : seen.weight) sum += std::max(0.0, glm::dot(n, seen.rgb_from * weight));
    return sum;
}

int turns(const Spectrum& s) { // changes between rising and falling
    int count = 0, before = 0;
    for (std::size_t i = 1; i < s.value.size(); ++i) {
        const double step = s.value[i] - s.value[i - 1];
        const int sign = step > 1e-12 ? 1 : step < -1e-12 ? -1 : 0;
        if (sign == 0) continue;
        if (before != 0 && sign != before) ++count;
        before = sign;
    }
    return count;
}

TEST(NodeWeights, AreTheIntegralsOfTheProduct) {
    for (const char* name : {"D65", "FL11", "LED-B3"}) {
        const Spectrum light = linear_spectrum(name);
        const Spectrum paint = reflectance_from_rgb(Rgb(0.4, 0.1, 0.2));
        Xyz sum(0);
        const NodeWeights weights = node_weights(light);
        for (std::size_t k = 0; k < weights.size(); ++k) sum += paint.value[k] * weights[k];
        std::vector<double> whole_nm;
        for (int nm = observer_first_nm; nm <= observer_last_nm; ++nm) whole_nm.push_back(nm);
        const Xyz exact = integrate<Xyz>(
            breakpoints(light.nm.front(), light.nm.back(), {light.nm, paint.nm, whole_nm}), [&](double nm) {
                return value_at(light, nm, Outside::zero) * value_at(paint, nm, Outside::constant) * observer_xyz(nm);
            });
        EXPECT_NEAR(glm::distance(sum, exact) / exact.y, 0, 1e-12) << name;
    }
    // A line between two nodes, and one beyond the last.
    const NodeWeights line = node_weights(Spectrum{{546.05, 546.07, 546.09}, {0, 50, 0}});
    EXPECT_NEAR(line[33].y / (line[33].y + line[34].y), (550 - 546.07) / 5, 1e-6);
    const NodeWeights far = node_weights(Spectrum{{799, 800, 801}, {0, 1, 0}});
    EXPECT_GT(far[80].y, 0);
    EXPECT_EQ(far[79].y, 0);
}

TEST(RgbSpectrumUnderLight, GivesEveryColourBackThatTheLightCanShow) {
    for (const char* name : {"D65", "A", "FL2", "FL11", "LED-B3"}) {
        const Spectrum light = linear_spectrum(name);
        const Seen seen = seen_under(light);
        int beyond = 0;
        for (int r = 0; r <= 8; ++r) {
            for (int g = 0; g <= 8; ++g) {
                for (int b = 0; b <= 8; ++b) { // corners included
                    const Rgb wanted(srgb_decode(r / 8.0), srgb_decode(g / 8.0), srgb_decode(b / 8.0));
                    const Spectrum s = reflectance_from_rgb(wanted, light);
                    ASSERT_EQ(s.value.size(), 81u);
                    for (const double value : s.value) ASSERT_TRUE(value >= 0 && value <= 1) << value;
                    EXPECT_LE(turns(s), 1) << "one hump or one dip at most " << r << g << b;
                    const Rgb got = rgb_of(s, seen);
                    const double dE = difference(got, wanted);
                    if (dE < 1e-3) continue; // the fit itself is exact to 1e-10 of linear RGB
                    // No reflectance at all can show it, and none comes nearer: the plane across the way from what we
                    // got to what was wanted has every reflectance on our side.
                    if (dE >= 0.5) ++beyond;
                    const Rgb n = glm::normalize(wanted - got);
                    EXPECT_LT(furthest_along(n, seen), glm::dot(n, wanted)) << name << r << g << b;
                    EXPECT_NEAR(furthest_along(n, seen), glm::dot(n, got), 1e-4) << name << r << g << b;
                }
            }
        }
        // FL2 emits too little beyond 600 nm to show 17 of the 729, saturated reds and light cyans, within 0.5.
        EXPECT_EQ(beyond, name == std::string("FL2") ? 17 : 0) << name;
    }
}

TEST(RgbSpectrumUnderLight, UnderD65IsTheOneWithoutALight) {
    const Rgb brick(0.5, 0.15, 0.1);
    const Spectrum named = reflectance_from_rgb(brick, illuminant_d65()), plain = reflectance_from_rgb(brick);
    EXPECT_EQ(named, plain);
    Spectrum brighter = illuminant_d65();
    for (double& power : brighter.value) power *= 1e5;
    const Spectrum same = reflectance_from_rgb(brick, brighter);
    for (std::size_t i = 0; i < same.value.size(); ++i) EXPECT_NEAR(same.value[i], plain.value[i], 1e-7);
}

TEST(RgbSpectrumUnderLight, OfALightWithoutAWhiteIsThatOfD65) {
    const Rgb brick(0.5, 0.15, 0.1);
    EXPECT_EQ(reflectance_from_rgb(brick, Spectrum{}), reflectance_from_rgb(brick));
    EXPECT_EQ(reflectance_from_rgb(brick, Spectrum{{400, 700}, {0, 0}}), reflectance_from_rgb(brick));
    EXPECT_EQ(reflectance_from_rgb(brick, Spectrum{{900, 1000}, {1, 1}}), reflectance_from_rgb(brick));
    for (const double nm : {450.0, 530.0, 589.0, 650.0}) { // a laser: bounded, whatever it shows
        const Spectrum s = reflectance_from_rgb(brick, Spectrum{{nm - 0.1, nm, nm + 0.1}, {0, 1, 0}});
        for (const double value : s.value) EXPECT_TRUE(value >= 0 && value <= 1) << nm;
    }
    for (const double value : reflectance_from_rgb(Rgb(0.3), Spectrum{{588, 589, 590}, {0, 1, 0}}).value)
        EXPECT_EQ(value, 0.3) << "grey stays flat";
}

} // namespace
} // namespace lueur
