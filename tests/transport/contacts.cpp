// Receivers of indirect light at contacts.
#include <cmath>

#include <gtest/gtest.h>

#include "core/transport/gather_rows.h"
#include "core/transport/indirect_refinement.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

const glm::vec3 block_low(1, 0, 1), block_high(1.6f, 0.6f, 1.6f);

Scene room_with_a_block(bool lit) {
    test::SceneBuilder b;
    const MaterialIndex white = b.material("white", 0.7);
    b.room("room", test::all(white), {0, 0, 0}, {4, 2.5f, 4});
    b.block("block", white, block_low, block_high);
    const ObjectIndex lamp =
        b.polygon("lamp", white, {{2.5f, 2.4f, 2.5f}, {3.1f, 2.4f, 2.5f}, {3.1f, 2.4f, 3.1f}, {2.5f, 2.4f, 3.1f}});
    if (lit) b.light("lamp", {lamp}, PowerUnit::lumen, 1000);
    return b.build();
}

struct Refined {
    Mesh mesh;
    std::vector<std::uint8_t> buried;
    std::uint32_t coarse_vertices = 0;
};

Refined refine(const Scene& scene, std::uint32_t more, double element_size = 0.3) {
    Refined r{make_mesh(scene, {element_size}), {}, 0};
    const World world(r.mesh);
    r.coarse_vertices = r.mesh.coarse_vertex_count;
    r.buried.assign(r.coarse_vertices, 0);
    Surroundings around;
    around.distance.assign(r.coarse_vertices, 0);
    around.lit = around.back = around.near = r.buried;
    find_buried(world, r.mesh, ray_origins(r.mesh, world.epsilon()), 0, 0, r.coarse_vertices, r.buried, &around);
    DirectTransport direct(world, r.mesh, make_emitters(scene), {0.05f, 0.03f, 0.3f, 100000});
    while (!direct.light_vertices(test::never)) {
    }
    IndirectRefinement refinement(world, r.mesh, direct, r.buried, around.distance,
                                  {0.04f, 0.09f, 0.03f, r.coarse_vertices + more});
    while (!refinement.step(test::never)) {
    }
    r.buried = refinement.buried();
    EXPECT_EQ(refinement.origins().size(), r.mesh.vertices.size());
    return r;
}

float distance_to_foot(glm::vec3 p) { // of the block, on the floor
    const glm::vec2 low(block_low.x, block_low.z), high(block_high.x, block_high.z), q(p.x, p.z);
    const glm::vec2 outside = glm::max(glm::max(low - q, q - high), glm::vec2(0));
    const glm::vec2 inside = glm::min(q - low, high - q);
    return glm::length(outside) > 0 ? glm::length(outside) : std::max(0.0f, std::min(inside.x, inside.y));
}

} // namespace

TEST(IndirectRefinement, PutsReceiversAtContacts) {
    const Refined r = refine(room_with_a_block(true), 100000);
    const auto count = static_cast<std::uint32_t>(r.mesh.vertices.size());
    ASSERT_GT(count, r.coarse_vertices + 50);
    EXPECT_LT(count, 3 * r.coarse_vertices);
    ASSERT_EQ(r.buried.size(), count);
    int at_the_foot = 0, on_the_open_floor = 0, on_the_ceiling = 0;
    for (std::uint32_t v = r.coarse_vertices; v < count; ++v) {
        const glm::vec3 p = r.mesh.vertices[v].position;
        if (p.y > 1e-3f && p.y < 2.4f) continue;
        const bool by_a_wall = p.x < 0.5f || p.z < 0.5f || p.x > 3.5f || p.z > 3.5f;
        if (p.y > 2.4f) {
            if (!by_a_wall && glm::distance(p, glm::vec3(2.8f, 2.5f, 2.8f)) > 0.9f) ++on_the_ceiling;
        } else if (distance_to_foot(p) < 0.31f)
            ++at_the_foot;
        else if (!by_a_wall)
            ++on_the_open_floor;
        // What lies well inside the block's foot is buried, what lies well outside is not.
        if (p.y > 1e-3f || distance_to_foot(p) < 0.02f) continue;
        const bool under = p.x > block_low.x && p.x < block_high.x && p.z > block_low.z && p.z < block_high.z;
        EXPECT_EQ(r.buried[v] != 0, under) << p.x << " " << p.z;
    }
    EXPECT_GT(at_the_foot, 10);
    EXPECT_EQ(on_the_open_floor, 0);
    EXPECT_EQ(on_the_ceiling, 0);
}

TEST(IndirectRefinement, KeepsItsLimitAndNeedsLight) {
    const Refined few = refine(room_with_a_block(true), 40);
    EXPECT_GT(few.mesh.vertices.size(), few.coarse_vertices);
    EXPECT_LE(few.mesh.vertices.size(), few.coarse_vertices + 60u); // the last split may ask for neighbours
    const Refined dark = refine(room_with_a_block(false), 100000);
    EXPECT_EQ(dark.mesh.vertices.size(), dark.coarse_vertices);
}

// A picture frame sunk into the wall it hangs on: the four corners of the upper bar's lower side lie in the wall and in
// the side bars, and all that lies between them is seen.
TEST(IndirectRefinement, AFaceWhoseCornersAreAllBuriedIsCutWhereItIsSeen) {
    test::SceneBuilder b;
    const MaterialIndex white = b.material("white", 0.7);
    b.room("room", test::all(white), {0, 0, 0}, {4, 2.5f, 4});
    const float sunk = -0.002f, front = 0.03f;
    b.block("frame", white, {1.5f, 1.975f, sunk}, {2.5f, 2, front});
    b.block("frame", white, {1.5f, 1, sunk}, {1.525f, 2, front});
    b.block("frame", white, {2.475f, 1, sunk}, {2.5f, 2, front});
    const ObjectIndex lamp =
        b.polygon("lamp", white, {{1.5f, 2.4f, 2.5f}, {2.5f, 2.4f, 2.5f}, {2.5f, 2.4f, 3.5f}, {1.5f, 2.4f, 3.5f}});
    b.light("lamp", {lamp}, PowerUnit::lumen, 1000);
    const Refined r = refine(b.build(), 2000, 1.2);
    int corners = 0, seen = 0;
    for (std::uint32_t v = 0; v < r.mesh.vertices.size(); ++v) {
        const MeshVertex& vertex = r.mesh.vertices[v];
        if (vertex.normal.y > -0.9f || std::abs(vertex.position.y - 1.975f) > 1e-4f) continue;
        if (v < r.coarse_vertices) {
            ++corners;
            EXPECT_TRUE(r.buried[v]);
        } else if (!r.buried[v]) {
            ++seen;
            EXPECT_GT(vertex.position.z, 0);
        }
    }
    EXPECT_EQ(corners, 4);
    EXPECT_GT(seen, 0);
}
