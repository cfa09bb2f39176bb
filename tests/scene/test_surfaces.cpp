// What becomes one surface, and what does not.
#include <cmath>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/surfaces.h"

namespace lueur {
namespace {

const std::vector<Object> one_object{{"thing", MaterialIndex{0}}};

struct Soup : TriangleSoup {
    void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, std::uint32_t object = 0) {
        const auto base = static_cast<std::uint32_t>(vertices.size());
        for (const glm::dvec3& p : {a, b, c}) vertices.push_back({glm::vec3(p), glm::vec3(0), glm::vec2(0)});
        triangles.emplace_back(base, base + 1, base + 2);
        triangle_object.push_back(ObjectIndex{object});
    }
    void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
              std::uint32_t object = 0) {
        triangle(a, b, c, object);
        triangle(a, c, d, object);
    }
    void with_normals_from(const glm::dvec3& centre) {
        for (Vertex& vertex : vertices) vertex.normal = glm::vec3(glm::normalize(glm::dvec3(vertex.position) - centre));
    }
};

Geometry make(const Soup& soup) {
    std::vector<std::string> warnings;
    Geometry geometry = make_geometry(soup, one_object, warnings);
    EXPECT_TRUE(warnings.empty()) << testing::PrintToString(warnings);
    return geometry;
}

Soup box(bool smooth = false) {
    Soup soup;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 n(0), u(0), v(0);
            n[axis] = side;
            u[(axis + 1) % 3] = 1;
            v[(axis + 2) % 3] = side;
            soup.quad(n - u - v, n + u - v, n + u + v, n - u + v);
        }
    if (smooth) soup.with_normals_from(glm::dvec3(0));
    return soup;
}

Soup sphere(int rings, int sectors) {
    const auto point = [&](int i, int j) {
        if (i == rings) return glm::dvec3(0, -1, 0);
        const double theta = M_PI * i / rings, phi = 2 * M_PI * (j % sectors) / sectors;
        return glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    };
    Soup soup;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            if (i > 0) soup.triangle(point(i, j), point(i, j + 1), point(i + 1, j));
            if (i + 1 < rings) soup.triangle(point(i, j + 1), point(i + 1, j + 1), point(i + 1, j));
        }
    return soup;
}

TEST(Surfaces, AWallOf200TrianglesWithAWindowIsOne) {
    Soup soup;
    for (int i = 0; i < 12; ++i) // 12 x 10 squares less 4 x 5: 100 squares
        for (int j = 0; j < 10; ++j)
            if (i < 4 || i >= 8 || j < 2 || j >= 7)
                soup.quad({i * 0.3, j * 0.3, 1}, {i * 0.3 + 0.3, j * 0.3, 1}, {i * 0.3 + 0.3, j * 0.3 + 0.3, 1},
                          {i * 0.3, j * 0.3 + 0.3, 1});
    ASSERT_EQ(soup.triangles.size(), 200u);
    const Geometry geometry = make(soup);
    ASSERT_EQ(geometry.surfaces.size(), 1u);
    EXPECT_TRUE(geometry.surfaces[0].planar);
    EXPECT_EQ(geometry.triangles.size(), 200u);
    EXPECT_EQ(geometry.vertices.size(),
              13u * 11u - 3u * 4u); // grid points less those inside the window: shared, not one a corner
}

TEST(Surfaces, AnLIsOneAndACornerOfTwoWallsIsTwo) {
    Soup l;
    l.quad({0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0});
    l.triangle({0, 1, 0}, {2, 1, 0}, {1, 2, 0});
    EXPECT_EQ(make(l).surfaces.size(), 1u);
    Soup corner;
    corner.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    corner.quad({1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0});
    EXPECT_EQ(make(corner).surfaces.size(), 2u);
}

TEST(Surfaces, WallsOfTwoObjectsStayTwo) {
    Soup soup;
    soup.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 0);
    soup.quad({1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, 1);
    std::vector<std::string> warnings;
    EXPECT_EQ(make_geometry(soup, {{"a", MaterialIndex{0}}, {"b", MaterialIndex{0}}}, warnings).surfaces.size(), 2u);
}

TEST(Surfaces, TwoSidesOfASheetStayTwo) {
    Soup soup;
    soup.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    soup.quad({0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0});
    EXPECT_EQ(make(soup).surfaces.size(), 2u);
}

TEST(Surfaces, NeighboursMayDisagreeByRounding) { // corners off by 1e-7 of the size still meet; off by 1e-3 they do not
    for (const double gap : {1e-7, 1e-3}) {
        Soup soup;
        soup.quad({0, 0, 0}, {5, 0, 0}, {5, 8, 0}, {0, 8, 0});
        soup.quad({5 + 10 * gap, 0, 0}, {6, 0, 0}, {6, 8, 0}, {5 + 10 * gap, 8, 0});
        EXPECT_EQ(make(soup).surfaces.size(), gap < 1e-6 ? 1u : 2u);
    }
}

TEST(Surfaces, FlatBoxIsSixAndSmoothBoxIsOne) {
    const Geometry flat = make(box());
    EXPECT_EQ(flat.surfaces.size(), 6u);
    EXPECT_EQ(flat.vertices.size(), 24u);
    for (const Vertex& vertex : flat.vertices) EXPECT_EQ(vertex.normal, glm::vec3(0));
    const Geometry smooth = make(box(true));
    ASSERT_EQ(smooth.surfaces.size(), 6u); // its normals agree, but at 90 degrees an edge is an edge
    Soup written = box();                  // a file that writes down the flat normals
    for (std::size_t i = 0; i < written.triangles.size(); ++i) {
        const glm::uvec3& t = written.triangles[i];
        const glm::vec3 n = glm::normalize(glm::cross(written.vertices[t.y].position - written.vertices[t.x].position,
                                                      written.vertices[t.z].position - written.vertices[t.x].position));
        for (int k = 0; k < 3; ++k) written.vertices[t[k]].normal = n;
    }
    const Geometry same = make(written);
    EXPECT_EQ(same.surfaces, flat.surfaces);
    EXPECT_EQ(same.vertices, flat.vertices);
}

TEST(Surfaces, ASmoothSphereIsOneCurvedSurface) {
    Soup soup = sphere(16, 32);
    EXPECT_EQ(make(soup).surfaces.size(),
              14u * 32u + 2u * 32u); // facets: planar quads between the rings, triangles at the poles
    soup.with_normals_from(glm::dvec3(0));
    const Geometry geometry = make(soup);
    ASSERT_EQ(geometry.surfaces.size(), 1u);
    EXPECT_FALSE(geometry.surfaces[0].planar);
    EXPECT_EQ(geometry.vertices.size(), 15u * 32u + 2u);
    for (const Vertex& vertex : geometry.vertices) EXPECT_NEAR(glm::length(vertex.normal), 1, 1e-6);
}

TEST(Surfaces, AFinelyCutCylinderDoesNotCreepIntoAPlane) { // 0.1 degrees a step: each neighbour alone would pass
    Soup soup;
    const int steps = 3600;
    for (int i = 0; i < steps; ++i) {
        const double a = 2 * M_PI * i / steps, b = 2 * M_PI * (i + 1) / steps;
        soup.quad({std::cos(a), 0, std::sin(a)}, {std::cos(a), 1, std::sin(a)}, {std::cos(b), 1, std::sin(b)},
                  {std::cos(b), 0, std::sin(b)});
    }
    EXPECT_GT(make(soup).surfaces.size(), 500u);
}

TEST(Surfaces, DegenerateTrianglesAreLeftOutAndTold) {
    Soup soup;
    soup.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    soup.triangle({0, 0, 0}, {1, 0, 0}, {1, 0, 0});      // two corners in one
    soup.triangle({0, 0, 0}, {0.5, 0, 0}, {1, 0, 0});    // on a line
    soup.triangle({0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}); // thinner than 1e-7
    soup.triangle({0, 0, 0}, {1, 0, 0}, {0.5, NAN, 0});
    soup.triangle({0, 0, 0}, {1, 0, 0}, {0.5, INFINITY, 0});
    std::vector<std::string> warnings;
    const Geometry geometry = make_geometry(soup, one_object, warnings);
    EXPECT_EQ(geometry.triangles.size(), 2u);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_THAT(warnings[0], testing::HasSubstr("object \"thing\": 3 degenerate triangles"));
    EXPECT_THAT(warnings[1], testing::HasSubstr("object \"thing\": 2 triangles left out"));
}

TEST(Surfaces, NothingAtAll) {
    std::vector<std::string> warnings;
    const Geometry geometry = make_geometry({}, {}, warnings);
    EXPECT_TRUE(geometry.triangles.empty());
    EXPECT_TRUE(geometry.surfaces.empty());
}

TEST(Surfaces, TheOrderOfTrianglesDoesNotMatter) { // the same sets of triangles, whatever order they come in
    Soup soup = sphere(8, 12);
    soup.with_normals_from(glm::dvec3(0));
    const Soup cube = box();
    for (const glm::uvec3& t : cube.triangles)
        soup.triangle(glm::dvec3(cube.vertices[t.x].position) + 5.0, glm::dvec3(cube.vertices[t.y].position) + 5.0,
                      glm::dvec3(cube.vertices[t.z].position) + 5.0);
    std::vector<std::size_t> order(soup.triangles.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto partition = [&] {
        Soup shuffled = soup;
        for (std::size_t i = 0; i < order.size(); ++i) shuffled.triangles[i] = soup.triangles[order[i]];
        const Geometry geometry = make(shuffled);
        std::map<std::size_t, std::set<std::size_t>> sets;
        for (std::size_t i = 0; i < order.size(); ++i) sets[at(geometry.triangle_surface[i])].insert(order[i]);
        std::set<std::set<std::size_t>> result;
        for (const auto& [surface, set] : sets) result.insert(set);
        return result;
    };
    const auto expected = partition();
    EXPECT_EQ(expected.size(), 7u);
    std::mt19937 random(3);
    for (int round = 0; round < 10; ++round) {
        std::shuffle(order.begin(), order.end(), random);
        EXPECT_EQ(partition(), expected);
    }
}

// Rotated and moved grids of one plane, far from the origin, stay one surface in single precision.
TEST(Surfaces, AnyPlaneInSpace) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    for (int round = 0; round < 20; ++round) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        const glm::dvec3 u = glm::normalize(glm::cross(n, glm::dvec3(0.2, 0.9, 0.4))), v = glm::cross(n, u),
                         origin = 4.0 * glm::dvec3(normal(random), normal(random), normal(random));
        Soup soup;
        const auto point = [&](int i, int j) { return origin + u * (i * 0.1) + v * (j * 0.1); };
        for (int i = 0; i < 20; ++i)
            for (int j = 0; j < 20; ++j) soup.quad(point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
        EXPECT_EQ(make(soup).surfaces.size(), 1u);
    }
}

} // namespace
} // namespace lueur
