// Hierarchical radiosity: links, refinement, energy.
#include <chrono>
#include <cmath>
#include <map>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/solve/hierarchy_view.h"
#include "core/solve/solution_state.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

Scene hierarchical(Scene scene, RefinementOracle oracle, double tolerance = 0, double target = 0.05) {
    scene.solve.solver = SolverKind::hierarchical;
    scene.solve.oracle = oracle;
    scene.solve.link_tolerance = tolerance;
    scene.solve.target_error = target;
    return scene;
}

template <typename F>
void for_leaves(const Hierarchy& h, const F& f) {
    for (std::uint32_t n = 0; n < h.tree().nodes.size(); ++n)
        if (const ElementNode& node = h.tree().nodes[n]; node.is_leaf() && !node.is_cluster() && !h.buried(n))
            f(n, node);
}

// Of the luminous irradiance by links, mean over the area.
double mean_light(const Hierarchy& h) {
    double light = 0, area = 0;
    for_leaves(h, [&](std::uint32_t n, const ElementNode& node) {
        light += double(node.live_area()) * double(h.irradiance()[n][0]) * double(h.scale(n));
        area += double(node.live_area());
    });
    return light / area;
}

} // namespace

TEST(ElementTree, PairsTrianglesOfAWallAndCutsThemIntoFour) {
    ElementTree tree = make_element_tree(test::small_room(), true);
    // 6 walls, 6 faces of the block, 2 lamps: all rectangles.
    EXPECT_EQ(tree.root_count, 14u);
    std::uint32_t cursor = 0;
    while (cursor < tree.nodes.size() && tree.nodes.size() < 3000) {
        const std::uint32_t n = cursor++;
        if (tree.nodes[n].is_cluster()) continue;
        ASSERT_EQ(tree.nodes[n].shape, ElementShape::quadrilateral);
        cut_element(tree, n);
        float area = 0;
        for (const std::uint32_t child : tree.nodes[n].children) area += tree.nodes[child].area;
        EXPECT_NEAR(area / tree.nodes[n].area, 1, 1e-5);
    }
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
        const ElementNode& node = tree.nodes[n];
        if (!node.is_leaf() || node.is_cluster()) continue;
        std::uint32_t root = n;
        while (tree.nodes[root].level > 0) root = tree.nodes[root].parent;
        const SurfacePoint p = point_on(tree, n, {0.3f, 0.6f});
        ASSERT_EQ(leaf_under(tree, root, p.position), n);
        const auto w = corner_weights(tree, n, p.position);
        glm::vec3 q(0);
        for (std::size_t k = 0; k < 4; ++k) q += w[k] * tree.vertices[node.corners[k]];
        ASSERT_LT(glm::distance(p.position, q), 1e-4f * node.radius + 1e-6f);
    }
}

TEST(ElementTree, ClustersHoldEveryRootOnceAndAllItsArea) {
    const ElementTree tree = make_element_tree(test::small_room(), true);
    ASSERT_NE(tree.top, no_index);
    EXPECT_EQ(tree.nodes[tree.top].root_count, tree.root_count);
    EXPECT_EQ(tree.cluster_count, tree.root_count - 1);
    std::vector<int> times(tree.root_count, 0);
    for (const std::uint32_t r : tree.root_order) ++times[r];
    EXPECT_THAT(times, ::testing::Each(1));
    double area = 0;
    for (std::uint32_t r = 0; r < tree.root_count; ++r) area += double(tree.nodes[r].area);
    EXPECT_NEAR(double(tree.nodes[tree.top].area) / area, 1, 1e-5);
    for (std::uint32_t n = tree.root_count; n < tree.nodes.size(); ++n)
        EXPECT_EQ(tree.nodes[n].root_count, std::max(1u, tree.nodes[tree.nodes[n].children[0]].root_count) +
                                                std::max(1u, tree.nodes[tree.nodes[n].children[1]].root_count));
}

// A_r F_rs = A_s F_sr for both links of a pair, with what of each is not inside a solid as its area.
TEST(Links, AreReciprocal) {
    for (const RefinementOracle oracle :
         {RefinementOracle::form_factor, RefinementOracle::flux, RefinementOracle::error}) {
        const Solution solution = test::solved(
            hierarchical(test::small_room(), oracle, oracle == RefinementOracle::form_factor ? 0.2 : 0, 0.3));
        ASSERT_TRUE(solution.status().settled) << solution.status().message;
        const Hierarchy& h = *solution.state().hierarchy;
        std::map<std::pair<std::uint32_t, std::uint32_t>, float> factor;
        for (const Link& link : h.links()) factor[{link.receiver, link.source}] = link.form_factor;
        int pairs = 0;
        for (const auto& [ends, f] : factor) {
            const auto other = factor.find({ends.second, ends.first});
            if (other == factor.end()) continue;
            const ElementNode &r = h.tree().nodes[ends.first], &s = h.tree().nodes[ends.second];
            // Cut at 1 where four points say more than all.
            if (f >= 1 || other->second >= 1) continue;
            ++pairs;
            ASSERT_NEAR(double(r.live_area()) * f / (double(s.live_area()) * other->second), 1, 2e-3);
        }
        EXPECT_GT(pairs, 100);
    }
}

// Furnace: B = E / (1 - rho). Rows that sum to 1 keep it exactly; the lecture's disks lose energy at touching walls.
TEST(Hierarchical, FurnaceIsExactWithRowsOfOne) {
    for (const double rho : {0.0, 0.5, 0.9}) {
        const Solution solution = test::solved(hierarchical(test::furnace(rho), RefinementOracle::error, 0, 0.5));
        ASSERT_TRUE(solution.status().settled) << solution.status().message;
        const Hierarchy& h = *solution.state().hierarchy;
        // Direct light apart: what links bring is rho / (1 - rho) of E.
        const double scale = 1 / (1 - rho);
        const double one = solution.state().luminaire_exitance[0][0];
        for_leaves(h, [&](std::uint32_t n, const ElementNode& node) {
            EXPECT_TRUE(node.closed);
            ASSERT_NEAR(double(h.irradiance()[n][0] * h.scale(n)) / one, rho * scale, 3e-3 * scale);
        });
        const auto field = solution.field();
        for (std::uint32_t v = 0; v < field->irradiance.count; ++v)
            ASSERT_NEAR(field->irradiance[v][0] / one / scale, 1, 3e-3) << v;
    }
}

// The lecture's disks lost a tenth of each row at touching walls. With the exact formula there rows come to 1 on
// average; some are above it and scaled down, those in the corners stay below: 6 % of the light are lost.
TEST(Hierarchical, LectureFormLosesLittleInTheFurnace) {
    const double rho = 0.5;
    const Solution solution = test::solved(hierarchical(test::furnace(rho), RefinementOracle::form_factor, 0.05));
    ASSERT_TRUE(solution.status().settled) << solution.status().message;
    const Hierarchy& h = *solution.state().hierarchy;
    double sum = 0, area = 0;
    for_leaves(h, [&](std::uint32_t n, const ElementNode& node) {
        sum += double(node.area) * double(h.row_sum(n)), area += double(node.area);
    });
    EXPECT_NEAR(sum / area, 1, 0.02);
    const double one = solution.state().luminaire_exitance[0][0];
    EXPECT_LT(mean_light(h), one / (1 - rho));
    EXPECT_GT(mean_light(h), 0.92 * one / (1 - rho));
}

// Slices end wherever time is up or someone asks: the same links, the same light. And an edit that comes in the middle
// of a round ends where the same scene opened afresh does.
TEST(Hierarchical, StepsThatAreCutShortChangeNothing) {
    const Scene scene = hierarchical(test::small_room(), RefinementOracle::error, 0, 0.3);
    Solution whole(std::make_shared<const Scene>(scene));
    std::uint32_t steps = 0;
    while (whole.step(test::never)) ++steps;
    Solution cut(std::make_shared<const Scene>(scene));
    std::atomic<bool> cancel{false}, over{false};
    std::thread impatient([&] {
        while (!over) {
            cancel = !cancel;
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
    });
    while (cut.step(cancel)) {
    }
    over = true;
    impatient.join();
    ASSERT_EQ(cut.status().links, whole.status().links);
    EXPECT_EQ(cut.field()->irradiance.values, whole.field()->irradiance.values);

    auto dimmed = std::make_shared<Scene>(scene);
    dimmed->luminaires[0].dimmer = 0.25;
    const Solution fresh = test::solved(*dimmed);
    for (const double share : {0.55, 0.9}) {
        Solution edited(std::make_shared<const Scene>(scene));
        for (std::uint32_t k = 0; k < share * steps; ++k) edited.step(test::never);
        edited.update(dimmed, SolveFrom::sources);
        test::settle(edited);
        ASSERT_TRUE(edited.status().settled);
        // The clock says where steps end, and links that were made for more light stay: both are right to the target.
        EXPECT_NEAR(mean_light(*edited.state().hierarchy) / mean_light(*fresh.state().hierarchy), 1, 0.05) << share;
    }
}

// A coarse solution agrees with one on many more links as its error bound says.
TEST(Hierarchical, CoarseAgreesWithFineWithinItsBound) {
    const Solution fine = test::solved(hierarchical(test::small_room(), RefinementOracle::error, 0, 0.1));
    const Solution coarse = test::solved(hierarchical(test::small_room(), RefinementOracle::error, 0, 0.4));
    ASSERT_TRUE(fine.status().settled && coarse.status().settled);
    EXPECT_GT(fine.status().links, 2 * coarse.status().links);
    const Hierarchy &a = *coarse.state().hierarchy, &b = *fine.state().hierarchy;
    double difference = 0, light = 0;
    for_leaves(b, [&](std::uint32_t n, const ElementNode& node) {
        std::uint32_t root = n;
        while (b.tree().nodes[root].level > 0) root = b.tree().nodes[root].parent;
        const std::uint32_t m = leaf_under(a.tree(), root, node.centre);
        if (a.buried(m)) return;
        const double x = double(a.irradiance()[m][0] * a.scale(m)), y = double(b.irradiance()[n][0] * b.scale(n));
        difference += double(node.live_area()) * std::abs(x - y), light += double(node.live_area()) * y;
    });
    EXPECT_LT(difference / light, coarse.status().error_bound);
}

TEST(Hierarchical, EndsWhenNothingCanBeCutAnyMore) { // LECTURE correction 43
    for (const RefinementOracle oracle :
         {RefinementOracle::form_factor, RefinementOracle::flux, RefinementOracle::error}) {
        Scene scene = hierarchical(test::furnace(0.5), oracle, 1e-12);
        scene.solve.element_size = 1.1; // of which sixteenths are cut
        const Solution solution = test::solved(scene);
        ASSERT_TRUE(solution.status().settled) << solution.status().message;
        EXPECT_GT(solution.status().links, 0u);
        for_leaves(*solution.state().hierarchy,
                   [](std::uint32_t, const ElementNode& node) { EXPECT_GT(node.area, 1.0f / 64 / 4); });
    }
}

TEST(Hierarchical, ADimmerKeepsTheLinks) {
    const Scene scene = hierarchical(test::small_room(), RefinementOracle::flux, 0, 0.2);
    Solution solution = test::solved(scene);
    const std::uint64_t rays = solution.status().rays;
    const std::uint32_t links = solution.status().links;
    const double before = mean_light(*solution.state().hierarchy);
    Scene dimmed = scene;
    for (Luminaire& l : dimmed.luminaires) l.dimmer = 0.5;
    solution.update(std::make_shared<const Scene>(dimmed), SolveFrom::sources);
    test::settle(solution);
    ASSERT_TRUE(solution.status().settled) << solution.status().message;
    // The flux of a link as a share of the emitted is what it was, but for what the sweeps leave.
    EXPECT_LT(double(solution.status().rays), 1.01 * double(rays));
    EXPECT_NEAR(double(solution.status().links) / double(links), 1, 0.01);
    EXPECT_NEAR(mean_light(*solution.state().hierarchy) / before, 0.5, 1e-3);
}

TEST(Hierarchical, SameWithAnyNumberOfThreads) {
    const Scene scene = hierarchical(test::small_room(), RefinementOracle::error, 0, 0.1);
    const Solution many = test::solved(scene);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Solution single = test::solved(scene);
    ASSERT_EQ(many.status().links, single.status().links);
    EXPECT_EQ(many.state().hierarchy->irradiance().values, single.state().hierarchy->irradiance().values);
}

TEST(Hierarchical, IsCancelledAtOnceAndGoesOn) {
    const Scene scene = hierarchical(test::small_room(), RefinementOracle::error, 0, 0.1);
    Solution solution(std::make_shared<const Scene>(scene));
    const std::atomic<bool> stop{true}, go{false};
    for (int k = 0; k < 2000; ++k) {
        solution.step(stop);
        if (!solution.step(go)) break;
    }
    test::settle(solution);
    EXPECT_EQ(solution.state().hierarchy->irradiance().values,
              test::solved(scene).state().hierarchy->irradiance().values);
}

TEST(Hierarchical, LectureFormRefusesThousandsOfSurfaces) {
    test::SceneBuilder b;
    const MaterialIndex grey = b.material("grey", 0.5);
    for (int k = 0; k < 3100; ++k) {
        const float x = 0.1f * static_cast<float>(k % 60), z = 0.1f * static_cast<float>(k / 60);
        b.polygon("tile " + std::to_string(k), grey, {{x, 0, z}, {x, 0, z + 0.05f}, {x + 0.05f, 0, z}});
    }
    const Solution solution = test::solved(hierarchical(b.build(), RefinementOracle::flux));
    EXPECT_FALSE(solution.status().settled);
    EXPECT_THAT(solution.status().message, ::testing::HasSubstr("oracle = \"error\""));
}

// The links that light a place: irradiances sum to what the place has.
TEST(HierarchyView, LinksOfAnElementBringItsLight) {
    const Solution solution = test::solved(hierarchical(test::small_room(), RefinementOracle::flux, 0, 0.2));
    const Hierarchy& h = *solution.state().hierarchy;
    const HierarchyView& view = *solution.state().hierarchy_view;
    int looked = 0;
    for_leaves(h, [&](std::uint32_t n, const ElementNode&) {
        if (n % 37 != 0) return;
        double sum = 0;
        for (const LinkLine& line : links_of(view, n)) sum += double(line.irradiance);
        double light = 0;
        const auto& weights = solution.state().wavelengths->xyz_weight;
        for (std::size_t c = 0; c < weights.size(); ++c) light += weights[c].y * double(h.irradiance()[n][c]);
        EXPECT_NEAR(sum, light, 0.01 * light + 1e-6);
        ++looked;
    });
    EXPECT_GT(looked, 5);
}
