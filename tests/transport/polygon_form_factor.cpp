// Lambert's formula against closed forms of Howell's catalogue (B-3, B-4) and properties.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "core/transport/polygon_form_factor.h"

using namespace lueur;
using std::numbers::pi;

namespace {

// Howell B-3: element parallel to a rectangle a x b at distance c, below one corner.
double below_corner(double a, double b, double c) {
    const double A = a / c, B = b / c;
    return (A / std::sqrt(1 + A * A) * std::atan(B / std::sqrt(1 + A * A)) +
            B / std::sqrt(1 + B * B) * std::atan(A / std::sqrt(1 + B * B))) /
           (2 * pi);
}

} // namespace

TEST(PolygonFormFactor, ElementBelowTheCornerOfARectangle) {
    EXPECT_NEAR(below_corner(1, 1, 1), 0.138531605994893, 1e-14); // Howell's figure itself
    for (const double a : {0.01, 0.5, 1.0, 10.0})
        for (const double b : {0.02, 1.0, 7.0})
            for (const double c : {0.1, 1.0, 20.0}) {
                const glm::dvec3 square[4] = {{0, 0, c}, {0, b, c}, {a, b, c}, {a, 0, c}};
                EXPECT_NEAR(polygon_form_factor({0, 0, 0}, {0, 0, 1}, square) / below_corner(a, b, c), 1, 1e-9);
            }
}

TEST(PolygonFormFactor, PerpendicularRectangleIsCutAtTheHorizon) {
    // Howell B-4, element and rectangle with the foot at the element's plane: X = a/b, Y = c/b.
    const double a = 1, b = 1, c = 1, X = a / b, Y = c / b;
    const double exact = (std::atan(1 / Y) - Y / std::hypot(X, Y) * std::atan(1 / std::hypot(X, Y))) / (2 * pi);
    EXPECT_NEAR(exact, 0.0557341970025535, 1e-14);
    // The rectangle reaches as far below the element's plane as above: only the upper half counts.
    const glm::dvec3 wall[4] = {{c, 0, -a}, {c, 0, a}, {c, b, a}, {c, b, -a}};
    EXPECT_NEAR(polygon_form_factor({0, 0, 0}, {0, 0, 1}, wall), exact, 1e-9);
}

TEST(PolygonFormFactor, BehindEitherSideIsZero) {
    const glm::dvec3 facing[4] = {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}};
    const glm::dvec3 averted[4] = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    EXPECT_GT(polygon_form_factor({0, 0, 0}, {0, 0, 1}, facing), 0.5);
    EXPECT_EQ(polygon_form_factor({0, 0, 0}, {0, 0, 1}, averted), 0);
    EXPECT_EQ(polygon_form_factor({0, 0, 0}, {0, 0, -1}, facing), 0);
}

// In a closed convex room the factors from any point and direction sum to 1: all that arrives leaves some wall.
TEST(PolygonFormFactor, SumsToOneInAClosedBox) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0.02, 0.98), sign(-1, 1);
    for (int n = 0; n < 200; ++n) {
        const glm::dvec3 p(unit(random), unit(random), unit(random));
        const glm::dvec3 normal = glm::normalize(glm::dvec3(sign(random), sign(random), sign(random)));
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 2; ++side) {
                glm::dvec3 q[4];
                const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                for (int k = 0; k < 4; ++k) {
                    q[k][axis] = side;
                    q[k][u] = k == 1 || k == 2;
                    q[k][v] = k >= 2;
                }
                if (side == 1) std::swap(q[1], q[3]);
                sum += polygon_form_factor(p, normal, q);
            }
        EXPECT_NEAR(sum, 1, 1e-12);
    }
}

TEST(PolygonFormFactor, AnyScaleGivesTheSame) {
    for (const double scale : {1e-3, 1.0, 1e3, 1e6}) {
        const glm::dvec3 square[4] = {{0, 0, scale}, {0, scale, scale}, {scale, scale, scale}, {scale, 0, scale}};
        EXPECT_NEAR(polygon_form_factor({0, 0, 0}, {0, 0, 1}, square), below_corner(1, 1, 1), 1e-12);
    }
}
