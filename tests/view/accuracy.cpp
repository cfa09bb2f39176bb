// The field and the gathering at points against traced paths, and pictures against the field.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/scene/scene_file.h"
#include "core/solve/solution_state.h"
#include "core/spectrum/observer.h"
#include "core/spectrum/rgb_basis.h"
#include "core/view/measure.h"
#include "core/view/picture.h"
#include "core/view/radiance_channels.h"
#include "core/view/spectral_picture.h"
#include "tests/support/scenes.h"
#include "tests/support/source_folder.h"
#include "tests/support/stored_irradiance.h"

using namespace lueur;

namespace {

struct Errors {
    double rms = 0, median = 0, percentile99 = 0, worst_point = 0;
    int counted = 0;
};

// Relative errors of the points brighter than 2 % of the mean.
Errors relative_errors(const std::vector<Irradiance>& values, const std::vector<Irradiance>& truth) {
    double mean = 0;
    for (const Irradiance& t : truth) mean += t.illuminance_lx / double(truth.size());
    std::vector<double> errors;
    for (std::size_t i = 0; i < truth.size(); ++i)
        if (truth[i].illuminance_lx > 0.02 * mean && !std::isnan(values[i].illuminance_lx))
            errors.push_back(std::abs(values[i].illuminance_lx / truth[i].illuminance_lx - 1));
    std::sort(errors.begin(), errors.end());
    Errors result;
    for (const double e : errors) result.rms += e * e / double(errors.size());
    result.rms = std::sqrt(result.rms);
    result.median = errors[errors.size() / 2];
    result.percentile99 = errors[errors.size() * 99 / 100];
    result.worst_point = errors.back();
    result.counted = static_cast<int>(errors.size());
    return result;
}

} // namespace

// 1,000 random surface points of the measured Cornell box: 5 % RMS, 1.5 % median, both for what the window shows and
// for gathering at points.
TEST(Accuracy, CornellBoxAgainstTracedPaths) {
    auto loaded = load_scene(test::source_folder() / "assets/cornell.toml");
    ASSERT_TRUE(loaded) << loaded.error().front();
    Solution solution(std::make_shared<const Scene>(loaded->scene));
    test::settle(solution);
    ASSERT_TRUE(solution.status().settled);
    const auto [points, truth] = test::stored_irradiance("cornell_illuminance.csv"); // to 0.3 % a point
    ASSERT_EQ(points.size(), 1000u);
    const Errors field =
        relative_errors(measure_points(solution, points, {MeasureAt::field, 0, 1}, test::never), truth);
    const Errors gather =
        relative_errors(measure_points(solution, points, {MeasureAt::gather, 1024, 1}, test::never), truth);
    RecordProperty("field_rms_percent", std::to_string(100 * field.rms));
    printf("Cornell box, %d points: field %.2f %% RMS, %.2f %% median, %.1f %% p99, %.0f %% worst; gathering %.2f %% "
           "RMS, %.2f %% "
           "median\n",
           field.counted, 100 * field.rms, 100 * field.median, 100 * field.percentile99, 100 * field.worst_point,
           100 * gather.rms, 100 * gather.median);
    EXPECT_GT(field.counted, 900);
    EXPECT_LT(field.rms, 0.05);
    EXPECT_LT(field.median, 0.015);
    EXPECT_LT(field.percentile99, 0.1); // contacts and penumbrae
    EXPECT_LT(gather.rms, 0.05);
    EXPECT_LT(gather.median, 0.015);
}

// What is stored is what the path tracer says of the scene as it is: the deviations, in standard errors, are a normal
// distribution's.
TEST(Accuracy, StoredIrradianceIsOfToday) {
    auto loaded = load_scene(test::source_folder() / "assets/cornell.toml");
    ASSERT_TRUE(loaded) << loaded.error().front();
    Solution solution(std::make_shared<const Scene>(loaded->scene));
    while (!solution.world()) solution.step(test::never);
    auto [points, truth] = test::stored_irradiance("cornell_illuminance.csv");
    ASSERT_EQ(points.size(), 1000u);
    points.resize(300);
    const auto traced = measure_points(solution, points, {MeasureAt::reference, 256, 4}, test::never);
    double sum = 0, square = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double error = std::hypot(truth[i].illuminance_lx * truth[i].standard_error_percent,
                                        traced[i].illuminance_lx * traced[i].standard_error_percent) /
                             100;
        const double deviation = (traced[i].illuminance_lx - truth[i].illuminance_lx) / error;
        sum += deviation, square += deviation * deviation;
    }
    EXPECT_LT(std::abs(sum / 300), 3.5 / std::sqrt(300.0));
    EXPECT_NEAR(square / 300, 1.15, 0.45); // 16 batches know their error to 18 %
}

// A cube lit by its ceiling, rho = 0.8: radiosity with gradients agrees with traced paths on the mean of a wall. One
// constant element a wall (the 6 x 6 closed form, tests/solve) is 2 to 6 % away from both: its assumption, not its
// arithmetic, is wrong.
TEST(Accuracy, ContinuousCubeAgreesWithPathsAndNotWithOneElementAWall) {
    test::SceneBuilder b;
    const auto faces = b.room("cube", test::all(b.material("wall", 0.8)), glm::vec3(0), glm::vec3(1));
    b.light("ceiling", {faces[1]}, PowerUnit::exitance, 1);
    const Solution solution = test::solved(b.build());
    std::vector<MeasurePoint> floor;
    for (int i = 0; i < 12; ++i)
        for (int k = 0; k < 12; ++k) floor.push_back({{(i + 0.5) / 12, 0, (k + 0.5) / 12}, {0, 1, 0}});
    const auto mean = [&](const MeasureParams& params) {
        double sum = 0;
        for (const Irradiance& h : measure_points(solution, floor, params, test::never))
            sum += h.irradiance_w_m2 / double(floor.size());
        return sum;
    };
    const double traced = mean({MeasureAt::reference, 2048, 3}), one_element_a_wall = 0.86193883842204693;
    EXPECT_NEAR(mean({MeasureAt::field, 0, 1}) / traced, 1, 0.006);
    EXPECT_NEAR(mean({MeasureAt::gather, 256, 1}) / traced, 1, 0.006);
    EXPECT_GT(std::abs(one_element_a_wall / traced - 1), 0.02);
}

// The path tracer itself, where the answer is known: a furnace, 1 / (1 - rho).
TEST(PathTracer, Furnace) {
    const Solution solution = test::solved(test::furnace(0.5));
    const std::vector<MeasurePoint> points{
        {{0.5, 0, 0.5}, {0, 1, 0}}, {{0.1, 0, 0.05}, {0, 1, 0}}, {{1, 0.3, 0.6}, {-1, 0, 0}}};
    for (const Irradiance& h : measure_points(solution, points, {MeasureAt::reference, 20000, 1}, test::never)) {
        EXPECT_NEAR(h.irradiance_w_m2, 2, 0.04);
        EXPECT_GT(h.standard_error_percent, 0);
        EXPECT_NEAR(h.irradiance_w_m2, 2, 4 * 2 * h.standard_error_percent / 100);
    }
    for (const Irradiance& h : measure_points(solution, points, {MeasureAt::gather, 256, 1}, test::never))
        EXPECT_NEAR(h.irradiance_w_m2, 2, 0.002);
    for (const Irradiance& h : measure_points(solution, points, {MeasureAt::field, 0, 1}, test::never))
        EXPECT_NEAR(h.irradiance_w_m2, 2, 0.002);
}

TEST(Measure, OffTheSurfaceTheFieldIsNotANumber) {
    const Solution solution = test::solved(test::furnace(0.5));
    const auto h =
        measure_points(solution, std::vector<MeasurePoint>{{{0.5, 0.5, 0.5}, {0, 1, 0}}, {{0.5, 0, 0.5}, {0, -1, 0}}},
                       {MeasureAt::field, 0, 1}, test::never);
    EXPECT_TRUE(std::isnan(h[0].illuminance_lx));
    EXPECT_TRUE(std::isnan(h[1].illuminance_lx));
}

TEST(Measure, CancelledGivesNothing) {
    const Solution solution = test::solved(test::furnace(0.5));
    const std::atomic<bool> always{true};
    EXPECT_TRUE(measure_points(solution, std::vector<MeasurePoint>{{{0.5, 0, 0.5}, {0, 1, 0}}}, {}, always).empty());
}

TEST(Picture, FurnaceIsOneColour) {
    const Solution solution = test::solved(test::furnace(0.5));
    const FieldView view{solution.scene(), solution.mesh(), solution.world(), solution.field()};
    Camera camera;
    camera.position = {0.3, 0.4, 0.2};
    camera.target = {0.9, 0.6, 0.8};
    const RadianceImage image = render_picture(view, camera, {64, 40, 2}, PictureQuantity::colour, test::never);
    ASSERT_EQ(image.xyz.size(), 64u * 40u);
    // L = B / pi, B = 2 W/m2 of a flat spectrum: 2 * 683 * 106.857 / 400 lm/m2.
    for (const glm::vec3& xyz : image.xyz) EXPECT_NEAR(xyz.y / (2 * 683 * 106.857 / 400 / M_PI), 1, 2e-3);
    const RadianceImage lux = render_picture(view, camera, {8, 5, 1}, PictureQuantity::illuminance, test::never);
    for (const glm::vec3& xyz : lux.xyz) EXPECT_NEAR(xyz.y / (2 * 683 * 106.857 / 400), 1, 2e-3);
    const std::atomic<bool> always{true};
    EXPECT_TRUE(render_picture(view, camera, {64, 40, 2}, PictureQuantity::colour, always).xyz.empty());
}

// The channels of a radiance add up to the XYZ that the picture shows, on lamps, paints and textures.
TEST(Picture, RadianceInChannelsIsTheRadianceShown) {
    auto loaded = load_scene(test::source_folder() / "assets/cornell.toml");
    ASSERT_TRUE(loaded);
    Scene scene = loaded->scene;
    auto image = std::make_shared<TextureImage>();
    image->width = 2, image->height = 1;
    image->rgb = {glm::vec3(0.1f, 0.5f, 0.3f), glm::vec3(0.7f, 0.5f, 0.9f)};
    scene.materials[0].texture = Texture{"checker", image, Rgb(0.4, 0.5, 0.6)};
    scene.solve.compare_trichromatic = true;
    const Solution solution = test::solved(scene);
    const FieldView view{solution.scene(), solution.mesh(), solution.world(), solution.field()};
    const RadianceChannels radiance(*view.scene, *view.field->wavelengths);
    int points = 0, lamps = 0, textured = 0, different = 0;
    for (int i = 0; i < 400; ++i) {
        const auto point =
            field_along_ray(view, camera_ray(scene.camera, 1.6, (i % 20 + 0.5) / 20, (i / 20 + 0.5) / 20));
        if (!point) continue;
        const auto channels = radiance.at(*view.scene, *view.field, *point);
        EXPECT_EQ(channels, radiance_channels(*view.scene, *view.field, *point));
        const Xyz xyz = xyz_from_channels(*view.field->wavelengths, channels);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(xyz[c], point->radiance[c], 2e-4 * point->radiance.y + 1e-6);
        ++points, lamps += point->emitted.y > 0, textured += point->texel.has_value();
        different += point->colour_difference > 0.1f;
    }
    EXPECT_GT(points, 200);
    EXPECT_GT(lamps, 0);
    EXPECT_GT(textured, 0);
    EXPECT_GT(different, 20) << "the trichromatic approach is not the spectral one";
}

Scene textured_furnace(const Rgb& mean) {
    Scene scene = test::furnace(0.4);
    auto image = std::make_shared<TextureImage>();
    image->width = 2, image->height = 1;
    image->rgb = {glm::vec3(0.2f), glm::vec3(0.6f)};
    scene.materials[0].texture = Texture{"checker", image, mean};
    scene.materials[0].reflectance = mean;
    return scene;
}

// The solution is that of the mean; a texel reflects what arrives, wavelength by wavelength: L = sum_k w_k rho_k H_k /
// pi.
TEST(Picture, TexelsReflectWhatArrivesAtEveryWavelength) {
    const Rgb mean(0.5, 0.3, 0.4);
    const Solution solution = test::solved(textured_furnace(mean));
    const auto field = solution.field();
    ASSERT_EQ(field->reflected_by_texel.size(), solution.mesh()->vertices.size());
    const Wavelengths& wavelengths = *field->wavelengths;
    for (const Rgb& texel : {Rgb(0.2), Rgb(0.6), Rgb(0.9, 0.05, 0.1), Rgb(0, 0, 1), Rgb(0), mean}) {
        const std::vector<double> rho = reflectance_channels(wavelengths, reflectance_from_texel(texel));
        for (std::uint32_t v = 0; v < field->irradiance.count; v += 7) {
            Xyz expected(0);
            for (std::size_t k = 0; k < rho.size(); ++k)
                expected += wavelengths.xyz_weight[k] * rho[k] * double(field->irradiance[v][k]) / M_PI;
            const Xyz seen(field->reflected_by_texel[v] * glm::vec3(texel));
            EXPECT_LT(glm::distance(seen, expected), 1e-4 * glm::length(Xyz(field->reflected_xyz[v])));
            if (texel == mean) {
                EXPECT_LT(glm::distance(seen, Xyz(field->reflected_xyz[v])), 1e-4 * glm::length(seen));
            }
        }
    }
}

// Two texels side by side in a picture, half as bright and half as bright again as their mean; between them a mixture.
TEST(Picture, TexturesModulateTheMean) {
    Scene scene = textured_furnace(Rgb(0.4));
    auto geometry = std::make_shared<Geometry>(*scene.geometry);
    for (Vertex& vertex : geometry->vertices) vertex.uv = {vertex.position.x + vertex.position.y, 0.5f};
    scene.geometry = geometry;
    const Solution solution = test::solved(scene);
    const FieldView view{solution.scene(), solution.mesh(), solution.world(), solution.field()};
    int looked_at = 0;
    for (float x = 0.03f; x < 1; x += 0.07f)
        for (float y = 0.04f; y < 1; y += 0.09f) {
            const auto point = field_along_ray(view, {{x, y, 0.5f}, {0, 0, -1}});
            ASSERT_TRUE(point);
            const double u = point->uv.x * 2 - 0.5, t = u - std::floor(u); // bilinear, repeating
            const double left = static_cast<int>(std::floor(u)) % 2 == 0 ? 0.2 : 0.6, right = 0.8 - left;
            const double white = point->irradiance.y / M_PI, emitted = solution.field()->emitted_xyz[0].y;
            EXPECT_NEAR(point->radiance.y, emitted + ((1 - t) * left + t * right) * white, 2e-3 * white);
            ++looked_at;
        }
    EXPECT_GT(looked_at, 100);
}

// The planes are means of 10 nm: their watts are the picture's, and their XYZ are its colour but for what the observer
// changes within 10 nm.
TEST(Picture, SpectralPlanesAddUpToThePicture) {
    for (const WavelengthsSpec& spec : {WavelengthsSpec{WavelengthRule::automatic, 0}, {WavelengthRule::uniform, 31}}) {
        Scene scene = textured_furnace(Rgb(0.5, 0.3, 0.4));
        scene.luminaires[0].spectrum = Blackbody{3000};
        scene.solve.wavelengths = spec;
        const Solution solution = test::solved(scene);
        const FieldView view{solution.scene(), solution.mesh(), solution.world(), solution.field()};
        Camera camera;
        camera.position = {0.3, 0.4, 0.2};
        camera.target = {0.9, 0.6, 0.8};
        const PictureParams params{16, 10, 1};
        const RadianceImage image = render_picture(view, camera, params, PictureQuantity::colour, test::never);
        const SpectralImage spectral = render_spectral_picture(view, camera, params, test::never);
        ASSERT_EQ(spectral.planes.size(), 41u);
        for (std::size_t pixel = 0; pixel < image.xyz.size(); pixel += 7) {
            Xyz xyz(0);
            for (std::size_t plane = 0; plane < spectral.nm.size(); ++plane)
                xyz += luminous_efficacy_km * spectral_picture_step_nm * double(spectral.planes[plane][pixel]) *
                       observer_xyz(spectral.nm[plane]);
            EXPECT_LT(glm::distance(xyz, Xyz(image.xyz[pixel])), 0.02 * glm::length(xyz)) << to_string(spec);
        }
    }
    Scene rgb = test::furnace(0.5);
    rgb.solve.wavelengths = {WavelengthRule::rgb, 3};
    const Solution solution = test::solved(rgb);
    const FieldView view{solution.scene(), solution.mesh(), solution.world(), solution.field()};
    EXPECT_TRUE(
        render_spectral_picture(view, {}, {4, 4, 1}, test::never).planes.empty()); // three channels are no spectrum
}

TEST(Picture, ABlackMeanUnderATextureShowsBlackNotInfinity) {
    const Solution solution = test::solved(textured_furnace(Rgb(0)));
    const auto field = solution.field();
    ASSERT_FALSE(field->reflected_by_texel.empty());
    for (const glm::mat3& by_texel : field->reflected_by_texel) ASSERT_EQ(by_texel, glm::mat3(0));
}

TEST(CameraRay, AgreesWithTheProjectionMatrix) {
    Camera camera;
    camera.position = {1, 2, 3};
    camera.target = {-2, 1, 7};
    camera.vertical_fov_degrees = 37;
    const double aspect = 1.6;
    const glm::dmat4 clip = clip_from_world(camera, aspect, 0.1, 100);
    for (const auto& [x, y] : {std::pair{0.5, 0.5}, {0.0, 0.0}, {0.9, 0.2}, {1.0, 1.0}}) {
        const Ray ray = camera_ray(camera, aspect, x, y);
        const glm::dvec4 p = clip * glm::dvec4(glm::dvec3(ray.origin) + 5.0 * glm::dvec3(ray.direction), 1);
        EXPECT_NEAR(p.x / p.w, 2 * x - 1, 1e-5);
        EXPECT_NEAR(p.y / p.w, 1 - 2 * y, 1e-5);
        EXPECT_LT(std::abs(p.z / p.w), 1);
    }
    camera.target = camera.position + glm::dvec3(0, -5, 0); // straight down
    const Ray down = camera_ray(camera, aspect, 0.5, 0.5);
    EXPECT_NEAR(down.direction.y, -1, 1e-6);
    camera.target = camera.position; // nowhere: still a direction
    EXPECT_NEAR(glm::length(camera_ray(camera, aspect, 0.5, 0.5).direction), 1, 1e-6);
}
