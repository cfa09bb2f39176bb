// The solvers of the full matrix against closed forms, iterate by iterate, against each other, and where they must not
// converge.
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/solve/matrix_cases.h"

using namespace lueur;
using test::Method;

namespace {

void expect_near(const PatchField& b, int channel, const std::vector<double>& expected, double relative,
                 const std::string& what) {
    double largest = 0;
    for (const double value : expected) largest = std::max(largest, std::abs(value));
    for (std::uint32_t i = 0; i < b.count; ++i)
        EXPECT_NEAR(b[i][channel], expected[i], relative * largest) << what << ", patch " << i;
}

} // namespace

// B = E / (1 - rho) in any closed enclosure of one E and rho; after n bounces E (1 - rho^(n+1)) / (1 - rho).
TEST(MatrixSolvers, FurnaceAndItsBounces) {
    const FormFactorMatrix cube = test::cube();
    const std::vector<double> rhos{0, 0.1, 0.5, 0.9, 0.99};
    std::vector<std::vector<double>> rho, e;
    for (const double r : rhos) rho.push_back(std::vector<double>(6, r)), e.push_back(std::vector<double>(6, 1.0));
    for (const Method method : test::all_methods) {
        MatrixSystem system = test::system_of(cube, test::field_of(rho), test::field_of(e), 5);
        ASSERT_GT(test::converge(system, method, 1e-9, 100000), 0) << test::name(method);
        // Of five floats a row sum is off by 3e-8 at most, and 1 / (1 - rho) multiplies that.
        for (int c = 0; c < 5; ++c)
            expect_near(system.radiosity(), c, std::vector<double>(6, 1 / (1 - rhos[c])), 1e-7 + 3e-8 / (1 - rhos[c]),
                        test::name(method));
    }
    MatrixSystem jacobi = test::system_of(cube, test::field_of(rho), test::field_of(e), 5);
    for (int bounce = 1; bounce <= 10; ++bounce) {
        test::one_step(jacobi, Method::jacobi);
        for (int c = 0; c < 5; ++c)
            EXPECT_NEAR(jacobi.radiosity()[0][c], (1 - std::pow(rhos[c], bounce + 1)) / (1 - rhos[c]), 1e-6 * bounce);
    }
}

// Infinite parallel plates, F12 = F21 = 1: B1 = (E1 + rho1 E2) / (1 - rho1 rho2). Two unit squares at distance 1 in
// black space: the same with F. Concentric spheres, a = A1/A2, F22 = 1 - a: a patch that sees itself, so that
// K_ii = 1 - rho_i F_ii is not 1.
TEST(MatrixSolvers, PlatesAndSpheres) {
    struct Case {
        std::string what;
        FormFactorMatrix f;
        std::vector<double> rho, e, b;
    };
    const double F = 0.19982489569838738;
    const Case cases[] = {
        {"plates",
         test::matrix_of({1, 1}, {{0, 1}, {1, 0}}),
         {0.8, 0.3},
         {1, 0},
         {1.3157894736842106, 0.39473684210526316}},
        {"plates",
         test::matrix_of({1, 1}, {{0, 1}, {1, 0}}),
         {0.9, 0.2},
         {3, 1},
         {4.7560975609756095, 1.951219512195122}},
        {"squares",
         test::matrix_of({1, 1}, {{0, F}, {F, 0}}),
         {0.5, 0.8},
         {1, 0},
         {1.0162312408839456, 0.16245464137206178}},
        {"squares",
         test::matrix_of({1, 1}, {{0, F}, {F, 0}}),
         {0.9, 0.9},
         {1, 2},
         {1.405131385614422, 2.2527022093156392}},
        {"spheres",
         test::matrix_of({1, 4}, {{0, 1}, {0.25, 0.75}}),
         {0.3, 0.7},
         {1, 0},
         {1.1242603550295858, 0.41420118343195267}},
        {"spheres",
         test::matrix_of({1, 9}, {{0, 1}, {1 / 9., 8 / 9.}}),
         {0.5, 0.9},
         {0, 1},
         {3.3333333333333335, 6.666666666666667}},
        {"spheres",
         test::matrix_of({1, 4}, {{0, 1}, {0.25, 0.75}}),
         {0.2, 0.6},
         {1, 1},
         {1.4423076923076923, 2.2115384615384617}},
    };
    for (const Case& one : cases) {
        const PatchField rho = test::field_of({one.rho}), e = test::field_of({one.e});
        for (const Method method : test::all_methods) {
            MatrixSystem system = test::system_of(one.f, rho, e, 1);
            ASSERT_GT(test::converge(system, method, 1e-10, 10000), 0) << one.what << ' ' << test::name(method);
            expect_near(system.radiosity(), 0, one.b, 1e-6, one.what + ' ' + test::name(method));
        }
        expect_near(test::eliminated(one.f, rho, e, 1), 0, one.b, 1e-6, one.what + " elimination");
    }
}

// Sphere of radius 1 with rho and a source of flux Phi inside: F_ij = A_j / A, indirect irradiance
// rho Phi / (A (1 - rho)) everywhere, whatever the source lights first.
TEST(MatrixSolvers, IntegratingSphere) {
    const std::uint32_t n = 24;
    std::mt19937 random(7);
    std::vector<float> area(n);
    double all = 0;
    for (float& a : area) all += a = std::uniform_real_distribution<float>(0.1f, 1.0f)(random);
    std::vector<std::vector<double>> rows(n, std::vector<double>(n));
    for (auto& row : rows)
        for (std::uint32_t j = 0; j < n; ++j) row[j] = area[j] / all;
    const FormFactorMatrix sphere = test::matrix_of(area, rows);
    const double rho = 0.95, phi = 1000;
    // The source lights patch 3 only: its first reflection is what the sphere emits.
    std::vector<double> e(n, 0.0);
    e[3] = rho * phi / area[3];
    for (const Method method : test::all_methods) {
        MatrixSystem system =
            test::system_of(sphere, test::field_of({std::vector<double>(n, rho)}), test::field_of({e}), 1);
        ASSERT_GT(test::converge(system, method, 1e-9, 100000), 0) << test::name(method);
        for (std::uint32_t i = 0; i < n; ++i)
            EXPECT_NEAR(system.irradiance()[i][0] / (rho * phi / (all * (1 - rho))), 1, 2e-6) << test::name(method);
    }
}

// The exact 6x6 solution of the unit cube with one element a face and the iterates on the way, computed with 30 digits
// in mpmath. Jacobi and Gauss-Seidel start at B = E; a shot reports all B after it.
TEST(MatrixSolvers, CubeIterateByIterate) {
    const FormFactorMatrix cube = test::cube();
    const std::vector<double> rho{0.2, 0.7, 0.5, 0.5, 0.3, 0.9}, e{0, 10, 0, 0, 1, 0};
    const std::vector<double> exact{0.8342510748085994, 11.436818860493412, 1.9727851089675512,
                                    1.9727851089675512, 2.1716488121293356, 3.3101886859981455};
    const auto fresh = [&] { return test::system_of(cube, test::field_of({rho}), test::field_of({e}), 1); };

    MatrixSystem jacobi = fresh();
    test::one_step(jacobi, Method::jacobi);
    expect_near(jacobi.radiosity(), 0,
                {0.4396585466118554, 10.140030643252782, 1.1002407684147173, 1.1002407684147173, 1.6001313282262095,
                 1.980236390807177},
                1e-7, "Jacobi 1");
    test::one_step(jacobi, Method::jacobi);
    expect_near(jacobi.radiosity(), 0,
                {0.6365306959463845, 10.870994346099572, 1.526243375145073, 1.526243375145073, 1.8856882423922219,
                 2.5887057181404622},
                1e-7, "Jacobi 2");
    for (int sweep = 3; sweep <= 8; ++sweep) test::one_step(jacobi, Method::jacobi);
    expect_near(jacobi.radiosity(), 0,
                {0.8312065538742969, 11.42783024270646, 1.9659362523264357, 1.9659362523264357, 2.167245742412268,
                 3.299312825883845},
                1e-7, "Jacobi 8");

    MatrixSystem gauss = fresh();
    test::one_step(gauss, Method::gauss_seidel);
    expect_near(gauss.radiosity(), 0,
                {0.4396585466118554, 10.201528949506516, 1.1643735523626433, 1.2807089641900562, 1.7853480604231105,
                 2.677125472232761},
                1e-7, "Gauss-Seidel 1");
    test::one_step(gauss, Method::gauss_seidel);
    expect_near(gauss.radiosity(), 0,
                {0.684066610767079, 11.062954994278419, 1.7492630754054683, 1.7960774636068035, 2.0782294560010817,
                 3.1269814674233376},
                1e-7, "Gauss-Seidel 2");
    for (int sweep = 3; sweep <= 8; ++sweep) test::one_step(gauss, Method::gauss_seidel);
    expect_near(gauss.radiosity(), 0,
                {0.8341892897301284, 11.43667041161518, 1.9726967738927106, 1.9727140751954715, 2.171610422297008,
                 3.310115238811892},
                1e-7, "Gauss-Seidel 8");

    MatrixSystem shooting = fresh();
    struct Shot {
        std::uint32_t shooter;
        std::vector<double> b, unshot;
    };
    const Shot shots[] = {
        {1,
         {0.39964979139677476, 10.0, 1.0002188803770158, 1.0002188803770158, 1.6001313282262095, 1.8003939846786283},
         {0.39964979139677476, 0.0, 1.0002188803770158, 1.0002188803770158, 1.6001313282262095, 1.8003939846786283}},
        {5,
         {0.47168131362048565, 10.252110327782988, 1.180297685936293, 1.180297685936293, 1.7080603902875326,
          1.8003939846786283},
         {0.47168131362048565, 0.25211032778298803, 1.180297685936293, 1.180297685936293, 1.7080603902875326, 0.0}},
        {4,
         {0.5400186836680746, 10.49129112294955, 1.3511411110552654, 1.3511411110552654, 1.7080603902875326,
          2.107575675080806},
         {0.5400186836680746, 0.4912911229495495, 1.3511411110552654, 1.3511411110552654, 0.0, 0.30718169040217774}},
        {2,
         {0.5940761576413168, 10.680492281855898, 1.3511411110552654, 1.4861369268504763, 1.789146601247396,
          2.350834307960396},
         {0.5940761576413168, 0.6804922818558972, 0.0, 1.4861369268504763, 0.08108621095986328, 0.5504403232817676}}};
    for (const Shot& shot : shots) {
        ASSERT_TRUE(shooting.shoot(false));
        EXPECT_EQ(shooting.last_shooter(), shot.shooter);
        shooting.refresh();
        expect_near(shooting.radiosity(), 0, shot.b, 1e-7, fmt::format("shot of patch {}", shot.shooter));
        expect_near(shooting.unshot(), 0, shot.unshot, 1e-6, fmt::format("unshot after patch {}", shot.shooter));
    }

    for (const Method method : test::all_methods) {
        MatrixSystem system = fresh();
        ASSERT_GT(test::converge(system, method, 1e-10, 10000), 0);
        expect_near(system.radiosity(), 0, exact, 1e-7, test::name(method));
    }
    // Taken with a plus, as the lecture's pseudo code has it, the first row would give a negative radiosity.
    MatrixSystem wrong = fresh();
    test::converge(wrong, Method::gauss_seidel, 1e-10, 1000);
    for (std::uint32_t i = 0; i < 6; ++i) EXPECT_GT(wrong.radiosity()[i][0], 0);
}

// A scene in colours, all wavelengths at once: the cube with a red and a green wall, an open (black) front and the
// Cornell lamp. Three of its wavelengths, exact as above.
TEST(MatrixSolvers, SpectralCube) {
    const FormFactorMatrix cube = test::cube();
    const std::vector<std::vector<double>> rho{{0.745, 0.78, 0.06, 0.125, 0, 0.745},
                                               {0.747, 0.78, 0.058, 0.285, 0, 0.747},
                                               {0.725, 0.78, 0.057, 0.472, 0, 0.725}};
    const std::vector<std::vector<double>> e{
        {0, 20.106192982974676, 0, 0, 0, 0}, {0, 25.132741228718345, 0, 0, 0, 0}, {0, 29.907962062174832, 0, 0, 0, 0}};
    const std::vector<std::vector<double>> b{
        {3.9581384513892797, 21.513972011655312, 0.3622095969984594, 0.7450409233478924, 0, 3.9611916239076304},
        {5.232848963524629, 27.176541318622192, 0.4619705776627006, 2.1726069349861845, 0, 5.236714751812807},
        {6.367456778371509, 32.66036476144815, 0.5671056473261861, 4.340167527873046, 0, 6.3719831305415795}};
    for (const Method method : test::all_methods) {
        MatrixSystem system = test::system_of(cube, test::field_of(rho), test::field_of(e), 3);
        ASSERT_GT(test::converge(system, method, 1e-10, 10000), 0);
        for (int c = 0; c < 3; ++c) expect_near(system.radiosity(), c, b[c], 1e-6, test::name(method));
    }
}

TEST(MatrixSolvers, AllGiveTheSameRadiositiesOnTheSameFormFactors) {
    const std::uint32_t n = 150;
    const int channels = 11;
    const FormFactorMatrix f = test::enclosure(n, 5);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    PatchField rho(n, channels), e(n, channels);
    for (std::uint32_t i = 0; i < n; ++i)
        for (int c = 0; c < channels; ++c)
            rho[i][c] = i % 10 == 0 ? 0 : 0.95 * unit(random), e[i][c] = i % 50 == 7 ? unit(random) : 0;
    const PatchField exact = test::eliminated(f, rho, e, channels);
    EXPECT_LT(test::residual_of(f, exact, rho, e, channels), 1e-12);
    for (const Method method : test::all_methods) {
        MatrixSystem system = test::system_of(f, rho, e, channels);
        const int steps = test::converge(system, method, 1e-9, 1000000);
        ASSERT_GT(steps, 0) << test::name(method);
        printf("%-13s %6d %s to 1e-9 unshot\n", test::name(method).c_str(), steps,
               method == Method::jacobi || method == Method::gauss_seidel ? "sweeps" : "shots");
        for (int c = 0; c < channels; ++c) {
            std::vector<double> expected;
            for (std::uint32_t i = 0; i < n; ++i) expected.push_back(exact[i][c]);
            expect_near(system.radiosity(), c, expected, 1e-6, test::name(method));
        }
    }
}

// r_(k+1) = rho F r_k: the largest residual falls by rho row_sum or better with every sweep of Jacobi. Of Gauss-Seidel
// the same is proven for the error (Varga, Matrix iterative analysis, theorem 3.4), not for the residual.
TEST(MatrixSolvers, JacobiResidualAndGaussSeidelErrorFallBySweep) {
    const std::uint32_t n = 80;
    const FormFactorMatrix f = test::enclosure(n, 3);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0, 1);
    PatchField rho(n, 2), e(n, 2);
    for (std::uint32_t i = 0; i < n; ++i)
        for (int c = 0; c < 2; ++c) rho[i][c] = 0.9 * unit(random), e[i][c] = unit(random) < 0.05 ? 10 : 0;
    MatrixSystem exact = test::system_of(f, rho, e, 2);
    ASSERT_GT(test::converge(exact, Method::gauss_seidel, 1e-13, 10000), 0);
    const auto error = [&](const MatrixSystem& system) {
        double worst = 0;
        for (std::uint32_t i = 0; i < n; ++i)
            for (int c = 0; c < 2; ++c)
                worst = std::max(worst, std::abs(system.radiosity()[i][c] - exact.radiosity()[i][c]));
        return worst;
    };
    MatrixSystem jacobi = test::system_of(f, rho, e, 2), gauss = test::system_of(f, rho, e, 2);
    test::one_step(jacobi, Method::jacobi), test::one_step(gauss, Method::gauss_seidel);
    int ahead = 0;
    for (int sweep = 2; sweep < 20; ++sweep) {
        const double residual = jacobi.relative_residual(), gauss_error = error(gauss);
        test::one_step(jacobi, Method::jacobi), test::one_step(gauss, Method::gauss_seidel);
        EXPECT_LE(jacobi.relative_residual(), 0.9 * residual * (1 + 1e-9)) << sweep;
        EXPECT_LE(error(gauss), 0.9 * gauss_error + 1e-11) << sweep; // but for rounding of numbers near 10
        ahead += error(gauss) < error(jacobi);
        // The residual that is said, known without another application of F, is the residual there is.
        const PatchField before = gauss.radiosity();
        test::one_step(gauss, Method::gauss_seidel);
        EXPECT_NEAR(gauss.relative_residual(), test::residual_of(f, before, rho, e, 2),
                    1e-9 + 1e-6 * gauss.relative_residual());
    }
    EXPECT_EQ(ahead, 18) << "Gauss-Seidel is ahead of Jacobi";
}

// With reciprocal form factors the flux unshot, sign or no sign, falls with every shot, plain or over.
TEST(MatrixSolvers, UnshotFluxFallsWithEveryShot) {
    const std::uint32_t n = 60;
    const FormFactorMatrix f = test::enclosure(n, 9);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(0, 1);
    PatchField rho(n, 1), e(n, 1);
    for (std::uint32_t i = 0; i < n; ++i) rho[i][0] = 0.5 + 0.45 * unit(random), e[i][0] = i == 5 ? 100 : 0;
    int needed[2];
    for (const bool over : {false, true}) {
        MatrixSystem system = test::system_of(f, rho, e, 1);
        double before = system.unshot_share();
        EXPECT_NEAR(before, 1, 1e-12);
        int shots = 0;
        while (before > 1e-3) {
            ASSERT_TRUE(system.shoot(over));
            ASSERT_LT(system.unshot_share(), before) << "shot " << shots;
            before = system.unshot_share();
            ASSERT_LT(++shots, 100000);
        }
        needed[over] = shots;
        EXPECT_EQ(over, system.overshots() > 0);
        EXPECT_FALSE(system.overshooting_given_up());
    }
    // Shooting ahead gains nothing here to 0.1 % (534 shots and 535); to 1e-9, and on the Cornell box, it halves them.
    printf("enclosure of %u patches: shooting %d shots, overshooting %d\n", n, needed[0], needed[1]);
}

// Rows as rays make them: noisy, not reciprocal, with columns that carry more flux than their patch sends.
TEST(MatrixSolvers, ConvergeOnRowsThatAreNotReciprocal) {
    const std::uint32_t n = 120;
    FormFactorMatrix f = test::enclosure(n, 6);
    std::mt19937 random(8);
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) f.row(i)[j] *= std::uniform_real_distribution<float>(0, 2)(random);
    const RowSums sums = limit_row_sums(f);
    EXPECT_GT(sums.above, n / 4);
    EXPECT_GT(sums.largest, 1.05);
    PatchField rho(n, 1), e(n, 1);
    for (std::uint32_t i = 0; i < n; ++i) rho[i][0] = 0.9, e[i][0] = i == 5 ? 100 : 0;
    for (const Method method : test::all_methods) {
        MatrixSystem system = test::system_of(f, rho, e, 1);
        ASSERT_GT(test::converge(system, method, 1e-10, 1000000), 0) << test::name(method);
        EXPECT_LT(test::residual_of(f, system.radiosity(), rho, e, 1), 1e-8) << test::name(method);
    }
}

TEST(MatrixSolvers, RowsAboveOneAreScaledAndBrokenNumbersTakenOut) {
    // A failing hemicube: the sums of its delta form factors at few pixels are above 1.
    FormFactorMatrix f = test::cube();
    for (float& value : f.values) value *= 1.05f;
    f.row(2)[0] = std::numeric_limits<float>::quiet_NaN();
    f.row(3)[1] = -0.5f;
    f.row(4)[0] = std::numeric_limits<float>::infinity();
    const RowSums sums = limit_row_sums(f);
    EXPECT_EQ(sums.above, 3u);
    EXPECT_EQ(sums.broken, 3u);
    EXPECT_NEAR(sums.largest, 1.05, 1e-5);
    for (std::uint32_t i = 0; i < 6; ++i) EXPECT_LE(sums.sum[i], 1.0);
    const PatchField rho = test::field_of({std::vector<double>(6, 0.999)}), e = test::field_of({{0, 1, 0, 0, 0, 0}});
    for (const Method method : test::all_methods) {
        MatrixSystem system = test::system_of(f, rho, e, 1);
        ASSERT_GT(test::converge(system, method, 1e-6, 1000000), 0) << test::name(method);
        for (std::uint32_t i = 0; i < 6; ++i) EXPECT_TRUE(std::isfinite(system.radiosity()[i][0]));
    }
}

TEST(MatrixSolvers, NoFiniteSolutionIsFoundBeforeAnySweep) {
    FormFactorMatrix cube = test::cube();
    const RowSums closed = limit_row_sums(cube);
    const PatchField e = test::field_of({{0, 1, 0, 0, 0, 0}}), dark = test::field_of({std::vector<double>(6, 0.0)});
    const PatchField white = test::field_of({std::vector<double>(6, 1.0)});
    EXPECT_TRUE(has_no_finite_solution(cube, closed, white, e, 1));
    EXPECT_FALSE(has_no_finite_solution(cube, closed, white, dark, 1)) << "no light: black";
    EXPECT_FALSE(has_no_finite_solution(cube, closed, test::field_of({{1, 1, 1, 1, 1, 0.5}}), e, 1));
    EXPECT_FALSE(has_no_finite_solution(cube, closed, test::field_of({std::vector<double>(6, 1 - 1e-6)}), e, 1));
    FormFactorMatrix open = cube;
    for (std::uint32_t j = 0; j < 6; ++j) open.row(4)[j] *= 0.9f;
    EXPECT_FALSE(has_no_finite_solution(open, limit_row_sums(open), white, e, 1)) << "light leaves through a crack";
    // Two rooms that do not see each other: only one is closed and white, and it matters whether it has a lamp.
    std::vector<std::vector<double>> rows(4, std::vector<double>(4, 0.0));
    rows[0][1] = rows[1][0] = rows[2][3] = rows[3][2] = 1;
    FormFactorMatrix rooms = test::matrix_of({1, 1, 1, 1}, rows);
    const RowSums apart = limit_row_sums(rooms);
    const PatchField paints = test::field_of({{1, 1, 0.5, 0.5}});
    EXPECT_TRUE(has_no_finite_solution(rooms, apart, paints, test::field_of({{1, 0, 0, 0}}), 1));
    EXPECT_FALSE(has_no_finite_solution(rooms, apart, paints, test::field_of({{0, 0, 1, 0}}), 1));
}

TEST(MatrixSolvers, NewSourcesGoOnFromWhatWasSent) {
    const std::uint32_t n = 90;
    const FormFactorMatrix f = test::enclosure(n, 1);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto paints = [&](double most) {
        PatchField rho(n, 3);
        for (std::uint32_t i = 0; i < n; ++i)
            for (int c = 0; c < 3; ++c) rho[i][c] = most * unit(random);
        return rho;
    };
    PatchField lamp(n, 3), other_lamp(n, 3);
    for (int c = 0; c < 3; ++c) lamp[4][c] = 10 + c, other_lamp[50][c] = 3;
    const std::atomic<bool> never{false};
    for (const Method method : test::all_methods) {
        MatrixSystem system = test::system_of(f, paints(0.9), lamp, 3);
        for (int k = 0; k < 7; ++k) test::one_step(system, method);
        system.set_sources(paints(0.5), PatchField(n, 3)); // lights out
        test::converge(system, method, 1e-9, 100000);
        for (const double b : system.radiosity().values) ASSERT_EQ(b, 0) << test::name(method);
        system.set_sources(paints(0.8), lamp);
        for (int k = 0; k < 5; ++k) test::one_step(system, method);
        const PatchField rho = paints(0.7);
        system.set_sources(rho, other_lamp);
        ASSERT_GT(test::converge(system, method, 1e-10, 1000000), 0) << test::name(method);
        EXPECT_LT(test::residual_of(f, system.radiosity(), rho, other_lamp, 3), 1e-8) << test::name(method);
    }
}

TEST(MatrixSolvers, MemoryIsStatedAndRefused) {
    EXPECT_EQ(matrix_bytes(1000), 4'000'000u);
    EXPECT_EQ(matrix_bytes(100'000), 40'000'000'000u);
    const auto refused = make_form_factor_matrix(std::vector<float>(20'000, 1.0f), std::uint64_t(1) << 30);
    ASSERT_FALSE(refused.has_value());
    EXPECT_THAT(refused.error(), testing::HasSubstr("20000 patches take 1.49 GiB, and 1 GiB are allowed"));
}
