// Few places where light is computed, and what the others make of it.
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "core/transport/direct_transport.h"
#include "core/transport/light_samples.h"
#include "core/transport/receivers.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

constexpr std::uint32_t no_limit = 1000000;

// A sphere of so many segments in a room, its normals smooth, with one large lamp above it.
Scene sphere_in_a_room(int segments) {
    test::SceneBuilder b;
    const MaterialIndex grey = b.material("grey", 0.5);
    b.room("room", test::all(grey), glm::vec3(-2), glm::vec3(2));
    const ObjectIndex lamp = b.polygon("lamp", grey, {{-1, 1.99f, -1}, {1, 1.99f, -1}, {1, 1.99f, 1}, {-1, 1.99f, 1}});
    const auto on_sphere = [&](int i, int k) {
        const float u = 2 * std::numbers::pi_v<float> * float(i) / float(segments),
                    v = std::numbers::pi_v<float> * (float(k) / float(segments) - 0.5f);
        return 0.5f * glm::vec3(std::cos(v) * std::cos(u), std::sin(v), -std::cos(v) * std::sin(u));
    };
    for (int k = 0; k < segments; ++k)
        for (int i = 0; i < segments; ++i) {
            const glm::vec3 p[4] = {on_sphere(i, k), on_sphere(i + 1, k), on_sphere(i + 1, k + 1), on_sphere(i, k + 1)};
            if (k > 0) b.smooth_triangle("sphere", grey, {p[0], p[1], p[2]});
            if (k < segments - 1) b.smooth_triangle("sphere", grey, {p[0], p[2], p[3]});
        }
    b.light("lamp", {lamp}, PowerUnit::exitance, 1);
    return b.build();
}

struct Sampled {
    Scene scene;
    Mesh mesh;
    World world;
    std::vector<glm::vec3> origins;
    explicit Sampled(Scene from, double size)
        : scene(std::move(from))
        , mesh(make_mesh(scene, {size}))
        , world(mesh)
        , origins(ray_origins(mesh, world.epsilon())) {}
    LightSamples samples(float cell, std::uint32_t most = no_limit) const {
        return make_light_samples(scene, mesh, world, origins, cell, most);
    }
};

} // namespace

TEST(LightSamples, StandForCloseVerticesThatLookTheSameWay) {
    const Sampled room(test::small_room(), 0.25);
    const LightSamples samples = room.samples(0.4f);
    EXPECT_LT(samples.count(), room.mesh.coarse_vertex_count / 2);
    for (std::uint32_t v = 0; v < room.mesh.coarse_vertex_count; ++v) {
        const std::uint32_t w = samples.vertex[samples.of_vertex[v]];
        ASSERT_EQ(samples.of_vertex[w], samples.of_vertex[v]);
        EXPECT_LT(glm::distance(room.mesh.vertices[v].position, room.mesh.vertices[w].position), 0.4f * 1.74f);
        EXPECT_GT(glm::dot(room.mesh.vertices[v].normal, room.mesh.vertices[w].normal), 0.7f);
        EXPECT_EQ(room.scene.geometry->surfaces[room.mesh.vertices[v].surface].object,
                  room.scene.geometry->surfaces[room.mesh.vertices[w].surface].object);
        float sum = 0;
        for (const auto& r : samples.readings_of(v)) {
            EXPECT_GE(r.weight, 0);
            sum += r.weight;
        }
        EXPECT_NEAR(sum, samples.is_sample(v) ? 0 : 1, 1e-5);
    }
    // Small cells: each its own, and nothing is read.
    const LightSamples all = room.samples(1e-4f);
    EXPECT_EQ(all.count(), room.mesh.coarse_vertex_count);
    EXPECT_TRUE(all.readings.empty());
}

TEST(LightSamples, AreNoMoreThanAskedFor) {
    const Sampled room(test::small_room(), 0.2);
    const LightSamples samples = room.samples(0.01f, 300);
    EXPECT_LE(samples.count(), 300u);
    EXPECT_GT(samples.count(), 100u);
    EXPECT_GT(samples.cell, 0.01f);
}

// What arrives at a small thing under a wide lamp is nearly linear in the normal: a sphere is read to a few per cent
// from few samples, however finely it is cut.
TEST(LightSamples, OfASphereDoNotGrowWithItsTriangles) {
    std::uint32_t count[2];
    for (const int fine : {0, 1}) {
        Sampled s(sphere_in_a_room(fine ? 64 : 32), 0.6);
        const LightSamples samples = s.samples(0.3f);
        DirectTransport at_samples(s.world, s.mesh, make_emitters(s.scene), {}, samples),
            everywhere(s.world, s.mesh, make_emitters(s.scene), {});
        while (!at_samples.light_vertices(test::never)) {
        }
        while (!everywhere.light_vertices(test::never)) {
        }
        double square = 0, all = 0;
        std::set<std::uint32_t> groups;
        for (std::uint32_t v = 0; v < s.mesh.coarse_vertex_count; ++v) {
            if (s.scene.geometry->surfaces[s.mesh.vertices[v].surface].planar) continue;
            groups.insert(samples.of_vertex[v]);
            const double truth = double(everywhere.guessed_light()[v]);
            square += std::pow(double(at_samples.guessed_light()[v]) - truth, 2), all += truth * truth;
        }
        count[fine] = static_cast<std::uint32_t>(groups.size());
        EXPECT_LT(std::sqrt(square / all), 0.06);
    }
    EXPECT_LT(count[1], 1.3 * count[0]);
    EXPECT_LT(count[1], 300u);
}
