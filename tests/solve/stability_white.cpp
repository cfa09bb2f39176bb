// Reflectances near 1, and walls so close that light goes to and fro a thousand times: every solver ends, and is right
// within its estimate or says why not.
#include "core/solve/settled_words.h"
#include "tests/solve/stability.h"

using namespace lueur;
using test::every_solver;
using test::SolverChoice;

namespace {

bool is_lecture_hierarchy(const SolverChoice& choice) {
    return choice.kind == SolverKind::hierarchical && choice.oracle != RefinementOracle::error;
}

Scene coarse(Scene scene, const SolverChoice& choice, double element_size) {
    scene.solve.element_size = element_size;
    scene.solve.target_error = choice.kind == SolverKind::reference || is_lecture_hierarchy(choice) ? 0.25 : 0.1;
    scene.solve.form_factors = FormFactorMethod::hemisphere;
    scene.solve.form_factor_samples = 512;
    scene.solve.wavelengths = {WavelengthRule::rgb, 3};
    return scene;
}

Scene white_box(double rho) {
    test::SceneBuilder b;
    b.lit_room("room", b.material("white", rho), glm::vec3(0), glm::vec3(2), 0.3f, 1000);
    return b.build();
}

// Rows of rays are not reciprocal, and few of them at few places: gathering and the matrix may be off by some per cent,
// which they say. The others send what there is.
bool keeps_the_flux(const SolverChoice& choice) {
    return choice.kind == SolverKind::shooting || choice.kind == SolverKind::hierarchical ||
           choice.kind == SolverKind::reference;
}

// Form factor of directly opposed squares of side a at distance d (Howell, C-11), X = Y = a / d.
double opposed_squares(double a, double d) {
    const double x = a / d, root = std::sqrt(1 + x * x);
    return 2 / (M_PI * x * x) *
           (0.5 * std::log((1 + x * x) * (1 + x * x) / (1 + 2 * x * x)) + 2 * x * root * std::atan(x / root) -
            2 * x * std::atan(x));
}

} // namespace

class StabilityWhite : public ::testing::TestWithParam<SolverChoice> {};
INSTANTIATE_TEST_SUITE_P(Solvers, StabilityWhite, ::testing::ValuesIn(every_solver), test::name_of);

class StabilityMatrix : public ::testing::TestWithParam<SolverChoice> {};
INSTANTIATE_TEST_SUITE_P(Solvers, StabilityMatrix, ::testing::ValuesIn(test::matrix_solvers), test::name_of);

// A closed room of one paint: what is emitted is what is absorbed, Phi = (1 - rho) sum A H.
TEST_P(StabilityWhite, BoxOfOnePaint) {
    const SolverChoice choice = GetParam();
    for (const double rho : {0.9, 0.99, 0.999, 1 - 1e-6}) {
        // Paths of a hundred and of a thousand bounces would take seconds and half a minute here.
        if (choice.kind == SolverKind::reference && rho > 0.9 && rho < 0.9999) continue;
        const Solution solution = test::run(coarse(white_box(rho), choice, 1.2), choice);
        const double flux = test::arriving(solution).flux;
        const bool right = test::expect_right_or_said(solution, choice, flux, 1000 / (1 - rho), 0.02);
        if (is_lecture_hierarchy(choice)) {
            // Disks lose what walls exchange at their common edge, 1 / (1 - rho) times over.
            EXPECT_THAT(solution.status().message, ::testing::HasSubstr("of the light is lost")) << rho;
        } else if (rho < 0.999 && keeps_the_flux(choice)) {
            EXPECT_TRUE(solution.status().settled) << choice.name << " " << rho << ": " << solution.status().message;
            EXPECT_TRUE(right) << choice.name << " " << rho << ": " << flux * (1 - rho) / 1000 << " of the light";
        }
        if (rho > 0.9999) {
            EXPECT_FALSE(solution.status().message.empty()) << choice.name;
        }
    }
}

TEST_P(StabilityWhite, FurnaceOfMillionReflections) {
    const SolverChoice choice = GetParam();
    const Solution solution = test::run(coarse(test::furnace(1 - 1e-6), choice, 0.6), choice);
    // 1 - 1e-6 is 1 - 1.013e-6 in single precision, and sums of a million terms round: nobody is right to a per cent.
    EXPECT_THAT(solution.status().message,
                ::testing::AnyOf(::testing::HasSubstr("close to 1"), ::testing::HasSubstr("single precision"),
                                 ::testing::HasSubstr("does not converge"), ::testing::HasSubstr("is lost")));
}

TEST_P(StabilityWhite, ExactlyOneIsToldBeforeTheFirstSweep) {
    const SolverChoice choice = GetParam();
    for (const Scene& scene : {white_box(1), test::furnace(1)}) {
        Solution solution = test::run(coarse(scene, choice, 1.2), choice);
        EXPECT_EQ(solution.status().stage, SolveStage::failed);
        EXPECT_THAT(solution.status().message, ::testing::StartsWith("no finite solution"));
        EXPECT_EQ(solution.status().sweeps + solution.status().shots, 0u);
        EXPECT_EQ(solution.status().paths, 0u);
        // A darker paint is solved: it has not ended for good.
        Scene darker = *solution.scene();
        for (Material& material : darker.materials) material.reflectance = 0.5;
        solution.update(std::make_shared<const Scene>(darker), SolveFrom::reflectance);
        test::settle(solution);
        EXPECT_TRUE(solution.status().settled) << solution.status().message;
    }
}

// Squares of 2 m at 1 mm, one shines: H_1 = rho F^2 E / (1 - rho^2 F^2), H_2 = F E / (1 - rho^2 F^2), but for the rims.
TEST_P(StabilityWhite, WallsAMillimetreApart) {
    const SolverChoice choice = GetParam();
    const double rho = 0.9, f = opposed_squares(2, 1e-3);
    ASSERT_NEAR(f, 0.999, 1e-3);
    test::SceneBuilder b;
    const MaterialIndex white = b.material("white", rho);
    const ObjectIndex low = b.polygon("low", white, {{0, 0, 0}, {0, 0, 2}, {2, 0, 2}, {2, 0, 0}});
    b.polygon("high", white, {{0, 0.001f, 0}, {2, 0.001f, 0}, {2, 0.001f, 2}, {0, 0.001f, 2}});
    b.light("low", {low}, PowerUnit::exitance, 1);
    const Solution solution = test::run(coarse(b.build(), choice, 0.5), choice);
    ASSERT_TRUE(solution.status().settled) << solution.status().message;
    const Wavelengths& w = *solution.state().wavelengths;
    const double one = xyz_from_channels(w, std::span<const double>(solution.state().luminaire_exitance[0])).y;
    const double truth = 0.5 * (f + rho * f * f) / (1 - rho * rho * f * f);
    const bool right =
        test::expect_right_or_said(solution, choice, test::arriving(solution).mean() / one, truth, 0.005);
    // Its rays from patch to vertex lose 4 % at the rims: rays of the patches say so, and the gap is told.
    if (choice.kind == SolverKind::shooting) {
        EXPECT_THAT(solution.status().message, ::testing::HasSubstr("face others at less than"));
    }
    // Oracle2 links the two squares whole, as far as its flux goes.
    if (choice.oracle != RefinementOracle::flux) {
        EXPECT_TRUE(right) << choice.name << " off by " << test::arriving(solution).mean() / one / truth - 1
                           << ", says " << solution.status().estimated_error << ": " << solution.status().message;
    }
}

// Point-to-disk from one point beside a shared edge, or a hemicube of few pixels: with rho 0.999 no sweep would
// converge on rows above 1.
TEST_P(StabilityMatrix, RowsOfPoorFormFactors) {
    const SolverChoice choice = GetParam();
    for (const FormFactorMethod method : {FormFactorMethod::point_to_disk, FormFactorMethod::hemicube}) {
        constexpr double rho = 0.999;
        Scene scene = coarse(white_box(rho), choice, 1.2);
        scene.solve.form_factors = method;
        scene.solve.form_factor_samples = method == FormFactorMethod::hemicube ? 4 : 1;
        const Solution solution = test::run(scene, choice);
        const RowSums& sums = solution.state().patch_solve.sums;
        EXPECT_TRUE(sums.above > 0 || method == FormFactorMethod::hemicube);
        for (const double sum : sums.sum) EXPECT_LE(sum, 1);
        if (sums.above > 0 && solution.status().settled) {
            EXPECT_THAT(solution.status().message, ::testing::HasSubstr("more than 1"));
        }
        test::expect_right_or_said(solution, choice, test::arriving(solution).flux, 1000 / (1 - rho));
        // No row above 1: no patch has more than E_max / (1 - rho).
        double most = 0, emitted = 0;
        for (const double b : solution.state().patch_solve.system.radiosity().values) most = std::max(most, b);
        for (const double e : solution.state().luminaire_exitance[0]) emitted = std::max(emitted, e);
        EXPECT_LE(most, emitted / (1 - rho) * (1 + 1e-9));
    }
}

// A part of the scene that keeps its light is found, though the rest absorbs.
TEST(StabilityGathering, AWhiteBoxBesideAGreyOneHasNoFiniteSolution) {
    test::SceneBuilder b;
    b.lit_room("grey", b.material("grey", 0.5), glm::vec3(0), glm::vec3(2), 0.3f, 1000);
    b.lit_room("white", b.material("white", 1.0), glm::vec3(3, 0, 0), glm::vec3(5, 2, 2), 0.3f, 1000);
    const SolverChoice gathering = every_solver[0];
    Scene scene = coarse(b.build(), gathering, 1.2);
    const Solution solution = test::run(scene, gathering);
    EXPECT_THAT(solution.status().message, ::testing::StartsWith("no finite solution"));
    EXPECT_EQ(solution.status().sweeps, 0u);
    scene.luminaires[1].dimmer = 0; // dark, it is as good as any
    EXPECT_TRUE(test::run(scene, gathering).status().settled);
}

// What a shot sends is what arrives, whatever the reflectance: of a closed room nothing is lost.
TEST(StabilityShooting, KeepsTheFluxAtHighReflectances) {
    const SolverChoice shooting = every_solver[1];
    for (const double rho : {0.9, 0.99}) {
        const Solution solution = test::run(coarse(white_box(rho), shooting, 1.2), shooting);
        ASSERT_TRUE(solution.status().settled) << solution.status().message;
        EXPECT_NEAR(test::arriving(solution).flux * (1 - rho) / 1000, 1, 0.02) << rho;
    }
}

// The balance of flux is the error of a solver that loses a share of the light, whatever the reflectance.
TEST(FluxBalance, TellsTheShareThatIsLost) {
    const SolverChoice oracle1 = every_solver[5];
    for (const double rho : {0.5, 0.9}) {
        const Solution solution = test::run(coarse(white_box(rho), oracle1, 1.2), oracle1);
        ASSERT_TRUE(solution.status().settled);
        const FluxBalance balance = flux_balance(solution.state(), *solution.field());
        EXPECT_NEAR(balance.emitted, 1000, 1);
        EXPECT_EQ(balance.on_backs, 0);
        EXPECT_EQ(balance.unsure, 0);
        EXPECT_NEAR(balance.lost_share(), 1 - balance.arriving * (1 - rho) / 1000, 1e-3);
        EXPECT_GT(balance.lost_share(), 0.02);
    }
}
