// Every solver on one scene, step by step, with everything it publishes looked at: what tests of stability share.
#pragma once

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/solve/solution_state.h"
#include "tests/support/scenes.h"

namespace lueur::test {

struct SolverChoice {
    const char* name;
    SolverKind kind;
    RefinementOracle oracle = RefinementOracle::error;
};
inline void PrintTo(const SolverChoice& choice, std::ostream* out) {
    *out << choice.name;
}
inline constexpr SolverChoice every_solver[] = {
    {"gathering", SolverKind::gathering},
    {"shooting", SolverKind::shooting},
    {"overshooting", SolverKind::overshooting},
    {"jacobi", SolverKind::jacobi},
    {"gauss_seidel", SolverKind::gauss_seidel},
    {"oracle1", SolverKind::hierarchical, RefinementOracle::form_factor},
    {"oracle2", SolverKind::hierarchical, RefinementOracle::flux},
    {"hierarchical", SolverKind::hierarchical, RefinementOracle::error},
    {"reference", SolverKind::reference},
};
inline constexpr SolverChoice matrix_solvers[] = {every_solver[2], every_solver[3], every_solver[4]};
inline std::string name_of(const ::testing::TestParamInfo<SolverChoice>& info) {
    return info.param.name;
}

// Nothing that is published may be negative, infinite or not a number.
inline void expect_sound(const Field& field) {
    const auto sound = [](const char* what, const std::vector<float>& values) {
        for (const float x : values) {
            ASSERT_TRUE(std::isfinite(x)) << what;
            ASSERT_GE(x, 0) << what;
        }
    };
    sound("unshot", field.unshot);
    sound("error", field.error);
    sound("interpolation error", field.interpolation_error);
    sound("relative error", field.relative_error);
    sound("irradiance in channels", field.irradiance.values);
    for (const auto* colours : {&field.irradiance_xyz, &field.reflected_xyz, &field.emitted_xyz})
        for (const glm::vec3& xyz : *colours)
            for (int k = 0; k < 3; ++k) {
                ASSERT_TRUE(std::isfinite(xyz[k]));
                ASSERT_GE(xyz[k], 0);
            }
    ASSERT_TRUE(std::isfinite(field.scene_error));
    ASSERT_GE(field.scene_error, 0);
}

inline void expect_sound(const SolveStatus& status) {
    for (const double x : {status.progress, status.unshot_share, status.estimated_error, status.emitted_lumens,
                           status.residual, status.error_bound}) {
        ASSERT_TRUE(std::isfinite(x));
        ASSERT_GE(x, 0);
    }
}

// Runs to the end, which must come within so many steps (never seconds); looks at each power of two of them.
inline Solution run(Scene scene, const SolverChoice& choice, std::uint32_t most_steps = 20000) {
    scene.solve.solver = choice.kind;
    scene.solve.oracle = choice.oracle;
    Solution solution(std::make_shared<const Scene>(std::move(scene)));
    std::uint32_t steps = 0;
    while (solution.step(never)) {
        if (++steps >= most_steps) {
            ADD_FAILURE() << choice.name << " is still at it after " << steps << " steps";
            break;
        }
        if ((steps & (steps - 1)) == 0) {
            if (const auto field = solution.field()) expect_sound(*field);
            expect_sound(solution.status());
        }
    }
    if (const auto field = solution.field()) expect_sound(*field);
    expect_sound(solution.status());
    const SolveStatus& status = solution.status();
    EXPECT_NE(status.settled, status.stage == SolveStage::failed) << choice.name;
    if (status.stage == SolveStage::failed) {
        EXPECT_FALSE(status.message.empty()) << choice.name;
    }
    EXPECT_EQ(status.message.find('\n'), std::string::npos);
    return solution;
}

// Luminous flux that arrives on the surfaces for which `counts` is true of a vertex, lm, and their area, m^2.
struct Arriving {
    double flux = 0, area = 0;
    double mean() const { return area > 0 ? flux / area : 0; }
};
template <typename F>
Arriving arriving(const Solution& solution, const F& counts) {
    const Mesh& mesh = *solution.mesh();
    const auto field = solution.field();
    const std::vector<float> area = vertex_areas(mesh);
    const std::vector<std::uint8_t> buried = solution.state().all_buried();
    Arriving sum;
    for (std::size_t v = 0; v < area.size(); ++v) {
        if (buried[v] || !counts(mesh.vertices[v])) continue;
        sum.flux += double(area[v]) * double(field->irradiance_xyz[v].y);
        sum.area += double(area[v]);
    }
    return sum;
}
inline Arriving arriving(const Solution& solution) {
    return arriving(solution, [](const MeshVertex&) { return true; });
}

// Settled and within so many times its own estimate of the truth, or it has said why not.
inline bool expect_right_or_said(const Solution& solution, const SolverChoice& choice, double value, double truth,
                                 double rounding = 1e-3) {
    const SolveStatus& status = solution.status();
    if (status.stage == SolveStage::failed) return false;
    const double off = std::abs(value / truth - 1);
    const double stated = 2 * status.estimated_error + rounding; // calibrated to a factor of two
    if (off <= stated) return true;
    EXPECT_FALSE(status.message.empty()) << choice.name << " is off by " << 100 * off << " %, says "
                                         << 100 * status.estimated_error << " %, and no word";
    return false;
}

} // namespace lueur::test
