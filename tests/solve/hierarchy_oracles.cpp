// How many links each oracle needs for how much error, on the Cornell box.
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/scene_file.h"
#include "core/solve/solution_state.h"
#include "tests/support/scenes.h"
#include "tests/support/source_folder.h"

using namespace lueur;

namespace {

struct Place { // of a coarse element, which all solvers have alike
    std::uint32_t element;
    float b1, b2;
};

double lux(const Solution& solution, const Place& p) {
    const std::vector<double> h = irradiance_at(solution.state(), p.element, p.b1, p.b2);
    const auto& weights = solution.state().wavelengths->xyz_weight;
    double y = 0;
    for (std::size_t c = 0; c < weights.size(); ++c) y += weights[c].y * h[c];
    return y;
}

struct Truth {
    std::vector<Place> places;
    std::vector<double> lux;
};

// By gathering on 512 rays a receiver, good to 1 %.
Truth truth_of(const Scene& scene) {
    Scene gathering = scene;
    gathering.solve.solver = SolverKind::gathering;
    gathering.solve.target_error = 0.01;
    const Solution solution = test::solved(gathering);
    const Mesh& mesh = *solution.mesh();
    std::mt19937 random(3);
    std::discrete_distribution<std::uint32_t> element(mesh.coarse_area.begin(), mesh.coarse_area.end());
    std::uniform_real_distribution<float> unit(0, 1);
    Truth truth;
    while (truth.places.size() < 2000) {
        Place p{element(random), unit(random), unit(random)};
        if (p.b1 + p.b2 > 1) p.b1 = 1 - p.b1, p.b2 = 1 - p.b2;
        const glm::uvec3 v = mesh.nodes[p.element].vertices;
        const auto& buried = solution.state().buried;
        if (buried[v.x] || buried[v.y] || buried[v.z]) continue;
        truth.places.push_back(p);
        truth.lux.push_back(lux(solution, p));
    }
    return truth;
}

struct Measured {
    double links, rms, p99;
};

Measured measured(Scene scene, RefinementOracle oracle, double tolerance, double target, const Truth& truth) {
    scene.solve.solver = SolverKind::hierarchical;
    scene.solve.oracle = oracle;
    scene.solve.link_tolerance = tolerance;
    scene.solve.target_error = target;
    const Solution solution = test::solved(scene);
    EXPECT_TRUE(solution.status().settled) << solution.status().message;
    double square = 0, norm = 0;
    std::vector<double> relative;
    for (std::size_t k = 0; k < truth.lux.size(); ++k) {
        const double d = lux(solution, truth.places[k]) - truth.lux[k];
        square += d * d, norm += truth.lux[k] * truth.lux[k];
        relative.push_back(std::abs(d) / truth.lux[k]);
    }
    std::sort(relative.begin(), relative.end());
    return {double(solution.status().links), std::sqrt(square / norm), relative[relative.size() * 99 / 100]};
}

Scene cornell() {
    auto loaded = load_scene(test::source_folder() / "assets/cornell.toml");
    EXPECT_TRUE(loaded);
    return loaded ? loaded->scene : Scene{};
}

// Traced once for all tests.
const Truth& cornell_truth() {
    static const Truth truth = truth_of(cornell());
    return truth;
}

} // namespace

// Oracle2 links by the flux that is carried and leaves alone what is dark or far: after Hanrahan et al. 1991 it needs a
// fraction of Oracle1's links for the same error.
TEST(Oracles, FluxNeedsFewerLinksThanFormFactorsOnTheCornellBox) {
    const Scene scene = cornell();
    const Truth& truth = cornell_truth();
    std::vector<Measured> by_form_factor, by_flux;
    for (const double f : {0.2, 0.05}) // RMS 24 % with 86,000 links, 14 % with 516,000
        by_form_factor.push_back(measured(scene, RefinementOracle::form_factor, f, 0.05, truth));
    for (const double flux : {2e-3, 1.25e-4}) // 22 % with 1,400 links, 11 % with 25,000
        by_flux.push_back(measured(scene, RefinementOracle::flux, flux, 0.05, truth));
    for (std::size_t k = 0; k < 2; ++k) {
        fmt::print("Oracle1: {:.0f} links, RMS {:.1f} %; Oracle2: {:.0f} links, RMS {:.1f} %\n",
                   by_form_factor[k].links, 100 * by_form_factor[k].rms, by_flux[k].links, 100 * by_flux[k].rms);
        EXPECT_LT(by_flux[k].rms, by_form_factor[k].rms);
        EXPECT_LT(by_flux[k].links, by_form_factor[k].links / 3);
    }
    EXPECT_LT(by_flux[1].rms, 0.7 * by_flux[0].rms);
}

// The tolerance follows from the target error, so that who asks for less error gets less.
TEST(Oracles, ALowerTargetGivesALowerError) {
    for (const RefinementOracle oracle :
         {RefinementOracle::form_factor, RefinementOracle::flux, RefinementOracle::error}) {
        double before = 1, links = 0;
        for (const double target : {0.4, 0.2, 0.1}) {
            if (oracle == RefinementOracle::form_factor && target < 0.2) continue; // 200,000 links, RMS 20.1 %
            const Measured m = measured(cornell(), oracle, 0, target, cornell_truth());
            fmt::print("oracle {}, target {:.0f} %: {:.0f} links, RMS {:.1f} %\n", static_cast<int>(oracle),
                       100 * target, m.links, 100 * m.rms);
            EXPECT_LT(m.rms, before) << target;
            EXPECT_GT(m.links, links) << target;
            // As derived; Oracle1's rule knows nothing of shadows and of light lost at edges, and promises order only.
            if (oracle != RefinementOracle::form_factor) {
                EXPECT_LT(m.rms, 1.5 * target);
            }
            before = m.rms, links = m.links;
        }
    }
}
