// The path tracer where the answer is known, and its standard error where it is not.
#include <cmath>

#include <gtest/gtest.h>

#include "core/solve/path_tracer.h"
#include "core/solve/solution_state.h"
#include "core/transport/polygon_form_factor.h"
#include "core/view/measure.h"
#include "core/view/picture.h"
#include "core/view/reference_picture.h"
#include "core/view/surface_points.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

Solution with_world(Scene scene) {
    Solution solution(std::make_shared<const Scene>(std::move(scene)));
    while (!solution.world()) solution.step(test::never);
    return solution;
}

// A cube of unit walls: floor, ceiling, left, right, front, back.
Scene cube(const std::array<double, 6>& exitance, const std::array<double, 6>& rho) {
    test::SceneBuilder b;
    std::array<MaterialIndex, 6> paints;
    for (int f = 0; f < 6; ++f) paints[f] = b.material("paint " + std::to_string(f), rho[f]);
    const auto faces = b.room("cube", paints, glm::vec3(0), glm::vec3(1));
    for (int f = 0; f < 6; ++f)
        if (exitance[f] > 0) b.light("light " + std::to_string(f), {faces[f]}, PowerUnit::exitance, exitance[f]);
    return b.build();
}

// The integral equation of the same cube, B(x) = E + rho H(x), H(x) = int B dF, by collocation at the middles of n x n
// squares a wall with the exact form factor from each point to each square (Lambert's formula). Means of H over the
// walls; the error falls with 1/n^2, which Richardson's extrapolation takes away.
std::array<double, 6> wall_means(const std::array<double, 6>& exitance, const std::array<double, 6>& rho, int n) {
    struct Square {
        glm::dvec3 middle, normal;
        std::array<glm::dvec3, 4> corners;
        int wall;
    };
    std::vector<Square> squares;
    for (int f = 0; f < 6; ++f) {
        const int axis = f < 2 ? 1 : (f < 4 ? 0 : 2), u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
        const bool high = f % 2 == 1;
        for (int i = 0; i < n; ++i)
            for (int k = 0; k < n; ++k) {
                Square s;
                s.wall = f;
                const auto at = [&](double u, double v) {
                    glm::dvec3 p(0);
                    p[axis] = high, p[u_axis] = u / n, p[v_axis] = v / n;
                    return p;
                };
                s.middle = at(i + 0.5, k + 0.5);
                s.normal = glm::dvec3(0);
                s.normal[axis] = high ? -1 : 1;
                s.corners = {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)};
                if (high) std::swap(s.corners[1], s.corners[3]);
                squares.push_back(s);
            }
    }
    const std::size_t count = squares.size();
    std::vector<double> factor(count * count), b(count), next(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j) {
            if (squares[i].wall == squares[j].wall) continue;
            std::array<glm::dvec3, 4> polygon = squares[j].corners;
            factor[i * count + j] = polygon_form_factor(squares[i].middle, squares[i].normal, polygon);
        }
    std::array<double, 6> means{};
    for (std::size_t i = 0; i < count; ++i) b[i] = exitance[squares[i].wall];
    for (int sweep = 0; sweep < 60; ++sweep) {
        means = {};
        for (std::size_t i = 0; i < count; ++i) {
            double h = 0;
            for (std::size_t j = 0; j < count; ++j) h += factor[i * count + j] * b[j];
            means[squares[i].wall] += h / (n * n);
            next[i] = exitance[squares[i].wall] + rho[squares[i].wall] * h;
        }
        b.swap(next);
    }
    return means;
}

struct Traced {
    double mean = 0, standard_error = 0;
};

// Mean irradiance of a wall in W/m2, each point with its own paths.
Traced traced_mean(const Solution& solution, int wall, int n, int paths) {
    std::vector<MeasurePoint> points;
    const int axis = wall < 2 ? 1 : (wall < 4 ? 0 : 2);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            MeasurePoint p{glm::dvec3(0), glm::dvec3(0)};
            p.position[axis] = wall % 2, p.normal[axis] = wall % 2 ? -1 : 1;
            p.position[(axis + 1) % 3] = (i + 0.5) / n, p.position[(axis + 2) % 3] = (k + 0.5) / n;
            points.push_back(p);
        }
    Traced traced;
    for (const Irradiance& h : measure_points(solution, points, {MeasureAt::reference, paths, 11}, test::never)) {
        traced.mean += h.irradiance_w_m2 / double(points.size());
        const double e = h.irradiance_w_m2 * h.standard_error_percent / 100 / double(points.size());
        traced.standard_error += e * e;
    }
    traced.standard_error = std::sqrt(traced.standard_error);
    return traced;
}

} // namespace

// E and rho of the reference cases; the walls are not of constant radiosity, so the figures are the integral
// equation's.
TEST(Reference, CubeOfSixWallsSolvesTheIntegralEquation) {
    const struct {
        std::array<double, 6> exitance, rho;
    } cases[] = {{{0, 1, 0, 0, 0, 0}, {0.8, 0.8, 0.8, 0.8, 0.8, 0.8}},
                 {{0, 10, 0, 0, 1, 0}, {0.2, 0.7, 0.5, 0.5, 0.3, 0.9}},
                 {{5, 3, 0, 0, 0, 0}, {0.6, 0.1, 0.45, 0.55, 0.65, 0.35}}};
    for (const auto& c : cases) {
        const auto coarse = wall_means(c.exitance, c.rho, 4), fine = wall_means(c.exitance, c.rho, 8);
        const Solution solution = with_world(cube(c.exitance, c.rho));
        for (int wall = 0; wall < 6; ++wall) {
            const double exact = fine[wall] + (fine[wall] - coarse[wall]) / 3;
            const Traced traced = traced_mean(solution, wall, 8, 256);
            EXPECT_LT(traced.standard_error, 0.01 * exact);
            // Four standard errors, and 0.3 % for 64 points standing for a wall and n = 8 for infinity.
            EXPECT_NEAR(traced.mean, exact, 4 * traced.standard_error + 0.003 * exact) << "wall " << wall;
        }
    }
}

// The lamp touches what it lights: sampling its area alone has no finite variance in such a corner.
TEST(Reference, BoundedVarianceWhereALampTouchesAWall) {
    const Solution solution = with_world(test::furnace(0.5));
    const PathLights lights = make_path_lights(solution.state());
    for (const glm::vec3 p : {glm::vec3(0.5f, 0, 0.5f), {0.001f, 0, 0.5f}, {0.001f, 0, 0.001f}, {1e-5f, 0, 1e-5f}}) {
        const PathEstimate e =
            trace_irradiance(solution.state(), lights, p + glm::vec3(0, 1e-6f, 0), {0, 1, 0}, 4096, 5, test::never);
        const double flat = xyz_from_channels(*solution.state().wavelengths,
                                              std::span<const double>(solution.state().luminaire_exitance[0]))
                                .y;
        EXPECT_NEAR(e.illuminance / (2 * flat), 1, 0.02) << p.x;
        EXPECT_LT(e.standard_error, 0.01 * e.illuminance) << p.x;
        EXPECT_NEAR(e.illuminance, 2 * flat, 4.5 * e.standard_error + 1e-4 * flat);
    }
}

// Flux balance of a closed enclosure of one reflectance: sum A (1 - rho) H = Phi, whatever its shape (CIE 171:2006 case
// 5.4 and the integrating sphere). Here a room with a block and two lamps.
TEST(Reference, FluxBalance) {
    Scene scene = test::small_room();
    for (Material& material : scene.materials) material.reflectance = 0.6;
    const Solution solution = with_world(scene);
    const auto points = surface_points(solution, 600, 3);
    double area = 0;
    for (const float a : solution.state().mesh.coarse_area) area += a;
    double sum = 0, square = 0;
    const auto traced = measure_points(solution, points, {MeasureAt::reference, 512, 4}, test::never);
    for (const Irradiance& h : traced) sum += h.illuminance_lx, square += h.illuminance_lx * h.illuminance_lx;
    const double n = double(traced.size()), mean = sum / n, spread = std::sqrt((square / n - mean * mean) / n);
    EXPECT_NEAR(area * 0.4 * mean, 3800, 4 * area * 0.4 * spread); // of the choice of points, mostly
    EXPECT_LT(spread / mean, 0.05);
}

// The stated standard error is the spread of independent runs.
TEST(Reference, StandardErrorIsTheSpread) {
    const Solution solution = with_world(test::small_room());
    const PathLights lights = make_path_lights(solution.state());
    const glm::vec3 p(0.6f, 0, 2.8f);
    double sum = 0, square = 0, stated = 0;
    const int runs = 60;
    for (int run = 0; run < runs; ++run) {
        const PathEstimate e = trace_irradiance(solution.state(), lights, p + glm::vec3(0, 1e-5f, 0), {0, 1, 0}, 256,
                                                1000 + std::uint32_t(run), test::never);
        sum += e.illuminance, square += e.illuminance * e.illuminance, stated += e.standard_error / runs;
    }
    const double spread = std::sqrt((square - sum * sum / runs) / (runs - 1));
    EXPECT_GT(stated / spread, 0.75);
    EXPECT_LT(stated / spread, 1.33);
}

// With and without radiosity: gathering with many rays and paths agree within what they state.
TEST(Reference, AgreesWithGathering) {
    const Solution solution = test::solved(test::small_room());
    const auto points = surface_points(solution, 60, 8);
    const auto traced = measure_points(solution, points, {MeasureAt::reference, 4096, 5}, test::never),
               gathered = measure_points(solution, points, {MeasureAt::gather, 2048, 6}, test::never);
    double bias = 0, weight = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double e = std::hypot(traced[i].standard_error_percent, gathered[i].standard_error_percent) / 100 + 0.01;
        bias += (gathered[i].illuminance_lx / traced[i].illuminance_lx - 1) / (e * e), weight += 1 / (e * e);
    }
    EXPECT_LT(std::abs(bias / weight), 0.01);
}

TEST(ReferenceSolver, SettlesWithinItsTargetAndSaysSo) {
    Scene scene = test::furnace(0.5);
    scene.solve.solver = SolverKind::reference;
    scene.solve.element_size = 0.25;
    scene.solve.target_error = 0.03;
    const Solution solution = test::solved(scene);
    ASSERT_TRUE(solution.status().settled) << solution.status().message;
    EXPECT_GT(solution.status().paths, 0u);
    EXPECT_LE(solution.status().estimated_error, 0.05);
    const auto field = solution.field();
    const double exact = 2 * 683 * 106.857 / 400;
    double square = 0;
    int inside = 0;
    for (std::size_t v = 0; v < field->irradiance_xyz.size(); ++v) {
        const double error = double(field->irradiance_xyz[v].y) - exact;
        square += error * error / (exact * exact) / double(field->irradiance_xyz.size());
        inside += std::abs(error) <= field->interval_factor * double(field->error[v]);
    }
    EXPECT_LT(std::sqrt(square), 0.04);
    EXPECT_GT(double(inside) / double(field->irradiance_xyz.size()), 0.9);
}

TEST(ReferenceSolver, NothingAbsorbedIsRefused) {
    Scene scene = test::furnace(1.0);
    scene.solve.solver = SolverKind::reference;
    const Solution solution = test::solved(scene);
    EXPECT_EQ(solution.status().stage, SolveStage::failed);
}

TEST(ReferencePicture, FurnaceIsOneColourAndKnowsItsError) {
    const Solution solution = with_world(test::furnace(0.5));
    Camera camera;
    camera.position = {0.3, 0.4, 0.2};
    camera.target = {0.9, 0.6, 0.8};
    const ReferencePicture picture =
        trace_picture(solution, camera, {.width = 24, .height = 16, .target_error = 0, .most_passes = 64}, test::never);
    ASSERT_EQ(picture.image.xyz.size(), 24u * 16u);
    EXPECT_EQ(picture.passes, 64u);
    const double exact = 2 * 683 * 106.857 / 400 / M_PI;
    double square = 0, stated = 0;
    for (std::size_t i = 0; i < picture.image.xyz.size(); ++i) {
        const double error = double(picture.image.xyz[i].y) - exact;
        square += error * error, stated += double(picture.standard_error[i]) * picture.standard_error[i];
    }
    EXPECT_GT(std::sqrt(square / stated), 0.8);
    EXPECT_LT(std::sqrt(square / stated), 1.25);
    EXPECT_LT(picture.relative_error, 0.1);
    const std::atomic<bool> always{true};
    EXPECT_TRUE(trace_picture(solution, camera, {.width = 8, .height = 8}, always).image.xyz.empty());
}

// The same picture by radiosity and by paths, textures and lamps in it.
TEST(ReferencePicture, AgreesWithThePictureOfTheField) {
    const Solution solution = test::solved(test::small_room());
    Camera camera;
    camera.position = {0.3, 1.5, 3.8};
    camera.target = {2, 1, 0.5};
    const ReferencePicture traced = trace_picture(
        solution, camera, {.width = 16, .height = 10, .target_error = 0, .most_passes = 256}, test::never);
    const FieldView view{solution.scene(), solution.mesh(), solution.world(), solution.field()};
    const RadianceImage field = render_picture(view, camera, {16, 10, 6}, PictureQuantity::colour, test::never);
    double traced_sum = 0, field_sum = 0;
    int far = 0;
    for (std::size_t i = 0; i < field.xyz.size(); ++i) {
        traced_sum += traced.image.xyz[i].y, field_sum += field.xyz[i].y;
        const double difference = double(traced.image.xyz[i].y) - field.xyz[i].y;
        far += std::abs(difference) > 4 * double(traced.standard_error[i]) + 0.06 * double(field.xyz[i].y);
    }
    EXPECT_NEAR(field_sum / traced_sum, 1, 0.02);
    EXPECT_LE(far, 8); // of 160: edges of things, where 36 rays see another share
}
