// What the words on the command line mean, and what is said of those that mean nothing.
#include "editor/commands/command_line.h"

#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lueur {
namespace {

using testing::HasSubstr;

CommandLine parse(std::vector<const char*> words) {
    words.insert(words.begin(), "lueur");
    return parse_command_line(static_cast<int>(words.size()), words.data());
}
template <typename Command>
Command parsed(std::vector<const char*> words) {
    const CommandLine line = parse(std::move(words));
    if (const auto* stop = std::get_if<ExitNow>(&line)) ADD_FAILURE() << stop->text;
    const auto* command = std::get_if<Command>(&line);
    EXPECT_NE(command, nullptr);
    return command ? *command : Command{};
}

TEST(CommandLine, WithoutWordsIsTheEditor) {
    const auto editor = parsed<EditorCommand>({});
    EXPECT_TRUE(editor.scene.empty());
    EXPECT_EQ(editor.threads, 0);
    EXPECT_EQ(with_overrides(SolveSettings{}, editor.solve), SolveSettings{});
}

TEST(CommandLine, OpensASceneInTheEditor) {
    const auto editor = parsed<EditorCommand>({"room.toml", "--solver", "shooting", "--wavelengths", "rgb", "--threads",
                                               "3", "--seed", "7", "--error", "1.5"});
    EXPECT_EQ(editor.scene, "room.toml");
    EXPECT_EQ(editor.threads, 3);
    const auto solve = with_overrides(SolveSettings{}, editor.solve);
    EXPECT_EQ(solve.solver, SolverKind::shooting);
    EXPECT_EQ(solve.wavelengths, (WavelengthsSpec{WavelengthRule::rgb, 3}));
    EXPECT_EQ(solve.seed, 7u);
    EXPECT_DOUBLE_EQ(solve.target_error, 0.015);
}

TEST(CommandLine, OverridesOnlyWhatIsSaid) {
    SolveSettings scene;
    scene.solver = SolverKind::shooting;
    scene.seed = 5;
    scene.max_rays = 64;
    const auto render = parsed<RenderCommand>({"render", "room.toml", "-o", "a.png", "--error", "4"});
    SolveSettings expected = scene;
    expected.target_error = 0.04;
    EXPECT_EQ(with_overrides(scene, render.batch.solve), expected);
}

TEST(CommandLine, Render) {
    const auto render =
        parsed<RenderCommand>({"render", "room.toml",     "-o",       "a.png",  "--size",     "640x480",    "--gamma",
                               "1.8",    "--max-display", "120",      "--clip", "desaturate", "--quantity", "luminance",
                               "--time", "2.5",           "--report", "r.json", "--solver",   "auto"});
    EXPECT_EQ(render.batch.scene, "room.toml");
    EXPECT_EQ(render.output, "a.png");
    EXPECT_EQ(render.width, 640);
    EXPECT_EQ(render.height, 480);
    EXPECT_EQ(render.gamma, 1.8);
    EXPECT_EQ(render.max_display, 120);
    EXPECT_FALSE(render.max_display_auto);
    EXPECT_EQ(render.clip, ClipRule::desaturate);
    EXPECT_EQ(render.quantity, PictureQuantity::luminance);
    EXPECT_EQ(render.batch.time_limit, 2.5);
    EXPECT_EQ(render.batch.report, "r.json");
    EXPECT_EQ(render.batch.solve.solver, SolverKind::gathering);
    EXPECT_TRUE(parsed<RenderCommand>({"render", "room.toml", "--output", "a.exr"}).batch.report.empty());
    EXPECT_TRUE(
        parsed<RenderCommand>({"render", "room.toml", "-o", "a.png", "--max-display", "auto"}).max_display_auto);
    EXPECT_EQ(parsed<RenderCommand>({"render", "room.toml", "-o", "a.png", "--curve", "gamma", "--gamma", "2"}).curve,
              TransferCurve::gamma);
}

TEST(CommandLine, Measure) {
    const auto plain = parsed<MeasureCommand>({"measure", "room.toml", "--points", "in.csv", "-o", "out.csv"});
    EXPECT_EQ(plain.points, "in.csv");
    EXPECT_EQ(plain.output, "out.csv");
    EXPECT_EQ(plain.at, MeasureAt::gather);
    EXPECT_EQ(parsed<MeasureCommand>({"measure", "r.toml", "--points", "i.csv", "-o", "o.csv", "--at", "field"}).at,
              MeasureAt::field);
    const auto reference = parsed<MeasureCommand>(
        {"measure", "r.toml", "--points", "i.csv", "-o", "o.csv", "--solver", "reference", "--rays", "5000"});
    EXPECT_EQ(reference.at, MeasureAt::reference);
    EXPECT_EQ(reference.rays, 5000);
    EXPECT_FALSE(reference.batch.solve.solver.has_value());
}

TEST(CommandLine, HelpAndVersionAreForStdout) {
    for (const std::vector<const char*>& words :
         {std::vector<const char*>{"--help"}, {"-h"}, {"render", "--help"}, {"measure", "--help"}, {"--version"}}) {
        const CommandLine line = parse(words);
        ASSERT_TRUE(std::holds_alternative<ExitNow>(line));
        EXPECT_EQ(std::get<ExitNow>(line).code, 0);
        EXPECT_THAT(std::get<ExitNow>(line).text, testing::EndsWith("\n"));
    }
    EXPECT_EQ(std::get<ExitNow>(parse({"--version"})).text, std::string("lueur ") + LUEUR_VERSION + "\n");
    const auto help = std::regex_replace(std::get<ExitNow>(parse({"render", "--help"})).text, std::regex("\\s+"), " ");
    for (const char* word : {"--output", "--size", "--gamma", "--max-display", "--clip", "--curve", "--quantity",
                             "--solver", "--wavelengths", "--error", "--time", "--threads", "--seed", "--report",
                             "clamp, keep_chromaticity, desaturate, scale_all", "cd/m2"})
        EXPECT_THAT(help, HasSubstr(word));
}

TEST(CommandLine, MistakesGetOneLineThatSaysWhatIsAllowed) {
    const std::pair<std::vector<const char*>, const char*> cases[] = {
        {{"--solver", "jacobi"}, "gathering, shooting, auto"},
        {{"--solver", "reference"}, "gathering, shooting, auto"}, // a way to measure only
        {{"--wavelengths", "uniform:99"}, "uniform"},
        {{"--frobnicate"}, "--frobnicate"},
        {{"a.toml", "b.toml"}, "b.toml"},
        {{"--seed", "3", "render", "a.toml", "-o", "a.png"}, "put it after render"},
        {{"render"}, "SCENE"},
        {{"render", "a.toml"}, "--output"},
        {{"render", "a.toml", "-o", "a.bmp"}, ".png, .jpg"},
        {{"render", "a.toml", "-o", ""}, "a file name is needed"},
        {{"render", "a.toml", "-o", "a.png", "--size", "640"}, "like 1280x800"},
        {{"render", "a.toml", "-o", "a.png", "--size", "0x5"}, "from 1 to 16384"},
        {{"render", "a.toml", "-o", "a.png", "--size", "64x48x2"}, "like 1280x800"},
        {{"render", "a.toml", "-o", "a.png", "--gamma", "0"}, "from 0.1 to 10"},
        {{"render", "a.toml", "-o", "a.png", "--gamma", "nan"}, "from 0.1 to 10"},
        {{"render", "a.toml", "-o", "a.png", "--gamma", "2.2x"}, "from 0.1 to 10"},
        {{"render", "a.toml", "-o", "a.png", "--gamma", "2", "--curve", "srgb"}, "does nothing with --curve srgb"},
        {{"render", "a.toml", "-o", "a.exr", "--gamma", "2"}, "does nothing in a.exr"},
        {{"render", "a.toml", "-o", "a.png", "--max-display", "0"}, "above 0"},
        {{"render", "a.toml", "-o", "a.png", "--max-display", "bright"}, "auto"},
        {{"render", "a.toml", "-o", "a.png", "--clip", "hard"}, "clamp, keep_chromaticity, desaturate, scale_all"},
        {{"render", "a.toml", "-o", "a.png", "--curve", "log"}, "gamma, srgb"},
        {{"render", "a.toml", "-o", "a.png", "--quantity", "lux"}, "colour, luminance, illuminance"},
        {{"render", "a.toml", "-o", "a.png", "--error", "0"}, "above 0"},
        {{"render", "a.toml", "-o", "a.png", "--time", "soon"}, "above 0"},
        {{"render", "a.toml", "-o", "a.png", "--threads", "0"}, "from 1 to 1024"},
        {{"render", "a.toml", "-o", "a.png", "--threads", "1.5"}, "from 1 to 1024"},
        {{"render", "a.toml", "-o", "a.png", "--seed", "4294967296"}, "from 0 to 4294967295"},
        {{"measure", "a.toml", "-o", "o.csv"}, "--points"},
        {{"measure", "a.toml", "--points", "i.csv"}, "--output"},
        {{"measure", "a.toml", "--points", "i.csv", "-o", "o.csv", "--at", "wall"}, "gather, field"},
        {{"measure", "a.toml", "--points", "i.csv", "-o", "o.csv", "--solver", "jacobi"},
         "gathering, shooting, auto, reference"},
        {{"measure", "a.toml", "--points", "i.csv", "-o", "o.csv", "--at", "field", "--rays", "9"},
         "does nothing with --at field"},
        {{"measure", "a.toml", "--points", "i.csv", "-o", "o.csv", "--solver", "reference", "--at", "field"},
         "does nothing with --solver reference"},
        {{"measure", "a.toml", "--points", "i.csv", "-o", "o.csv", "--solver", "reference", "--error", "1"},
         "does nothing with --solver reference"},
    };
    for (const auto& [words, says] : cases) {
        const CommandLine line = parse(words);
        std::string all;
        for (const char* word : words) all += std::string(" ") + word;
        ASSERT_TRUE(std::holds_alternative<ExitNow>(line)) << all;
        const auto& stop = std::get<ExitNow>(line);
        EXPECT_EQ(stop.code, 2) << all;
        EXPECT_THAT(stop.text, testing::StartsWith("lueur")) << all;
        EXPECT_THAT(stop.text, HasSubstr(says)) << all;
        EXPECT_EQ(stop.text.find('\n'), stop.text.size() - 1) << all << "\n" << stop.text;
    }
}

} // namespace
} // namespace lueur
