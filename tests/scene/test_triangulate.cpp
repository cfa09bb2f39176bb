#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/scene/triangulate.h"

namespace lueur {
namespace {

using Polygon = std::vector<glm::dvec3>;

glm::dvec3 doubled(const Polygon& p, const glm::uvec3& t) {
    return glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
}

// The triangles of a planar polygon all turn as it does, and their areas add up to its own.
void expect_covers(const Polygon& polygon, const glm::dvec3& normal, double area) {
    const auto triangles = triangulate(polygon);
    ASSERT_TRUE(triangles) << triangles.error();
    double sum = 0;
    for (const glm::uvec3& t : *triangles) {
        EXPECT_GT(glm::dot(doubled(polygon, t), normal), 0);
        sum += glm::dot(doubled(polygon, t), normal) / 2;
    }
    EXPECT_NEAR(sum, area, 1e-9 * area);
}

TEST(Triangulate, ConcaveShapes) {
    expect_covers({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, {0, 0, 1}, 3); // an L
    expect_covers({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}, {0, 0, 1},
                  4); // an arrow head: only one diagonal is inside
    expect_covers({{4, 0, 0}, {1, 1, 0}, {0, 4, 0}, {0, 0, 0}}, {0, 0, 1}, 4);
    expect_covers({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, {0, 1, 0}, 1); // looks up
}

TEST(Triangulate, CornersOnAStraightLineAreKept) {
    const Polygon polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}};
    expect_covers(polygon, {0, 0, 1}, 4);
    EXPECT_EQ(triangulate(polygon)->size(), 4u); // n - 2: none is passed over, so no T-junction
}

TEST(Triangulate, AHoleJoinedByADoubledEdge) { // a wall of 4 x 3 with a window of 2 x 1
    expect_covers(
        {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {0, 0, 0}, {1, 1, 0}, {1, 2, 0}, {3, 2, 0}, {3, 1, 0}, {1, 1, 0}},
        {0, 0, 1}, 10);
}

TEST(Triangulate, RandomStars) { // star-shaped polygons of up to 60 corners, turned any way in space
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 200; ++round) {
        const int corners = 5 + static_cast<int>(random() % 56);
        const glm::dvec3 normal =
            glm::normalize(glm::dvec3(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.49));
        const glm::dvec3 u = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.5, 0.7))), v = glm::cross(normal, u);
        Polygon polygon;
        std::vector<glm::dvec2> flat;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * M_PI * i / corners, radius = 0.2 + unit(random);
            flat.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
            polygon.push_back(u * flat.back().x + v * flat.back().y + glm::dvec3(3, 4, 5));
        }
        double area = 0;
        for (std::size_t i = 0; i < flat.size(); ++i) {
            const glm::dvec2 &p = flat[i], &q = flat[(i + 1) % flat.size()];
            area += (p.x * q.y - q.x * p.y) / 2;
        }
        expect_covers(polygon, normal, area);
    }
}

// The measured red wall of the Cornell box, in mm (Cornell University Program of Computer Graphics, "Cornell Box
// Data").
TEST(Triangulate, AQuadThatIsNotPlanarBecomesTwoTriangles) {
    const Polygon wall{{552.8, 0, 0}, {549.6, 0, 559.2}, {556, 548.8, 559.2}, {556, 548.8, 0}};
    const auto triangles = triangulate(wall);
    ASSERT_TRUE(triangles);
    ASSERT_EQ(triangles->size(), 2u);
    for (const glm::uvec3& t : *triangles) EXPECT_LT(glm::normalize(doubled(wall, t)).x, -0.9999); // into the room
}

TEST(Triangulate, RefusesWhatHasNoInside) {
    EXPECT_FALSE(triangulate(Polygon{{0, 0, 0}, {1, 0, 0}}));
    EXPECT_FALSE(triangulate(Polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
    EXPECT_FALSE(triangulate(Polygon{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}}));
    EXPECT_FALSE(triangulate(
        Polygon{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, -1, 0}, {0, -1, 0}})); // crosses its first edge
}

} // namespace
} // namespace lueur
