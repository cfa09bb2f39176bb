#include "core/transport/triangle_grid.h"

#include <gtest/gtest.h>

#include "core/transport/sampling.h"
#include "tests/support/scenes.h"

using namespace lueur;

// What the grid finds is what the tree finds: the same place, in the same element but for rounding at its rim.
TEST(TriangleGrid, FindsThePlaceTheTreeFinds) {
    test::SceneBuilder b;
    const MaterialIndex grey = b.material("grey", 0.5);
    b.polygon("wall", grey, {{0, 0, 0}, {3, 0, 0}, {3, 2, 0.5f}, {0.4f, 2.2f, 0.6f}});
    b.polygon("small", grey, {{0, 0, 1}, {0.1f, 0, 1}, {0, 0.1f, 1}});
    const Mesh mesh = make_mesh(b.build(), {0.15});
    ASSERT_TRUE(mesh.triangles);
    const TriangleGrid grid(mesh.triangles);
    const auto position = [&](std::uint32_t element, float b1, float b2) {
        const glm::uvec3 v = mesh.nodes[element].vertices;
        return (1 - b1 - b2) * mesh.vertices[v.x].position + b1 * mesh.vertices[v.y].position +
               b2 * mesh.vertices[v.z].position;
    };
    int other = 0;
    const std::uint32_t places = 3000;
    for (std::uint32_t t = 0; t < mesh.triangles->count; ++t)
        for (std::uint32_t k = 0; k < places; ++k) {
            glm::vec2 u = triangle_point(r2_point(k, {0.2f, 0.4f}));
            if (k % 10 == 0) u.x = 0; // on the rim
            float b1 = u.x, b2 = u.y, c1 = u.x, c2 = u.y;
            const std::uint32_t by_tree = coarse_element_at(*mesh.triangles, t, b1, b2),
                                by_grid = grid.element_at(t, c1, c2);
            other += by_tree != by_grid;
            ASSERT_LT(glm::distance(position(by_tree, b1, b2), position(by_grid, c1, c2)), 1e-5f);
            ASSERT_GE(std::min({c1, c2, 1 - c1 - c2}), -1e-6f);
        }
    EXPECT_LT(other, 30);
}
