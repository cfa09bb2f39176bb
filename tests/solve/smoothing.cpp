#include "core/solve/smoothing.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/transport/sampling.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

Mesh cube() {
    return make_mesh(test::furnace(0.5), {0.12});
}

} // namespace

// A field that is linear on every wall stays what it is, at the rims too; noise that differs from vertex to vertex goes
// down as the number of neighbours says.
TEST(Smoothing, KeepsPlanesAndTakesNoiseAway) {
    const Mesh mesh = cube();
    const std::uint32_t count = mesh.coarse_vertex_count;
    const std::vector<std::uint8_t> buried(count, 0);
    const std::vector<float> distance(count, 0.6f);
    const Smoothing smoothing = make_smoothing(mesh, mesh.indirect_elements, buried, distance, 0.5f, 1);
    ChannelField field(count, 3);
    std::vector<float> noise;
    for (std::uint32_t v = 0; v < count; ++v) {
        const glm::vec3 p = mesh.vertices[v].position;
        for (int c = 0; c < 3; ++c) field[v][c] = 5 + p[c] - 0.7f * p[(c + 1) % 3];
        noise.push_back(unit_float(hash(7, v)) - 0.5f);
    }
    const ChannelField before = field;
    smooth(smoothing, field);
    for (std::uint32_t v = 0; v < count; ++v)
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(field[v][c], before[v][c], 1e-4);
    double square = 0, left = 0;
    for (const float n : noise) square += double(n) * n;
    smooth(smoothing, noise);
    for (const float n : noise) left += double(n) * n;
    EXPECT_LT(left, 0.4 * square);
}

TEST(Smoothing, ReadsNoBuriedVertexAndNoneFurtherThanWhatIsAround) {
    const Mesh mesh = cube();
    const std::uint32_t count = mesh.coarse_vertex_count;
    std::vector<std::uint8_t> buried(count, 0);
    for (std::uint32_t v = 0; v < count; v += 3) buried[v] = 1;
    std::vector<float> distance(count, 0.6f);
    for (std::uint32_t v = 0; v < count; v += 5) distance[v] = 0.01f; // in a corner
    const Smoothing smoothing = make_smoothing(mesh, mesh.indirect_elements, buried, distance, 0.5f, 1);
    std::vector<float> values(count, 1);
    for (std::uint32_t v = 0; v < count; ++v)
        if (buried[v] || distance[v] < 0.1f) values[v] = 1000;
    const std::vector<float> before = values;
    smooth(smoothing, values);
    for (std::uint32_t v = 0; v < count; ++v) EXPECT_NEAR(values[v], before[v], 1e-3);
    EXPECT_FALSE(smoothing.empty());
    EXPECT_GT(smoothing_reach(32), smoothing_reach(512));
}
