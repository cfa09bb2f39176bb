// The mesh covers the scene exactly, stays conforming, and fine vertices are midpoints of their parents.
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/transport/bisection.h"
#include "core/transport/mesh.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

double area_of(const Mesh& mesh) {
    double sum = 0;
    for (const float a : vertex_areas(mesh)) sum += a;
    return sum;
}

// Every edge inside a surface belongs to exactly two elements: no T-vertex. Edges on its border belong to one.
void expect_conforming(const Mesh& mesh, double border_length) {
    std::map<std::uint64_t, int> count;
    for (const glm::uvec3& e : mesh.elements)
        for (int k = 0; k < 3; ++k) ++count[Bisection::edge_key(e[k], e[(k + 1) % 3])];
    double border = 0;
    for (const auto& [key, n] : count) {
        EXPECT_LE(n, 2);
        if (n == 1)
            border += glm::distance(mesh.vertices[key >> 32].position, mesh.vertices[key & 0xffffffffu].position);
    }
    EXPECT_NEAR(border, border_length, 1e-3); // a T-vertex would add the edges beside it
}

} // namespace

TEST(Mesh, UnitCubeKeepsItsAreaAndHasNoTVertices) {
    for (const double size : {2.0, 0.5, 0.11}) {
        const Mesh mesh = make_mesh(test::furnace(0.5), {size});
        EXPECT_NEAR(area_of(mesh), 6, 1e-4);
        expect_conforming(mesh, 24);
        for (const glm::uvec3& e : mesh.elements)
            for (int k = 0; k < 3; ++k)
                EXPECT_LE(glm::distance(mesh.vertices[e[k]].position, mesh.vertices[e[(k + 1) % 3]].position),
                          size + 1e-5);
    }
}

TEST(Mesh, RefiningOneCornerStaysConforming) {
    Mesh mesh = make_mesh(test::furnace(0.5), {0.5});
    Bisection bisection(mesh);
    for (int round = 0; round < 12; ++round) { // always the leaf at the first vertex
        list_leaves(mesh);
        std::uint32_t leaf = no_index;
        for (std::uint32_t n = 0; n < mesh.nodes.size() && leaf == no_index; ++n) {
            const glm::uvec3 v = mesh.nodes[n].vertices;
            if (mesh.nodes[n].children == no_index && (v.x == 0 || v.y == 0 || v.z == 0)) leaf = n;
        }
        ASSERT_NE(leaf, no_index);
        bisection.split(leaf);
    }
    list_leaves(mesh);
    EXPECT_NEAR(area_of(mesh), 6, 1e-4);
    expect_conforming(mesh, 24);
    for (std::uint32_t v = mesh.coarse_vertex_count; v < mesh.vertices.size(); ++v) {
        const auto& p = mesh.vertices[v].parents;
        ASSERT_LT(p[0], v);
        ASSERT_LT(p[1], v);
        const glm::vec3 middle = 0.5f * (mesh.vertices[p[0]].position + mesh.vertices[p[1]].position);
        EXPECT_LT(glm::distance(middle, mesh.vertices[v].position), 1e-6);
    }
    // Locating a point of a coarse element gives the point back.
    for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e)
        for (const auto& [b1, b2] : {std::pair{0.2f, 0.3f}, {0.9f, 0.05f}, {0.01f, 0.98f}, {1.0f / 3, 1.0f / 3}}) {
            const glm::uvec3 v = mesh.nodes[e].vertices;
            const glm::vec3 p = (1 - b1 - b2) * mesh.vertices[v.x].position + b1 * mesh.vertices[v.y].position +
                                b2 * mesh.vertices[v.z].position;
            const Located found = locate(mesh, e, b1, b2);
            glm::vec3 q(0);
            for (int k = 0; k < 3; ++k) {
                q += found.weights[k] * mesh.vertices[found.vertices[k]].position;
                EXPECT_GE(found.weights[k], -1e-6f);
            }
            EXPECT_LT(glm::distance(p, q), 1e-5);
        }
}

TEST(Mesh, TwoSidedSurfacesHaveTwins) {
    test::SceneBuilder b;
    b.polygon("sheet", b.material("paper", 0.5, true), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const Mesh mesh = make_mesh(b.build(), {0.4});
    EXPECT_NEAR(area_of(mesh), 2, 1e-5);
    for (std::uint32_t e = 0; e < mesh.coarse_element_count; ++e) {
        const std::uint32_t twin = mesh.coarse_twin[e];
        ASSERT_NE(twin, no_index);
        EXPECT_EQ(mesh.coarse_twin[twin], e);
        EXPECT_NE(mesh.coarse_back[e], mesh.coarse_back[twin]);
        const glm::uvec3 v = mesh.nodes[e].vertices, w = mesh.nodes[twin].vertices;
        EXPECT_EQ(mesh.vertices[v.y].position, mesh.vertices[w.z].position);
        EXPECT_EQ(mesh.vertices[v.x].normal, -mesh.vertices[w.x].normal);
    }
}

TEST(Mesh, EmptySceneGivesAnEmptyMesh) {
    const Mesh mesh = make_mesh(Scene{}, {});
    EXPECT_TRUE(mesh.elements.empty());
    EXPECT_EQ(mesh.coarse_vertex_count, 0u);
}
