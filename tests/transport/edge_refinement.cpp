// Where all that is bent would take more room than there is.
#include <gtest/gtest.h>

#include "core/transport/edge_refinement.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

// A step across a floor of noise that bends a little everywhere: the shortest edge that crosses the step, m.
float finest_edge_at_the_step(Room room) {
    const Scene scene = test::small_room();
    Mesh mesh = make_mesh(scene, {0.12});
    const std::uint32_t most = mesh.coarse_vertex_count + 800;
    EdgeRefinement edges(mesh, room);
    const auto crosses = [&](const EdgeRefinement::Edge& edge) {
        const glm::vec3 a = mesh.vertices[edge.a].position, b = mesh.vertices[edge.b].position;
        return a.y < 0.01f && b.y < 0.01f && (a.x < 0.111f) != (b.x < 0.111f);
    };
    float finest = 1e30f;
    EdgeRefinement::Level level;
    level.collect = [&] {
        return edges.collect(
            0.01f, [](std::uint32_t, std::uint32_t) { return true; }, test::never);
    };
    level.look = [] { return true; };
    level.bent = [&] {
        std::vector<float> bent;
        for (const EdgeRefinement::Edge& edge : edges.edges()) {
            bent.push_back(crosses(edge) ? 0.5f : 0.01f);
            if (crosses(edge))
                finest =
                    std::min(finest, glm::distance(mesh.vertices[edge.a].position, mesh.vertices[edge.b].position));
        }
        return bent;
    };
    level.split = [&] { edges.split(most); };
    for (std::size_t before = 0; before != mesh.vertices.size();) {
        before = mesh.vertices.size();
        while (!edges.step(level, test::never)) {
        }
    }
    EXPECT_GE(mesh.vertices.size(), most - 100);
    EXPECT_LE(mesh.vertices.size(), most + 10);
    return finest;
}

} // namespace

TEST(EdgeRefinement, KeepsRoomForFinerLevelsOfWhatIsWorthMost) {
    EXPECT_LT(finest_edge_at_the_step(Room::for_finer_levels), 0.5f * finest_edge_at_the_step(Room::as_far_as_it_goes));
}
