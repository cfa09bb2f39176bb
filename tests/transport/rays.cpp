// Rows, direct light and hits against what geometry says.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/transport/direct_light.h"
#include "core/transport/gather_rows.h"
#include "core/transport/polygon_form_factor.h"
#include "core/transport/sampling.h"
#include "core/transport/world.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

// Each vertex its own receiver.
Receivers every_vertex(const Mesh& mesh, const std::vector<std::uint8_t>& buried) {
    Receivers receivers;
    for (std::uint32_t v = 0; v < mesh.coarse_vertex_count; ++v) {
        receivers.of_vertex.push_back(v);
        receivers.vertex.push_back(v);
    }
    receivers.buried = buried;
    return receivers;
}

} // namespace

TEST(World, HitsTheLitSideAndTellsBackFaces) {
    const Mesh mesh = make_mesh(test::furnace(0.5), {0.6});
    const World world(mesh);
    const Hit inside = world.closest({{0.5f, 0.5f, 0.5f}, {0, -1, 0}});
    ASSERT_NE(inside.element, no_index);
    EXPECT_NEAR(inside.t, 0.5, 1e-6);
    EXPECT_FALSE(inside.back_face);
    const Hit outside = world.closest({{0.5f, -3, 0.5f}, {0, 1, 0}});
    EXPECT_TRUE(outside.back_face);
    EXPECT_EQ(outside.element, no_index);
    EXPECT_FALSE(world.closest({{5, 5, 5}, {0, 1, 0}}).any());
    // Barycentric weights give the hit point back.
    const glm::uvec3 v = mesh.nodes[inside.element].vertices;
    const glm::vec3 p = (1 - inside.b1 - inside.b2) * mesh.vertices[v.x].position +
                        inside.b1 * mesh.vertices[v.y].position + inside.b2 * mesh.vertices[v.z].position;
    EXPECT_LT(glm::distance(p, glm::vec3(0.5f, 0, 0.5f)), 1e-5);
}

TEST(World, TheOtherSideOfASheetIsItsTwin) {
    test::SceneBuilder b;
    b.polygon("sheet", b.material("paper", 0.5, true), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const Mesh mesh = make_mesh(b.build(), {0.4});
    const World world(mesh);
    for (const float side : {1.0f, -1.0f}) {
        const Hit hit = world.closest({{0.3f, 0.6f, side}, {0, 0, -side}});
        ASSERT_NE(hit.element, no_index);
        EXPECT_EQ(mesh.coarse_back[hit.element], side < 0);
        const glm::uvec3 v = mesh.nodes[hit.element].vertices;
        const glm::vec3 p = (1 - hit.b1 - hit.b2) * mesh.vertices[v.x].position + hit.b1 * mesh.vertices[v.y].position +
                            hit.b2 * mesh.vertices[v.z].position;
        EXPECT_LT(glm::distance(p, glm::vec3(0.3f, 0.6f, 0)), 1e-5);
    }
}

TEST(GatherRows, SumToOneInAClosedScene) {
    const Mesh mesh = make_mesh(test::small_room(), {0.3});
    const World world(mesh);
    const auto origins = ray_origins(mesh, world.epsilon());
    std::vector<std::uint8_t> buried(mesh.coarse_vertex_count, 0);
    find_buried(world, mesh, origins, 0, 0, mesh.coarse_vertex_count, buried);
    const Receivers receivers = every_vertex(mesh, buried);
    GatherPass pass = make_gather_pass(mesh, receivers);
    trace_gather_rays(world, mesh, origins, receivers, buried, 1, 0, 0, mesh.coarse_vertex_count, pass);
    int lost = 0;
    for (std::uint32_t i = 0; i < mesh.coarse_vertex_count; ++i)
        if (!buried[i])
            lost += static_cast<int>((1 - row_sum({pass}, i, mesh.coarse_vertex_count)) * rays_per_pass + 0.5);
    // The two lamps show their black backs to a strip of the ceiling; nothing else may be lost.
    EXPECT_LT(double(lost) / (double(mesh.coarse_vertex_count) * rays_per_pass), 0.02);

    const Mesh cube = make_mesh(test::furnace(0.5), {0.15});
    const World closed(cube);
    const auto cube_origins = ray_origins(cube, closed.epsilon());
    std::vector<std::uint8_t> none(cube.coarse_vertex_count, 0);
    const Receivers cube_receivers = every_vertex(cube, none);
    GatherPass rows = make_gather_pass(cube, cube_receivers);
    trace_gather_rays(closed, cube, cube_origins, cube_receivers, none, 7, 3, 0, cube.coarse_vertex_count, rows);
    for (std::uint32_t i = 0; i < cube.coarse_vertex_count; ++i)
        ASSERT_EQ(row_sum({rows}, i, cube.coarse_vertex_count), 1) << "vertex " << i;
}

TEST(GatherRows, AreTheSameWhateverTheChunks) {
    const Mesh mesh = make_mesh(test::small_room(), {0.5});
    const World world(mesh);
    const auto origins = ray_origins(mesh, world.epsilon());
    const std::vector<std::uint8_t> buried(mesh.coarse_vertex_count, 0);
    const Receivers receivers = every_vertex(mesh, buried);
    GatherPass a = make_gather_pass(mesh, receivers), b = a, other = a;
    trace_gather_rays(world, mesh, origins, receivers, buried, 5, 2, 0, mesh.coarse_vertex_count, a);
    for (std::uint32_t i = 0; i < mesh.coarse_vertex_count; ++i)
        trace_gather_rays(world, mesh, origins, receivers, buried, 5, 2, i, i + 1, b);
    trace_gather_rays(world, mesh, origins, receivers, buried, 6, 2, 0, mesh.coarse_vertex_count, other);
    EXPECT_EQ(a.ends, b.ends);
    EXPECT_NE(a.ends, other.ends);
}

// The rows are form factors: from the middle of the cube's floor the share of rays that meets each face is known.
TEST(GatherRows, MeasureFormFactors) {
    const Mesh mesh = make_mesh(test::furnace(0.5), {0.5});
    const World world(mesh);
    std::uint32_t middle = no_index;
    for (std::uint32_t v = 0; v < mesh.coarse_vertex_count; ++v)
        if (glm::distance(mesh.vertices[v].position, glm::vec3(0.5f, 0, 0.5f)) < 1e-5) middle = v;
    ASSERT_NE(middle, no_index);
    const auto origins = ray_origins(mesh, world.epsilon());
    const std::vector<std::uint8_t> buried(mesh.coarse_vertex_count, 0);
    const Receivers receivers = every_vertex(mesh, buried);
    double ceiling = 0;
    const int passes = 64;
    for (int p = 0; p < passes; ++p) {
        GatherPass pass = make_gather_pass(mesh, receivers);
        trace_gather_rays(world, mesh, origins, receivers, buried, 1, p, middle, middle + 1, pass);
        for (int k = 0; k < rays_per_pass; ++k)
            ceiling += mesh.vertices[pass.ends[std::size_t(middle) * rays_per_pass + k]].normal.y < -0.5f;
    }
    ceiling /= passes * rays_per_pass;
    const glm::dvec3 top[4] = {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}};
    const double exact = polygon_form_factor({0.5, 0, 0.5}, {0, 1, 0}, top);
    EXPECT_NEAR(exact, 4 / (2 * std::numbers::pi) * 2 * 0.5 / std::sqrt(1.25) * std::atan(0.5 / std::sqrt(1.25)),
                1e-9); // Howell B-3
    EXPECT_NEAR(ceiling, exact, 3 * std::sqrt(exact * (1 - exact) / (passes * rays_per_pass)));
}

TEST(GatherRows, VerticesInsideASolidAreBuried) {
    const Scene scene = test::small_room();
    const Mesh mesh = make_mesh(scene, {0.2});
    const World world(mesh);
    const auto origins = ray_origins(mesh, world.epsilon());
    std::vector<std::uint8_t> buried(mesh.coarse_vertex_count, 0);
    find_buried(world, mesh, origins, 0, 0, mesh.coarse_vertex_count, buried);
    int inside = 0;
    for (std::uint32_t v = 0; v < mesh.coarse_vertex_count; ++v) {
        const glm::vec3 p = mesh.vertices[v].position;
        if (p.y > 1e-4f || mesh.vertices[v].normal.y < 0.5f) continue; // the floor
        const bool under = p.x > 1.05f && p.x < 1.75f && p.z > 1.55f && p.z < 2.25f;
        const bool clear = p.x < 0.95f || p.x > 1.85f || p.z < 1.45f || p.z > 2.35f;
        if (under) {
            EXPECT_TRUE(buried[v]);
            ++inside;
        }
        EXPECT_FALSE(clear && buried[v]);
    }
    EXPECT_GT(inside, 3);
}

// What was traced before ends where it would if it were traced again; half of the receivers are new.
TEST(GatherRows, KeptHitsEndWhereTracedOnesDo) {
    const Scene scene = test::furnace(0.5);
    const Mesh mesh = make_mesh(scene, {0.3});
    const World world(mesh);
    const std::vector<glm::vec3> origins = ray_origins(mesh, world.epsilon());
    const std::vector<std::uint8_t> none(mesh.vertices.size(), 0);
    const Receivers receivers = make_receivers(scene, mesh, none, 1e-4f);
    const std::uint32_t all = receivers.count(), half = all / 2;
    GatherPass first = make_gather_pass(mesh, receivers, std::vector<RayHit>(std::size_t(half) * rays_per_pass));
    EXPECT_EQ(trace_gather_rays(world, mesh, origins, receivers, none, 3, 1, 0, half, first), half * rays_per_pass);
    GatherPass kept = make_gather_pass(mesh, receivers, std::move(first.hits)),
               fresh = make_gather_pass(mesh, receivers);
    EXPECT_EQ(trace_gather_rays(world, mesh, origins, receivers, none, 3, 1, 0, all, kept),
              (all - half) * rays_per_pass);
    EXPECT_EQ(trace_gather_rays(world, mesh, origins, receivers, none, 3, 1, 0, all, fresh), all * rays_per_pass);
    EXPECT_EQ(kept.ends, fresh.ends);
    EXPECT_EQ(kept.fine_ends, fresh.fine_ends);
}

// Both walls of a tube on opposite sides look the same way, a hand's breadth apart: those inside, beside the lamp, must
// not gather for those outside.
TEST(Receivers, InsideAndOutsideOfATubeAreApart) {
    constexpr float outside = 0.05f, inside = 0.041f, cell = 0.16f; // m: a spot's housing in the gallery
    for (int k = 0; k < 8; ++k) {
        const glm::vec3 at(0.02f * float(k), 0, 0.013f * float(k));
        test::SceneBuilder b;
        const MaterialIndex metal = b.material("metal", 0.03);
        b.block("housing", metal, at - glm::vec3(outside, 0, outside), at + glm::vec3(outside, 0.19f, outside));
        const std::array<glm::vec2, 4> rim{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
        for (std::size_t side = 0; side < 4; ++side) {
            const glm::vec2 p = inside * rim[side], q = inside * rim[(side + 1) % 4];
            const auto corner = [&](glm::vec2 c, float y) { return at + glm::vec3(c.x, y, c.y); };
            b.polygon("housing", metal, {corner(p, 0), corner(q, 0), corner(q, 0.075f), corner(p, 0.075f)});
        }
        const Scene scene = b.build();
        const Mesh mesh = make_mesh(scene, {cell / 0.3});
        const Receivers receivers =
            make_receivers(scene, mesh, std::vector<std::uint8_t>(mesh.coarse_vertex_count, 0), cell);
        std::vector<int> who(receivers.count(), 0);
        int within = 0;
        for (std::uint32_t v = 0; v < mesh.coarse_vertex_count; ++v) {
            const glm::vec3 d = glm::abs(mesh.vertices[v].position - at);
            const bool is_within = std::max(d.x, d.z) < 0.5f * (inside + outside);
            who[receivers.of_vertex[v]] |= is_within ? 1 : 2;
            within += is_within;
        }
        EXPECT_GT(within, 8);
        EXPECT_EQ(std::ranges::count(who, 3), 0) << k;
        EXPECT_LT(receivers.count(), mesh.coarse_vertex_count) << "neighbours still share";
    }
}

// The rays that tell who is buried are rays of the first pass.
TEST(GatherRows, BurialRaysAreTheFirstOnes) {
    const Scene scene = test::furnace(0.5);
    const Mesh mesh = make_mesh(scene, {0.3});
    const World world(mesh);
    const std::vector<glm::vec3> origins = ray_origins(mesh, world.epsilon());
    const std::uint32_t count = mesh.coarse_vertex_count;
    std::vector<std::uint8_t> buried(count, 0);
    Surroundings around{
        buried, buried, buried, std::vector<float>(count), 0, std::vector<RayHit>(std::size_t(count) * burial_rays)};
    find_buried(world, mesh, origins, 3, 0, count, buried, &around);
    const Receivers receivers = make_receivers(scene, mesh, buried, 1e-4f);
    GatherPass kept = make_gather_pass(mesh, receivers, hits_of_burial(receivers, around.hits)),
               fresh = make_gather_pass(mesh, receivers);
    EXPECT_EQ(trace_gather_rays(world, mesh, origins, receivers, buried, 3, 0, 0, receivers.count(), kept),
              receivers.count() * (rays_per_pass - burial_rays));
    EXPECT_EQ(trace_gather_rays(world, mesh, origins, receivers, buried, 3, 0, 0, receivers.count(), fresh),
              receivers.count() * rays_per_pass);
    EXPECT_EQ(kept.ends, fresh.ends);
    EXPECT_EQ(kept.fine_ends, fresh.fine_ends);
}

// Many rays from one place meet what each of them meets alone.
TEST(World, RaysTogetherMeetWhatTheyMeetAlone) {
    const Scene scene = test::furnace(0.5);
    const Mesh mesh = make_mesh(scene, {0.3});
    const World world(mesh);
    const glm::vec3 origin(0.3f, 0.45f, 0.6f);
    std::vector<glm::vec3> directions, targets;
    for (std::uint32_t k = 0; k < 21; ++k) { // no multiple of a packet
        directions.push_back(Frame(glm::vec3(0, k % 2 ? 1 : -1, 0)).world(cosine_direction(r2_point(k, {0.3f, 0.7f}))));
        targets.push_back(origin + (0.2f + 0.1f * float(k)) * directions.back());
    }
    std::vector<Hit> hits(directions.size());
    world.closest(origin, directions, hits);
    for (std::size_t k = 0; k < directions.size(); ++k) {
        const Hit alone = world.closest({origin, directions[k]});
        EXPECT_EQ(hits[k].element, alone.element);
        EXPECT_NEAR(hits[k].t, alone.t, 1e-5);
        EXPECT_NEAR(hits[k].b1, alone.b1, 1e-4);
    }
    const std::span<const glm::vec3> some = std::span(targets).first(World::packet);
    const std::uint32_t hidden = world.hidden(origin, some);
    for (std::size_t k = 0; k < some.size(); ++k) EXPECT_EQ(hidden >> k & 1, !sees(world, origin, some[k])) << k;
}

TEST(DirectLight, WhollySeenIsTheExactFormFactor) {
    const Scene scene = test::furnace(0.5);
    const Mesh mesh = make_mesh(scene, {0.5});
    const World world(mesh);
    const std::vector<Emitter> emitters = make_emitters(scene);
    ASSERT_EQ(emitters.size(), 1u);
    EXPECT_NEAR(emitters[0].area, 6, 1e-5);
    std::uint64_t rays = 0;
    for (const glm::vec3 p : {glm::vec3(0.5f, 1e-5f, 0.5f), {0.02f, 1e-5f, 0.03f}, {0.9f, 1e-5f, 0.1f}})
        EXPECT_NEAR(direct_form_factor(world, emitters[0], p, {0, 1, 0}, VisibilityDetail::two_cuts, rays), 1,
                    1e-5); // all it sees shines
    EXPECT_GT(rays, 0u);
}

TEST(DirectLight, HalfHiddenLampGivesHalf) {
    test::SceneBuilder b;
    const MaterialIndex grey = b.material("grey", 0.5);
    const ObjectIndex lamp =
        b.polygon("lamp", grey, {{-0.5f, 2, -0.5f}, {0.5f, 2, -0.5f}, {0.5f, 2, 0.5f}, {-0.5f, 2, 0.5f}});
    // A screen that covers x < 0 as seen from the origin.
    b.polygon("screen", b.material("card", 0.5, true), {{-2, 1, -2}, {0, 1, -2}, {0, 1, 2}, {-2, 1, 2}});
    b.light("lamp", {lamp}, PowerUnit::lumen, 100);
    const Scene scene = b.build();
    const World world(make_mesh(scene, {0.5}));
    const Emitter emitter = make_emitters(scene)[0];
    std::uint64_t rays = 0;
    const glm::dvec3 half[4] = {{0, 2, -0.5}, {0.5, 2, -0.5}, {0.5, 2, 0.5}, {0, 2, 0.5}};
    const double exact = polygon_form_factor({0, 0, 0}, {0, 1, 0}, half);
    EXPECT_NEAR(direct_form_factor(world, emitter, glm::vec3(0), {0, 1, 0}, VisibilityDetail::two_cuts, rays) / exact,
                1, 0.04);
    EXPECT_NEAR(direct_form_factor_sampled(world, emitter, glm::vec3(0), {0, 1, 0}, 4096, {0.1f, 0.7f}) / exact, 1,
                0.005);
    EXPECT_EQ(
        direct_form_factor(world, emitter, glm::vec3(-1.2f, 0.9f, 0), {0, 1, 0}, VisibilityDetail::two_cuts, rays), 0);
}

// Far from a lamp of many triangles the stratified points stand for the exact formula.
TEST(DirectLight, FarAndNearAgree) {
    test::SceneBuilder b;
    std::vector<glm::vec3> disc;
    std::vector<glm::dvec3> polygon;
    for (int k = 0; k < 16; ++k) { // counter-clockwise seen from below
        const double angle = 2 * std::numbers::pi * k / 16;
        polygon.push_back({0.5 * std::cos(angle), 0, 0.5 * std::sin(angle)});
        disc.emplace_back(polygon.back());
    }
    const ObjectIndex lamp = b.polygon("lamp", b.material("grey", 0.5), disc);
    b.light("lamp", {lamp}, PowerUnit::lumen, 100);
    const Scene scene = b.build();
    const World world(make_mesh(scene, {1.0}));
    const Emitter emitter = make_emitters(scene)[0];
    ASSERT_GT(emitter.triangles.size(), 4u);
    std::uint64_t rays = 0;
    for (const glm::vec3 p : {glm::vec3(0, -3, 0), {0, -6, 0}, {1, -5.8f, 2}, {4, -5, 0}, {0, -50, 0}}) {
        const glm::vec3 normal = glm::normalize(glm::vec3(0.1f, 1, 0));
        const double exact = polygon_form_factor(p, normal, polygon);
        EXPECT_NEAR(direct_form_factor(world, emitter, p, normal, VisibilityDetail::two_cuts, rays) / exact, 1, 0.005);
    }
}
