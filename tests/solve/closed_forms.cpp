// Radiosities that are known in closed form.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/luminaire.h"
#include "core/solve/solution_state.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

// Irradiance in W/m2 at every vertex as shown, from the luminous field (flat spectrum, grey paint: one number).
double watts_per_lumen(const Solution& solution) {
    const Wavelengths& w = *solution.state().wavelengths;
    const std::vector<double> flat(w.size(), 1.0);
    return watts_from_channels(w, flat) / xyz_from_channels(w, std::span<const double>(flat)).y;
}

} // namespace

// Furnace: every surface of a closed enclosure has exitance E = 1 and reflectance rho, so B = E + rho B = 1/(1-rho)
// everywhere.
class Furnace : public ::testing::TestWithParam<double> {};

TEST_P(Furnace, RadiosityIsExactAtEveryVertex) {
    const double rho = GetParam();
    const Solution solution = test::solved(test::furnace(rho));
    ASSERT_TRUE(solution.status().settled) << solution.status().message;
    const double exact = 1 / (1 - rho), scale = watts_per_lumen(solution);
    const auto field = solution.field();
    ASSERT_GT(field->irradiance_xyz.size(), 500u);
    for (std::size_t v = 0; v < field->irradiance_xyz.size(); ++v) {
        const double h = field->irradiance_xyz[v].y * scale;
        const double b = (field->emitted_xyz[v].y + field->reflected_xyz[v].y) * M_PI * scale;
        ASSERT_NEAR(h / exact, 1, 1e-3) << "irradiance at vertex " << v;
        ASSERT_NEAR(b / exact, 1, 1e-3) << "radiosity at vertex " << v;
    }
}

INSTANTIATE_TEST_SUITE_P(Reflectances, Furnace, ::testing::Values(0.0, 0.1, 0.5, 0.9, 0.99));

// Integrating sphere, R = 1: inside a sphere F_ij = A_j / A for any i, so that a luminaire of flux Phi anywhere on its
// wall gives the indirect irradiance rho Phi / (A (1 - rho)) everywhere. A faceted sphere of 2 x 32 x 16 triangles has
// 0.9 % less area; A is its own.
TEST(IntegratingSphere, IndirectIrradianceIsUniform) {
    const double rho = 0.8;
    test::SceneBuilder b;
    const MaterialIndex paint = b.material("paint", rho);
    const int slices = 32, stacks = 16;
    const auto point = [&](int i, int k) {
        const double phi = 2 * M_PI * i / slices, theta = M_PI * k / stacks;
        return glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    };
    ObjectIndex cap{};
    for (int k = 0; k < stacks; ++k)
        for (int i = 0; i < slices; ++i) {
            const std::string name = k == 0 ? "cap" : "wall";
            std::vector<glm::vec3> q;
            if (k == 0)
                q = {point(i, 0), point(i, 1), point(i + 1, 1)};
            else if (k == stacks - 1)
                q = {point(i, k), point(i, k + 1), point(i + 1, k)};
            else
                q = {point(i, k), point(i, k + 1), point(i + 1, k + 1), point(i + 1, k)};
            const ObjectIndex o = b.polygon(name, paint, q);
            if (k == 0) cap = o;
        }
    b.light("cap", {cap}, PowerUnit::watt, 100);
    const Scene scene = b.build();
    const Solution solution = test::solved(scene);
    double area = 0;
    for (const float a : solution.state().mesh.coarse_area) area += a;
    EXPECT_NEAR(area, 4 * M_PI, 0.02 * 4 * M_PI);
    // Mean irradiance from the flux balance: A (1 - rho) H = Phi. Exact for any closed enclosure of one reflectance.
    const auto field = solution.field();
    const std::vector<float> areas = vertex_areas(*solution.mesh());
    double flux = 0;
    for (std::size_t v = 0; v < areas.size(); ++v) flux += areas[v] * field->irradiance_xyz[v].y;
    EXPECT_NEAR(flux * watts_per_lumen(solution) * (1 - rho) / 100, 1, 0.015);
    // And far from the cap, uniform: direct Phi / A plus indirect.
    const double uniform = 100 / (area * (1 - rho));
    double worst = 0;
    for (std::size_t v = 0; v < areas.size(); ++v) {
        if (solution.mesh()->vertices[v].position.y > 0.5f) continue;
        worst = std::max(worst, std::abs(field->irradiance_xyz[v].y * watts_per_lumen(solution) / uniform - 1));
    }
    EXPECT_LT(worst, 0.06); // facets: F is not exactly A_j / A between neighbours
}

// Six walls of a unit cube, each with its own E and rho, ONE constant element a wall: B solves a 6 x 6 system with
// F_opposite and F_adjacent (Howell C-11, C-14). Here the form factors are the kept rays of all vertices of a wall, and
// the system is solved by the program's own sweeps. (The true radiosity is not constant over a wall: in these cubes the
// means of the continuous solution are up to 5.6 % away from the 6 x 6 one, which is what one element a wall costs:
// tests/view, ContinuousCube.) Order of walls: floor, ceiling, left, right, front, back. B at 20 digits from the 6 x 6
// system.
struct CubeCase {
    const char* name;
    std::array<double, 6> E, rho, B;
};

class CubeOfSixWalls : public ::testing::TestWithParam<CubeCase> {};

TEST_P(CubeOfSixWalls, MeansOfTheWalls) {
    const CubeCase& c = GetParam();
    // The 6 x 6 system itself, by Jacobi sweeps: the figures above are its solution.
    const double opposite = 0.19982489569838738, adjacent = 0.20004377607540316;
    std::array<double, 6> B = c.E;
    for (int sweep = 0; sweep < 5000; ++sweep) {
        std::array<double, 6> next = c.E;
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j)
                if (i != j) next[i] += c.rho[i] * (i / 2 == j / 2 ? opposite : adjacent) * B[j];
        B = next;
    }
    for (int f = 0; f < 6; ++f) EXPECT_NEAR(B[f] / c.B[f], 1, 1e-6);

    // Form factors between walls: the rays of each wall's vertices, weighted by the vertices' areas.
    const Mesh mesh = make_mesh(test::furnace(0.5), {0.08});
    const World world(mesh);
    const std::vector<glm::vec3> origins = ray_origins(mesh, world.epsilon());
    const std::vector<std::uint8_t> buried(mesh.coarse_vertex_count, 0);
    const std::vector<float> areas = vertex_areas(mesh);
    Receivers receivers; // each vertex its own
    for (std::uint32_t v = 0; v < mesh.coarse_vertex_count; ++v)
        receivers.of_vertex.push_back(v), receivers.vertex.push_back(v);
    receivers.buried = buried;
    std::vector<GatherPass> traced(16, make_gather_pass(mesh, receivers));
    for (std::uint32_t p = 0; p < traced.size(); ++p)
        trace_gather_rays(world, mesh, origins, receivers, buried, 1, p, 0, mesh.coarse_vertex_count, traced[p]);
    std::array<std::array<double, 6>, 6> F{};
    std::array<double, 6> area{};
    for (std::uint32_t v = 0; v < mesh.coarse_vertex_count; ++v) {
        const std::uint32_t i = mesh.vertices[v].surface;
        area[i] += areas[v];
        for (const GatherPass& pass : traced)
            for (int k = 0; k < rays_per_pass; ++k)
                F[i][mesh.vertices[pass.ends[std::size_t(v) * rays_per_pass + k]].surface] +=
                    areas[v] / (double(traced.size()) * rays_per_pass);
    }
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
            F[i][j] /= area[i];
            if (i != j)
                EXPECT_NEAR(F[i][j] / (i / 2 == j / 2 ? opposite : adjacent), 1, 0.005);
            else
                EXPECT_EQ(F[i][j], 0);
        }

    // The same factors as rows of six receivers, to 1/16000.
    const int passes = 500, rays = passes * rays_per_pass;
    std::vector<GatherPass> rows(passes);
    for (GatherPass& pass : rows) pass.ends.assign(6 * rays_per_pass, 6); // fine ends: not used by sweeps
    ChannelField rho(6, 1), direct(6, 1);
    for (int i = 0; i < 6; ++i) {
        double share = 0;
        int ray = 0;
        for (int j = 0; j < 6; ++j) {
            share += F[i][j];
            for (; ray < static_cast<int>(share * rays + 0.5); ++ray)
                rows[ray / rays_per_pass].ends[i * rays_per_pass + ray % rays_per_pass] = j;
            direct[i][0] += static_cast<float>(F[i][j] * c.E[j]);
        }
        rho[i][0] = static_cast<float>(c.rho[i]);
    }
    GatherSystem system(6, 1, std::vector<float>(6, 1.0f));
    system.set_sources(rho, direct);
    for (int sweep = 0; sweep < 100 && system.relative_residual() > 1e-6; ++sweep)
        while (!system.sweep(rows, test::never)) {
        }
    for (int f = 0; f < 6; ++f)
        EXPECT_NEAR((c.E[f] + system.radiosity()[f][0]) / c.B[f], 1, 0.005) << c.name << " wall " << f;
}

INSTANTIATE_TEST_SUITE_P(ClosedForm, CubeOfSixWalls,
                         ::testing::Values(CubeCase{"ceiling lit, 0.5",
                                                    {0, 1, 0, 0, 0, 0},
                                                    {0.5, 0.5, 0.5, 0.5, 0.5, 0.5},
                                                    {0.18174582610778848, 1.0909090981076955, 0.18183626894612901,
                                                     0.18183626894612901, 0.18183626894612901, 0.18183626894612901}},
                                           CubeCase{"ceiling lit, 0.8",
                                                    {0, 1, 0, 0, 0, 0},
                                                    {0.8, 0.8, 0.8, 0.8, 0.8, 0.8},
                                                    {0.68955107073763763, 1.5517241536449146, 0.6896811939043619,
                                                     0.6896811939043619, 0.6896811939043619, 0.6896811939043619}},
                                           CubeCase{"mixed",
                                                    {0, 10, 0, 0, 1, 0},
                                                    {0.2, 0.7, 0.5, 0.5, 0.3, 0.9},
                                                    {0.834251, 11.436819, 1.972785, 1.972785, 2.171649, 3.310189}},
                                           CubeCase{"two lights",
                                                    {5, 3, 0, 0, 0, 0},
                                                    {0.6, 0.1, 0.45, 0.55, 0.65, 0.35},
                                                    {6.016536, 3.2252, 1.196478, 1.436034, 1.667119, 0.947976}}));

// A closed scene that absorbs nothing has no finite radiosity: said before the first sweep, never iterated.
TEST(Stability, ReflectanceOneInAClosedBoxIsRefused) {
    const Solution solution = test::solved(test::furnace(1.0));
    EXPECT_EQ(solution.status().stage, SolveStage::failed);
    EXPECT_THAT(solution.status().message, ::testing::HasSubstr("no finite solution"));
    EXPECT_EQ(solution.status().sweeps, 0u);
}

TEST(Stability, NoLightIsBlackAndSaysSo) {
    test::SceneBuilder b;
    b.room("room", test::all(b.material("white", 0.8)), glm::vec3(0), glm::vec3(1));
    const Solution solution = test::solved(b.build());
    EXPECT_TRUE(solution.status().settled);
    EXPECT_THAT(solution.status().message, ::testing::HasSubstr("nothing emits"));
    const auto field = solution.field();
    for (const glm::vec3& h : field->irradiance_xyz) EXPECT_EQ(h, glm::vec3(0));
}

TEST(Stability, AnEmptySceneSettles) {
    const Solution solution = test::solved(Scene{});
    EXPECT_TRUE(solution.status().settled);
    EXPECT_TRUE(solution.field()->irradiance_xyz.empty());
}
