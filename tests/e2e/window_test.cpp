// The editor as a person meets it: a real window, a real mouse, the measured Cornell box, and the pixels on the screen.
#include <cmath>

#include <gtest/gtest.h>

#include "core/scene/scene_file.h"
#include "core/spectrum/colour.h"
#include "core/view/picture.h"
#include "editor/asset_path.h"
#include "tests/e2e/program.h"

namespace lueur {
namespace {

using test::Pixels;
using test::Program;

double linear(std::uint8_t value) {
    return srgb_decode(value / 255.0);
}

// Where a point in millimetres of the Cornell box's own axes is on the screen.
struct Projection {
    Camera camera;
    test::Box viewport;
    std::array<int, 2> operator()(double x, double y, double z) const {
        const double width = viewport.x1 - viewport.x0, height = viewport.y1 - viewport.y0;
        const auto clip =
            clip_from_world(camera, width / height, 0.01, 100) * glm::dvec4(0.001 * x, 0.001 * y, 0.001 * z, 1);
        return {static_cast<int>(viewport.x0 + (0.5 + 0.5 * clip.x / clip.w) * width),
                static_cast<int>(viewport.y0 + (0.5 - 0.5 * clip.y / clip.w) * height)};
    }
};

glm::dvec3 linear_mean(const Pixels& pixels, std::array<int, 2> place, int radius = 2) {
    glm::dvec3 sum(0);
    for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
            const auto& p = pixels.at(place[0] + dx, place[1] + dy);
            sum += glm::dvec3(linear(p[0]), linear(p[1]), linear(p[2]));
        }
    return sum / static_cast<double>((2 * radius + 1) * (2 * radius + 1));
}

bool flat_around(const Pixels& pixels, int x, int y) { // no edge within a pixel
    const auto& centre = pixels.at(x, y);
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            for (std::size_t c = 0; c < 3; ++c)
                if (std::abs(pixels.at(x + dx, y + dy)[c] - centre[c]) > 6) return false;
    return true;
}

TEST(Window, DimsRepaintsDisplaysAndSavesTheCornellBox) {
    const test::VirtualScreen screen(1280, 800);
    Program program(screen, {});
    ASSERT_TRUE(program.wait([](const nlohmann::json& json) { return json["settled"] == true; }, 120)) << "no picture";
    program.rest_hand();
    ASSERT_TRUE(program.wait_still());
    const auto scene = load_scene(default_scene_file())->scene;
    const Projection place{scene.camera, program.box("viewport")};
    // On the tall block: the side towards the red wall. On the floor, on the back wall, on the red wall.
    const auto block_side = place(447.5, 165, 326.5), floor = place(400, 0.1, 150), back = place(120, 400, 559),
               red_wall = place(553, 300, 300);

    // An idle editor: nothing moves, so nothing is computed and nothing drawn.
    const double before_rest = program.processor_seconds();
    Program::rest(3);
    EXPECT_LT((program.processor_seconds() - before_rest) / 3, 0.02) << "share of one core while idle";

    // The dimmer: the light that is there is the old one times the dimmer, at every pixel that is not clipped.
    const auto full = program.screen();
    program.click("tab:Luminaires");
    if (!program.has("dimmer:lamp")) program.click("tab:Luminaires");
    program.drag("dimmer:lamp", 0.99, 0.45);
    program.rest_hand();
    ASSERT_TRUE(program.wait_still());
    const double dimmer = program.layout()["dimmers"][0].get<double>();
    ASSERT_NEAR(dimmer, 0.45, 0.06);
    const auto dimmed = program.screen();
    for (const auto& spot : {block_side, floor, back, red_wall})
        for (int c = 0; c < 3; ++c) {
            const double was = linear_mean(full, spot)[c], is = linear_mean(dimmed, spot)[c];
            if (was < 0.02 || was > 0.9) continue; // too few steps of 255, or clipped
            EXPECT_NEAR(is / was, dimmer, 0.04) << "component " << c << " at " << spot[0] << "," << spot[1];
        }
    EXPECT_LT(linear_mean(dimmed, floor).g, 0.7 * linear_mean(full, floor).g);

    // Undo takes the whole drag back.
    program.hand("key ctrl+z");
    program.rest_hand();
    ASSERT_TRUE(program.wait_still());
    EXPECT_EQ(program.layout()["dimmers"][0], 1);
    const auto undone = program.screen();
    for (const auto& spot : {floor, back}) EXPECT_NEAR(linear_mean(undone, spot).g, linear_mean(full, spot).g, 0.01);

    // The red wall: a click selects it, and painted blue it throws blue on the block and no more red.
    program.click("tab:Materials");
    program.click(red_wall[0], red_wall[1]);
    ASSERT_TRUE(program.wait([](const nlohmann::json& json) { return !json["selected"].is_null(); }, 10))
        << "a click selects";
    program.click("reflectance_kind:Colour");
    program.drag("reflectance:Red", 0.5, 0.02);
    program.drag("reflectance:Green", 0.5, 0.1);
    program.drag("reflectance:Blue", 0.1, 0.95);
    program.hand("key Escape");
    program.rest_hand();
    ASSERT_TRUE(program.wait_still());
    const auto repainted = program.screen();
    const auto redness = [](const glm::dvec3& rgb) { return rgb.r / (rgb.r + rgb.g + rgb.b); };
    const auto blueness = [](const glm::dvec3& rgb) { return rgb.b / (rgb.r + rgb.g + rgb.b); };
    EXPECT_LT(redness(linear_mean(repainted, red_wall)), 0.5 * redness(linear_mean(undone, red_wall)));
    EXPECT_GT(blueness(linear_mean(repainted, red_wall)), blueness(linear_mean(undone, red_wall)) + 0.2);
    EXPECT_LT(redness(linear_mean(repainted, block_side, 1)), redness(linear_mean(undone, block_side, 1)) - 0.05)
        << "the block's side no longer gets red light from the wall";
    EXPECT_GT(blueness(linear_mean(repainted, block_side, 1)), blueness(linear_mean(undone, block_side, 1)) + 0.01);

    // Gamma: every pixel follows the curve, and nothing outside of the picture and its panel changes.
    program.click("tab:Display");
    program.rest_hand();
    ASSERT_TRUE(program.wait_still());
    const auto by_srgb = program.screen();
    const auto light = program.layout();
    program.click("curve:Gamma");
    program.drag("gamma", 0.6, 0.25);
    program.rest_hand();
    ASSERT_TRUE(program.wait_still());
    const auto facts = program.layout();
    ASSERT_EQ(facts["srgb_curve"], false);
    for (const char* work : {"rays", "sweeps", "snapshot_revision"})
        EXPECT_EQ(facts[work], light[work]) << "the display is no work for the solver";
    const double gamma = facts["gamma"].get<double>();
    ASSERT_GT(gamma, 1.1);
    ASSERT_LT(gamma, 2);
    const auto by_gamma = program.screen();
    std::size_t compared = 0, wrong = 0;
    const auto shown = [&](double encoded) {
        return 255 * std::pow(srgb_decode(std::clamp(encoded, 0.0, 255.0) / 255), 1 / gamma);
    };
    for (int y = static_cast<int>(place.viewport.y0) + 40; y < static_cast<int>(place.viewport.y1) - 80; ++y)
        for (int x = static_cast<int>(place.viewport.x0) + 8; x < static_cast<int>(place.viewport.x1) - 8; ++x) {
            // Where there is nothing the backdrop stays; on an edge samples are averaged after the curve.
            if (by_srgb.at(x, y) ==
                by_srgb.at(static_cast<int>(place.viewport.x0) + 30, static_cast<int>(place.viewport.y0) + 300))
                continue;
            if (!flat_around(by_srgb, x, y)) continue;
            ++compared;
            for (std::size_t c = 0; c < 3; ++c) {
                const double was = by_srgb.at(x, y)[c];
                const double is = by_gamma.at(x, y)[c]; // both are rounded to whole steps
                wrong += is < shown(was - 0.5) - 1 || is > shown(was + 0.5) + 1;
            }
        }
    EXPECT_GT(compared, 100000u);
    EXPECT_EQ(wrong, 0u) << "of " << compared;
    const auto upper = program.box("tab:Materials");
    std::size_t changed = 0;
    for (int y = static_cast<int>(upper.y0); y < static_cast<int>(program.box("tab:Display").y0) - 4; ++y)
        for (int x = static_cast<int>(upper.x0); x < 1280; ++x) changed += by_srgb.at(x, y) != by_gamma.at(x, y);
    EXPECT_EQ(changed, 0u) << "pixels of the materials panel";

    // The saved picture is the picture on the screen.
    program.hand("key p");
    std::filesystem::path saved;
    for (int i = 0; i < 600 && saved.empty(); ++i) {
        Program::rest(0.1);
        for (const auto& file : std::filesystem::directory_iterator(program.folder()))
            if (file.path().extension() == ".png") saved = file.path();
    }
    ASSERT_FALSE(saved.empty());
    const auto metadata = read_image_metadata(saved);
    ASSERT_TRUE(metadata.has_value()) << metadata.error();
    EXPECT_EQ(metadata->at("lueur:curve"), "gamma");
    EXPECT_NEAR(std::stod(metadata->at("lueur:gamma")), gamma, 1e-4);
    const auto picture = read_texture(saved);
    ASSERT_TRUE(picture.has_value()) << picture.error();
    ASSERT_EQ(picture->width, static_cast<int>(place.viewport.x1 - place.viewport.x0));
    ASSERT_EQ(picture->height, static_cast<int>(place.viewport.y1 - place.viewport.y0));
    for (const auto& spot : {floor, back, red_wall}) {
        const auto index = static_cast<std::size_t>(spot[1] - static_cast<int>(place.viewport.y0)) *
                               static_cast<std::size_t>(picture->width) +
                           static_cast<std::size_t>(spot[0] - static_cast<int>(place.viewport.x0));
        for (int c = 0; c < 3; ++c) {
            const double in_file = 255 * srgb_encode(static_cast<double>(picture->rgb[index][c]));
            EXPECT_NEAR(in_file, by_gamma.at(spot[0], spot[1])[static_cast<std::size_t>(c)], 2.5) << "component " << c;
        }
    }

    // Unsaved changes are asked about before the window closes.
    program.rest_hand();
    program.hand("key ctrl+q");
    program.click("unsaved:cancel");
    EXPECT_EQ(program.wait_end(0.5), -1) << "cancelled: still there";
    program.hand("key ctrl+q");
    program.click("unsaved:discard");
    EXPECT_EQ(program.wait_end(20), 0);
}

TEST(Window, WithoutADisplayItSaysSoAndEnds) {
    const auto output = std::filesystem::temp_directory_path() / fmt::format("lueur-no-display-{}", getpid());
    const auto command =
        fmt::format("env -u DISPLAY -u WAYLAND_DISPLAY {} 2> {} > /dev/null", LUEUR_PROGRAM, output.string());
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1);
    std::ifstream stream(output);
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    EXPECT_NE(text.find("no display"), std::string::npos) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    std::filesystem::remove(output);
}

TEST(Window, ABadFileIsToldAndTheSceneStays) {
    const test::VirtualScreen screen(1280, 800);
    Program program(screen, {(std::filesystem::temp_directory_path() / "lueur is not there.toml").string()});
    program.box("errors:close");
    Program::rest(0.5); // the box has found its place
    program.click("errors:close");
    EXPECT_TRUE(program.wait([](const nlohmann::json& json) { return !json["widgets"].contains("errors:close"); }, 20));
    program.hand("key ctrl+q");
    EXPECT_EQ(program.wait_end(20), 0);
}

} // namespace
} // namespace lueur
