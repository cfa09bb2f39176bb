// The window's shaders against core/display: the same radiance and settings give the same bytes, within one step of
// 255.
#include "ui/renderer.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "core/display/false_colour.h"
#include "core/spectrum/colour.h"
#include "core/view/picture.h"
#include "tests/e2e/virtual_screen.h"
#include "ui/theme.h"
#include "ui/window.h"

namespace lueur {
namespace {

constexpr int side = 24;    // patches along an edge
constexpr int pixels = 384; // of the picture along an edge: 16 to a patch at the least

// One screen and one hidden window for all tests of the program.
class ShaderTest : public testing::Test {
protected:
    static void SetUpTestSuite() {
        screen_ = std::make_unique<test::VirtualScreen>(640, 480);
        WindowParams params;
        params.visible = false;
        auto window = Window::open(params);
        if (!window) GTEST_FAIL() << window.error();
        window_ = std::move(*window);
        auto renderer = Renderer::make();
        if (!renderer) GTEST_FAIL() << renderer.error();
        renderer_ = std::move(*renderer);
    }
    static void TearDownTestSuite() {
        renderer_.reset();
        window_.reset();
        screen_.reset();
    }
    static std::unique_ptr<test::VirtualScreen> screen_;
    static std::unique_ptr<Window> window_;
    static std::unique_ptr<Renderer> renderer_;
};
std::unique_ptr<test::VirtualScreen> ShaderTest::screen_;
std::unique_ptr<Window> ShaderTest::window_;
std::unique_ptr<Renderer> ShaderTest::renderer_;

// Square patches in the plane z = 0, facing +z, each of one radiance. One object a patch.
struct Chart {
    Snapshot snapshot;
    std::vector<glm::dvec3> centres;
    std::vector<glm::vec3> xyz;
};

Chart make_chart(const std::vector<glm::vec3>& xyz, std::optional<Texture> texture = {}) {
    auto scene = std::make_shared<Scene>();
    auto geometry = std::make_shared<Geometry>();
    auto mesh = std::make_shared<Mesh>();
    auto field = std::make_shared<Field>();
    scene->materials.push_back({"paint", 0.5, texture, false});
    Chart chart;
    chart.xyz = xyz;
    for (std::size_t i = 0; i < xyz.size(); ++i) {
        const auto x = static_cast<float>(i % side), y = static_cast<float>(i / side);
        const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
        for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
            const glm::vec3 position(x + corner.x, y + corner.y, 0);
            MeshVertex vertex;
            vertex.position = position;
            vertex.normal = {0, 0, 1};
            vertex.uv = corner;
            vertex.surface = static_cast<std::uint32_t>(i);
            mesh->vertices.push_back(vertex);
            geometry->vertices.push_back({position, {0, 0, 1}, corner});
            field->irradiance_xyz.emplace_back(0);
            field->reflected_xyz.push_back(0.25f * xyz[i]);
            field->emitted_xyz.push_back(texture ? glm::vec3(0) : 0.75f * xyz[i]);
            field->unshot.push_back(0);
            if (texture) { // in linear sRGB: what is reflected times texel / mean
                const Rgb rgb = rgb_from_xyz(srgb) * glm::dvec3(0.25f * xyz[i]);
                glm::dmat3 by_texel = xyz_from_rgb(srgb);
                for (int c = 0; c < 3; ++c) by_texel[c] *= rgb[c] / texture->mean[c];
                field->reflected_by_texel.emplace_back(by_texel);
            }
        }
        for (const glm::uvec3 triangle :
             {glm::uvec3(first, first + 1, first + 2), glm::uvec3(first, first + 2, first + 3)}) {
            mesh->elements.push_back(triangle);
            mesh->element_surface.push_back(static_cast<std::uint32_t>(i));
            mesh->element_back.push_back(0);
            mesh->element_coarse.push_back(static_cast<std::uint32_t>(i));
            mesh->coarse_patch.push_back(static_cast<std::uint32_t>(i));
            geometry->triangles.push_back(triangle);
            geometry->triangle_surface.push_back(SurfaceIndex(i));
        }
        geometry->surfaces.push_back({ObjectIndex(i), true});
        scene->objects.push_back({"patch " + std::to_string(i), MaterialIndex{0}});
        chart.centres.emplace_back(x + 0.5, y + 0.5, 0);
    }
    scene->geometry = geometry;
    chart.snapshot.scene = scene;
    chart.snapshot.mesh = mesh;
    chart.snapshot.field = field;
    return chart;
}

Camera front_camera() {
    Camera camera;
    camera.target = {0.5 * side, 0.5 * side, 0};
    camera.position = camera.target + glm::dvec3(0, 0, 1.3 * side);
    camera.vertical_fov_degrees = 45;
    return camera;
}

RenderParams params_for(const Camera& camera, const DisplaySettings& display, int samples) {
    RenderParams params;
    params.width = params.height = pixels;
    params.still = samples > 1;
    params.camera = camera;
    params.display = display;
    return params;
}

// What was drawn; a moving picture may have fewer pixels than were asked for. Rows from the bottom, as OpenGL keeps
// them.
struct Shown {
    int size = 0;
    std::vector<std::array<std::uint8_t, 4>> rgba;
    const std::array<std::uint8_t, 4>& at(const Camera& camera, const glm::dvec3& point) const {
        const auto clip = clip_from_world(camera, 1, 0.1, 1000) * glm::dvec4(point, 1);
        const auto x = static_cast<int>((0.5 + 0.5 * clip.x / clip.w) * size),
                   y = static_cast<int>((0.5 + 0.5 * clip.y / clip.w) * size);
        return rgba.at(static_cast<std::size_t>(y * size + x));
    }
};

Shown read_back(const Renderer::Picture& picture) {
    EXPECT_EQ(picture.width, picture.height);
    Shown shown{picture.width, {}};
    shown.rgba.resize(static_cast<std::size_t>(picture.width * picture.height));
    glBindTexture(GL_TEXTURE_2D, picture.texture);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, shown.rgba.data());
    return shown;
}

// Radiances from the darkest to far over MAXDISPLAY, of all chromaticities, some outside of sRGB.
std::vector<glm::vec3> random_radiances(std::uint32_t seed, double max_display) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<glm::vec3> result;
    for (int i = 0; i < side * side; ++i) {
        const double size = max_display * std::pow(10.0, 4.5 * unit(random) - 3.5);
        result.emplace_back(size * glm::dvec3(unit(random), unit(random), unit(random)));
    }
    result[0] = {0, 0, 0};
    return result;
}

void expect_same(const Chart& chart, const Camera& camera, const DisplaySettings& display, const Shown& shown) {
    const auto expected = display_image({side, static_cast<int>(chart.xyz.size()) / side, chart.xyz}, display);
    for (std::size_t i = 0; i < chart.xyz.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const int difference = std::abs(shown.at(camera, chart.centres[i])[c] - expected.rgb[i][c]);
            ASSERT_LE(difference, 1) << "patch " << i << " component " << c << " XYZ " << chart.xyz[i].x << " "
                                     << chart.xyz[i].y << " " << chart.xyz[i].z << " clip " << to_string(display.clip);
        }
}

TEST_F(ShaderTest, ShowsWhatTheFileWriterWrites) {
    std::uint32_t seed = 1;
    for (const double max_display : {0.5, 100.0, 20000.0}) {
        const auto chart = make_chart(random_radiances(seed++, max_display));
        renderer_->set_snapshot(chart.snapshot);
        for (const auto clip :
             {ClipRule::clamp, ClipRule::keep_chromaticity, ClipRule::desaturate, ClipRule::scale_all})
            for (const auto curve : {TransferCurve::srgb, TransferCurve::gamma})
                for (const double gamma : {0.6, 3.0}) {
                    if (curve == TransferCurve::srgb && gamma != 3.0) continue;
                    DisplaySettings display;
                    display.max_display = max_display;
                    display.clip = clip;
                    display.curve = curve;
                    display.gamma = glm::dvec3(gamma);
                    for (const int samples : {1, 4})
                        expect_same(chart, front_camera(), display,
                                    read_back(renderer_->draw(params_for(front_camera(), display, samples))));
                }
    }
}

TEST_F(ShaderTest, EveryOperatorClipCurveAndPrimariesAgreeWithTheFiles) {
    const RgbSpace own{{0.61, 0.35}, {0.29, 0.59}, {0.15, 0.063}, {0.28, 0.29}};
    DisplaySettings display;
    display.max_display = 30;
    display.adaptation_luminance = 6;
    display.gamma = {1.9, 2.2, 2.6};
    const auto chart = make_chart(random_radiances(100, display.max_display));
    renderer_->set_snapshot(chart.snapshot);
    int pictures = 0;
    for (const auto tone_operator : all_tone_operators)
        for (const auto clip : all_clip_rules)
            for (const auto curve : all_transfer_curves)
                for (const RgbSpace& primaries : {srgb, rec2020, display_p3, lecture_monitor, own}) {
                    display.tone_operator = tone_operator;
                    display.clip = clip;
                    display.curve = curve;
                    display.primaries = primaries;
                    const int samples = pictures++ % 8 == 0 ? 4 : 1; // more take longer
                    expect_same(chart, front_camera(), display,
                                read_back(renderer_->draw(params_for(front_camera(), display, samples))));
                    if (HasFatalFailure()) FAIL() << to_string(tone_operator) << " " << to_string(primaries);
                }
}

TEST_F(ShaderTest, EndsOfTheAllowedRangesAgreeWithTheFiles) {
    auto radiances = random_radiances(77, 100);
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    radiances[1] = {nan, 1, 1};
    radiances[2] = {1, infinity, 1};
    radiances[3] = {-1, -2, -3};
    radiances[4] = {1e30f, 1e30f, 1e30f};
    radiances[5] = {1e-30f, 1e-30f, 1e-30f};
    const auto chart = make_chart(radiances);
    renderer_->set_snapshot(chart.snapshot);
    for (const double max_display : {1e-30, 1e-6, 1e8, 1e30})
        for (const auto tone_operator : all_tone_operators)
            for (const auto clip : {ClipRule::clamp, ClipRule::keep_chromaticity, ClipRule::desaturate}) {
                DisplaySettings display;
                display.max_display = max_display;
                display.tone_operator = tone_operator;
                display.clip = clip;
                ASSERT_TRUE(check(display).empty());
                expect_same(chart, front_camera(), display,
                            read_back(renderer_->draw(params_for(front_camera(), display, 1))));
                if (HasFatalFailure()) FAIL() << to_string(tone_operator) << " MAXDISPLAY " << max_display;
            }
}

TEST_F(ShaderTest, FalseColoursAreTheFiles) {
    const auto luminances = random_radiances(21, 100);
    auto chart = make_chart(luminances);
    auto field = std::make_shared<Field>(*chart.snapshot.field);
    for (std::size_t v = 0; v < field->irradiance_xyz.size(); ++v)
        field->irradiance_xyz[v] = 5.0f * luminances[side * side - 1 - v / 4];
    chart.snapshot.field = field;
    renderer_->set_snapshot(chart.snapshot);
    for (const bool logarithmic : {true, false})
        for (const ViewMode view : {ViewMode::luminance, ViewMode::illuminance}) {
            DisplaySettings display;
            display.luminance_scale = {false, 1, 300, logarithmic, false, {}};
            display.illuminance_scale = {false, 20, 700, logarithmic, false, {}};
            RadianceImage image{side, side, luminances};
            if (view == ViewMode::illuminance)
                for (std::size_t i = 0; i < image.xyz.size(); ++i) image.xyz[i] = field->irradiance_xyz[4 * i];
            const auto expected = false_colour_image(image, view == ViewMode::luminance ? display.luminance_scale
                                                                                        : display.illuminance_scale);
            auto params = params_for(front_camera(), display, 4);
            params.view = view;
            const auto shown = read_back(renderer_->draw(params));
            for (std::size_t i = 0; i < expected.rgb.size(); ++i)
                for (std::size_t c = 0; c < 3; ++c)
                    ASSERT_LE(std::abs(shown.at(params.camera, chart.centres[i])[c] - expected.rgb[i][c]), 1)
                        << "patch " << i << " log " << logarithmic;
        }
}

// One square whose illuminance rises evenly from 1 to 1001 lx: the contours of the window are those of the file writer.
TEST_F(ShaderTest, IsoluxLinesAreTheFiles) {
    auto chart = make_chart({glm::vec3(10)});
    auto field = std::make_shared<Field>(*chart.snapshot.field);
    for (std::size_t v = 0; v < 4; ++v) field->irradiance_xyz[v] = glm::vec3(v == 0 || v == 3 ? 1.0f : 1001.0f);
    chart.snapshot.field = field;
    renderer_->set_snapshot(chart.snapshot);
    DisplaySettings display;
    display.illuminance_scale = {false, 1, 1000, false, true, {400, 500, 600}};
    auto params = params_for(front_camera(), display, 1);
    params.camera.target = {0.5, 0.5, 0};
    params.camera.position = {0.5, 0.5, 0.4}; // it fills the picture
    params.view = ViewMode::illuminance;
    const auto shown = read_back(renderer_->draw(params));
    RadianceImage image{shown.size, 1, {}};
    const double half = 0.4 * std::tan(glm::radians(22.5));
    for (int x = 0; x < shown.size; ++x) {
        const double place = 0.5 + half * (2 * (x + 0.5) / shown.size - 1);
        image.xyz.push_back(glm::vec3(static_cast<float>(1 + 1000 * place)));
    }
    const auto expected = false_colour_image(image, display.illuminance_scale);
    auto no_lines = display.illuminance_scale;
    no_lines.isolines = false;
    const auto plain = false_colour_image(image, no_lines);
    std::size_t lined = 0;
    for (int x = 1; x + 1 < shown.size; ++x) {
        const auto i = static_cast<std::size_t>(x);
        lined += expected.rgb[i] != plain.rgb[i];
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(
                shown.rgba[static_cast<std::size_t>(shown.size) * static_cast<std::size_t>(shown.size / 2) + i][c],
                expected.rgb[i][c], 2)
                << x;
    }
    EXPECT_GE(lined, 3u) << "there is something to compare";
}

TEST_F(ShaderTest, MarksAndSharesAreTheFiles) {
    const auto chart = make_chart(random_radiances(31, 100));
    renderer_->set_snapshot(chart.snapshot);
    DisplaySettings display;
    display.mark_clipped = display.mark_out_of_gamut = true;
    const auto params = params_for(front_camera(), display, 4);
    const auto picture = renderer_->draw(params);
    const auto shown = read_back(picture);
    const auto function = make_display_function(display);
    std::size_t marks = 0;
    for (std::size_t i = 0; i < chart.xyz.size(); ++i) {
        const auto clip = clip_from_world(params.camera, 1, 0.1, 1000) * glm::dvec4(chart.centres[i], 1);
        const auto x = static_cast<int>((0.5 + 0.5 * clip.x / clip.w) * shown.size),
                   y = shown.size - 1 - static_cast<int>((0.5 + 0.5 * clip.y / clip.w) * shown.size);
        const Rgb linear = linear_display_rgb(function, Xyz(chart.xyz[i]));
        const glm::dvec3 expected = marked(encoded_rgb(function, linear), faults_of(linear), display, x, y);
        marks += expected != encoded_rgb(function, linear);
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(shown.at(params.camera, chart.centres[i])[c], 255 * expected[static_cast<int>(c)], 1.01) << i;
    }
    EXPECT_GT(marks, 20u);
    const auto of_window = renderer_->shares(display), of_file = display_shares({side, side, chart.xyz}, display);
    EXPECT_NEAR(of_window.clipped, of_file.clipped, 0.03) << "the edges of patches lie within pixels";
    EXPECT_NEAR(of_window.out_of_gamut, of_file.out_of_gamut, 0.03);
    EXPECT_GT(of_file.clipped, 0.05);
    EXPECT_GT(of_file.out_of_gamut, 0.05);
}

TEST_F(ShaderTest, LuminanceIsAnotherLookAtTheSameMeshPass) {
    const auto chart = make_chart(random_radiances(3, 100));
    renderer_->set_snapshot(chart.snapshot);
    auto params = params_for(front_camera(), {}, 4);
    renderer_->draw(params);
    params.view = ViewMode::luminance;
    renderer_->draw(params);
    EXPECT_FALSE(renderer_->drew_mesh());
    params.view = ViewMode::illuminance;
    renderer_->draw(params);
    EXPECT_TRUE(renderer_->drew_mesh());
}

TEST_F(ShaderTest, MirroredCameraShowsTheSameLitSides) {
    const auto chart = make_chart(random_radiances(11, 100));
    renderer_->set_snapshot(chart.snapshot);
    auto camera = front_camera();
    camera.mirrored = true;
    const DisplaySettings display;
    expect_same(chart, camera, display, read_back(renderer_->draw(params_for(camera, display, 4))));
}

TEST_F(ShaderTest, BacksAreSeenThrough) {
    const auto chart = make_chart(std::vector<glm::vec3>(side * side, glm::vec3(50)));
    renderer_->set_snapshot(chart.snapshot);
    auto camera = front_camera();
    camera.position.z = -camera.position.z;
    const auto shown = read_back(renderer_->draw(params_for(camera, {}, 4)));
    const auto backdrop = static_cast<int>(std::lround(255 * colours::backdrop.x));
    for (const auto& pixel : shown.rgba) ASSERT_EQ(pixel[0], backdrop);
}

TEST_F(ShaderTest, TextureMultipliesWhatIsReflected) {
    auto image = std::make_shared<TextureImage>();
    image->width = image->height = 2;
    image->rgb.assign(4, glm::vec3(0.2f, 0.6f, 0.9f));
    Texture texture{"plain", image, Rgb(0.4, 0.3, 0.6)};
    auto radiances = random_radiances(5, 100);
    for (auto& xyz : radiances) xyz = glm::vec3(xyz_from_rgb(srgb) * glm::dvec3(glm::abs(xyz))); // inside sRGB
    auto chart = make_chart(radiances, texture);
    renderer_->set_snapshot(chart.snapshot);
    for (auto& xyz : chart.xyz) { // rgb * texel / mean, of the reflected quarter
        const Rgb rgb = rgb_from_xyz(srgb) * (0.25 * glm::dvec3(xyz));
        xyz = glm::vec3(xyz_from_rgb(srgb) * (rgb * glm::dvec3(0.5, 2.0, 1.5)));
    }
    const DisplaySettings display;
    expect_same(chart, front_camera(), display, read_back(renderer_->draw(params_for(front_camera(), display, 4))));
}

TEST_F(ShaderTest, AnotherGammaAloneDoesNotDrawTheMeshAgain) {
    const auto chart = make_chart(random_radiances(3, 100));
    renderer_->set_snapshot(chart.snapshot);
    DisplaySettings display;
    display.curve = TransferCurve::gamma;
    renderer_->draw(params_for(front_camera(), display, 4));
    EXPECT_TRUE(renderer_->drew_mesh());
    display.gamma = {1.7, 2.0, 2.6};
    display.max_display = 140;
    const auto shown = read_back(renderer_->draw(params_for(front_camera(), display, 4)));
    EXPECT_FALSE(renderer_->drew_mesh());
    expect_same(chart, front_camera(), display, shown);
}

TEST_F(ShaderTest, SelectedObjectIsOutlinedAndKeepsItsColour) {
    const auto chart = make_chart(std::vector<glm::vec3>(side * side, glm::vec3(20)));
    renderer_->set_snapshot(chart.snapshot);
    auto params = params_for(front_camera(), {}, 4);
    const auto plain = read_back(renderer_->draw(params));
    const std::size_t middle = side * (side / 2) + side / 2;
    params.selected = ObjectIndex(middle);
    const auto outlined = read_back(renderer_->draw(params));
    EXPECT_EQ(outlined.at(params.camera, chart.centres[middle]), plain.at(params.camera, chart.centres[middle]));
    std::size_t changed = 0;
    for (std::size_t i = 0; i < plain.rgba.size(); ++i) changed += plain.rgba[i] != outlined.rgba[i];
    EXPECT_GT(changed, 40u);
    EXPECT_LT(changed, 400u) << "an outline of a patch of some 15 pixels, no more";
}

TEST_F(ShaderTest, ElementsViewDrawsLinesAndUnshotViewItsScale) {
    auto chart = make_chart(std::vector<glm::vec3>(side * side, glm::vec3(20)));
    renderer_->set_snapshot(chart.snapshot);
    auto params = params_for(front_camera(), {}, 4);
    const auto shaded = read_back(renderer_->draw(params));
    params.view = ViewMode::elements;
    const auto lines = read_back(renderer_->draw(params));
    std::size_t changed = 0;
    for (std::size_t i = 0; i < shaded.rgba.size(); ++i) changed += shaded.rgba[i] != lines.rgba[i];
    EXPECT_GT(changed, shaded.rgba.size() / 20);
    EXPECT_LT(changed, shaded.rgba.size() / 2);

    auto field = std::make_shared<Field>(*chart.snapshot.field);
    for (std::size_t v = 0; v < field->unshot.size(); ++v) field->unshot[v] = v / 4 < side * side / 2 ? 100.0f : 1.0f;
    chart.snapshot.field = field;
    renderer_->set_snapshot(chart.snapshot);
    params.view = ViewMode::unshot;
    params.unshot_top = 100;
    const auto unshot = read_back(renderer_->draw(params));
    const auto &bright = unshot.at(params.camera, chart.centres.front()),
               &dim = unshot.at(params.camera, chart.centres.back());
    EXPECT_GT(bright[0], 240) << "the top of the scale is yellow";
    EXPECT_GT(bright[1], 220);
    EXPECT_LT(dim[0], 140) << "two decades below it is green";
    EXPECT_GT(dim[1], dim[0]);
}

} // namespace
} // namespace lueur
