// Where all that is bent would take more room than there is.
#include <gtest/gtest.h>

#include "core/transport/edge_refinement.h"
#include "core/transport/sampling.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

struct RefinedFloor {
    std::vector<glm::vec3> vertices;
    float finest_at_the_step = 1e30f; // m, the shortest edge that crosses it
    std::size_t looks = 0;
};

// A step across a floor of noise that bends a little everywhere, by chance up to `noise`.
RefinedFloor refined_floor(Room room, float noise, float largest_bend) {
    const Scene scene = test::small_room();
    Mesh mesh = make_mesh(scene, {0.12});
    const std::uint32_t most = mesh.coarse_vertex_count + 800;
    EdgeRefinement edges(mesh, most, room);
    RefinedFloor refined;
    const auto crosses = [&](const EdgeRefinement::Edge& edge) {
        const glm::vec3 a = mesh.vertices[edge.a].position, b = mesh.vertices[edge.b].position;
        return a.y < 0.01f && b.y < 0.01f && (a.x < 0.111f) != (b.x < 0.111f);
    };
    EdgeRefinement::Level level;
    level.largest_bend = largest_bend;
    level.collect = [&] {
        return edges.collect(
            0.01f, [](std::uint32_t, std::uint32_t) { return true; }, test::never);
    };
    level.look = [] { return true; };
    level.bent = [&] {
        std::vector<float> bent;
        for (const EdgeRefinement::Edge& edge : edges.edges()) {
            bent.push_back(!edges.is_asked(edge) ? 0
                           : crosses(edge)       ? 0.5f
                                                 : std::max(0.01f, noise * unit_float(hash(edge.a, edge.b))));
            refined.looks += edges.is_asked(edge);
            if (edges.is_asked(edge) && crosses(edge))
                refined.finest_at_the_step =
                    std::min(refined.finest_at_the_step,
                             glm::distance(mesh.vertices[edge.a].position, mesh.vertices[edge.b].position));
        }
        return bent;
    };
    level.split = [&] { edges.split(); };
    for (std::size_t before = 0; before != mesh.vertices.size();) {
        before = mesh.vertices.size();
        while (!edges.step(level, test::never)) {
        }
    }
    EXPECT_GE(mesh.vertices.size(), most - 100);
    EXPECT_LE(mesh.vertices.size(), most + 10);
    for (const MeshVertex& v : mesh.vertices) refined.vertices.push_back(v.position);
    return refined;
}

constexpr float any_bend = std::numeric_limits<float>::infinity();

} // namespace

TEST(EdgeRefinement, KeepsRoomForFinerLevelsOfWhatIsWorthMost) {
    EXPECT_LT(refined_floor(Room::for_finer_levels, 0, any_bend).finest_at_the_step,
              0.5f * refined_floor(Room::as_far_as_it_goes, 0, any_bend).finest_at_the_step);
}

TEST(EdgeRefinement, AsksOnlyWhatCanBeWorthIt) {
    const RefinedFloor all = refined_floor(Room::for_finer_levels, 0.5f, any_bend),
                       few = refined_floor(Room::for_finer_levels, 0.5f, 0.5f);
    EXPECT_EQ(few.vertices, all.vertices);
    EXPECT_LT(few.looks, 3 * all.looks / 4);
}
