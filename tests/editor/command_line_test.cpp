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
    EXPECT_EQ(render.gamma, glm::dvec3(1.8));
    EXPECT_EQ(render.max_display, 120);
    EXPECT_FALSE(render.max_display_rule.has_value());
    EXPECT_EQ(render.clip, ClipRule::desaturate);
    EXPECT_EQ(render.quantity, PictureQuantity::luminance);
    EXPECT_EQ(render.batch.time_limit, 2.5);
    EXPECT_EQ(render.batch.report, "r.json");
    EXPECT_EQ(render.batch.solve.solver, SolverKind::automatic);
    EXPECT_TRUE(parsed<RenderCommand>({"render", "room.toml", "--output", "a.exr"}).batch.report.empty());
    EXPECT_EQ(parsed<RenderCommand>({"render", "room.toml", "-o", "a.png", "--max-display", "auto"}).max_display_rule,
              MaxDisplayRule::percentile);
    EXPECT_EQ(parsed<RenderCommand>({"render", "room.toml", "-o", "a.png", "--curve", "gamma", "--gamma", "2"}).curve,
              TransferCurve::gamma);
}

TEST(CommandLine, RenderDisplay) {
    const auto render =
        parsed<RenderCommand>({"render",     "room.toml",         "-o",           "a.tif",         "--bits",
                               "16",         "--gamma",           "1.8,2,2.4",    "--max-display", "p95",
                               "--operator", "tumblin_rushmeier", "--adaptation", "12.5",          "--white-luminance",
                               "200",        "--primaries",       "display_p3",   "--mark",        "gamut,clipped"});
    EXPECT_EQ(render.bits, 16);
    EXPECT_EQ(render.gamma, glm::dvec3(1.8, 2, 2.4));
    EXPECT_EQ(render.max_display_rule, MaxDisplayRule::percentile);
    EXPECT_EQ(render.percentile, 95);
    EXPECT_EQ(render.tone_operator, ToneOperator::tumblin_rushmeier);
    EXPECT_EQ(render.adaptation, 12.5);
    EXPECT_EQ(render.white_luminance, 200);
    EXPECT_EQ(render.primaries, display_p3);
    EXPECT_TRUE(render.mark_clipped && render.mark_out_of_gamut);
    const auto lecture = parsed<RenderCommand>({"render", "r.toml", "-o", "a.png", "--max-display", "lecture",
                                                "--primaries", "0.628,0.346,0.268,0.588,0.15,0.07,0.313,0.329"});
    EXPECT_EQ(lecture.max_display_rule, MaxDisplayRule::lecture);
    EXPECT_EQ(lecture.primaries, lecture_monitor);
    EXPECT_EQ(parsed<RenderCommand>({"render", "r.toml", "-o", "a.png", "--max-display", "1e-30"}).max_display, 1e-30);
    EXPECT_EQ(parsed<RenderCommand>({"render", "r.toml", "-o", "a.png", "--max-display", "1e30"}).max_display, 1e30);
}

TEST(CommandLine, RenderFalseColour) {
    const auto render =
        parsed<RenderCommand>({"render", "r.toml", "-o", "a.png", "--quantity", "illuminance", "--false-colour",
                               "10:1000", "--isolux", "100,300,500", "--scale", "linear"});
    EXPECT_TRUE(render.false_colour.on);
    EXPECT_EQ(render.false_colour.range, std::pair(10.0, 1000.0));
    EXPECT_EQ(render.false_colour.levels, (std::vector<double>{100, 300, 500}));
    EXPECT_EQ(render.false_colour.logarithmic, false);
    const auto automatic = parsed<RenderCommand>(
        {"render", "r.toml", "-o", "a.png", "--quantity", "luminance", "--false-colour", "auto", "--isolux", "none"});
    EXPECT_TRUE(automatic.false_colour.automatic && automatic.false_colour.no_isolines);
    EXPECT_FALSE(automatic.false_colour.range.has_value());
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

TEST(CommandLine, SolverWordsTakeHyphens) {
    for (const char* word : {"gauss-seidel", "gauss_seidel"})
        EXPECT_EQ(parsed<RenderCommand>({"render", "r.toml", "-o", "a.png", "--solver", word}).batch.solve.solver,
                  SolverKind::gauss_seidel);
    const SolveOverrides solve =
        parsed<EditorCommand>({"room.toml", "--solver", "hierarchical", "--form-factor", "point-to-disk", "--oracle",
                               "form-factor", "--form-factor-samples", "9", "--link-tolerance", "0.5",
                               "--matrix-memory", "64"})
            .solve;
    const SolveSettings settings = with_overrides({}, solve);
    EXPECT_EQ(settings.solver, SolverKind::hierarchical);
    EXPECT_EQ(settings.form_factors, FormFactorMethod::point_to_disk);
    EXPECT_EQ(settings.form_factor_samples, 9);
    EXPECT_EQ(settings.oracle, RefinementOracle::form_factor);
    EXPECT_EQ(settings.link_tolerance, 0.5);
    EXPECT_EQ(settings.matrix_memory, 64);
    const auto measure = parsed<MeasureCommand>(
        {"measure", "r.toml", "--points", "i.csv", "-o", "o.csv", "--solver", "jacobi", "--form-factor", "hemicube"});
    EXPECT_EQ(measure.batch.solve.solver, SolverKind::jacobi);
    EXPECT_EQ(measure.batch.solve.form_factors, FormFactorMethod::hemicube);
    EXPECT_EQ(measure.at, MeasureAt::gather);
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
    for (const char* word :
         {"--output",      "--size",         "--gamma",    "--max-display",
          "--clip",        "--curve",        "--quantity", "--solver",
          "--wavelengths", "--error",        "--time",     "--threads",
          "--seed",        "--report",       "--operator", "--primaries",
          "--bits",        "--false-colour", "--isolux",   "clamp, keep_chromaticity, desaturate, scale_all",
          "cd/m2"})
        EXPECT_THAT(help, HasSubstr(word));
}

TEST(CommandLine, MistakesGetOneLineThatSaysWhatIsAllowed) {
    const std::pair<std::vector<const char*>, const char*> cases[] = {
        {{"--solver", "magic"},
         "auto, gathering, shooting, overshooting, jacobi, gauss_seidel, hierarchical, reference"},
        {{"--form-factor", "guess"}, "auto, analytic, point_to_disk, area_sampled, monte_carlo, hemicube, hemisphere"},
        {{"--form-factor-samples", "-1"}, "from 0 to 1048576"},
        {{"--oracle", "delphi"}, "form_factor, flux, error"},
        {{"--matrix-memory", "0"}, "from 1 to 1048576"},
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
        {{"render", "a.toml", "-o", "a.png", "--curve", "log"}, "srgb, gamma"},
        {{"render", "a.toml", "-o", "a.png", "--gamma", "-2.2"}, "from 0.1 to 10"},
        {{"render", "a.toml", "-o", "a.png", "--gamma", "1e-30"}, "from 0.1 to 10"},
        {{"render", "a.toml", "-o", "a.png", "--gamma", "1e30"}, "from 0.1 to 10"},
        {{"render", "a.toml", "-o", "a.png", "--gamma", "2,2"}, "three like 2.2,2.2,2.4"},
        {{"render", "a.toml", "-o", "a.png", "--gamma", "2,2,0"}, "from 0.1 to 10"},
        {{"render", "a.toml", "-o", "a.png", "--max-display", "-1"}, "above 0"},
        {{"render", "a.toml", "-o", "a.png", "--max-display", "nan"}, "above 0"},
        {{"render", "a.toml", "-o", "a.png", "--max-display", "1e31"}, "1e-30..1e30"},
        {{"render", "a.toml", "-o", "a.png", "--max-display", "p0"}, "p1 to p100"},
        {{"render", "a.toml", "-o", "a.png", "--operator", "aces"}, "linear, tumblin_rushmeier, filmic"},
        {{"render", "a.toml", "-o", "a.png", "--operator", "filmic", "--adaptation", "5"}, "tumblin_rushmeier"},
        {{"render", "a.toml", "-o", "a.png", "--adaptation", "0"}, "0.001..1e6"},
        {{"render", "a.toml", "-o", "a.png", "--primaries", "crt"}, "srgb, rec709, rec2020, display_p3, lecture"},
        {{"render", "a.toml", "-o", "a.png", "--primaries", "0.6,0.3,0.3,0.6,0.1,0.1,0.7,0.7"}, "inside the"},
        {{"render", "a.toml", "-o", "a.png", "--bits", "12"}, "8, 16"},
        {{"render", "a.toml", "-o", "a.jpg", "--bits", "16"}, ".png or .tif"},
        {{"render", "a.toml", "-o", "a.exr", "--bits", "16"}, "does nothing in a.exr"},
        {{"render", "a.toml", "-o", "a.png", "--mark", "red"}, "clipped, gamut"},
        {{"render", "a.toml", "-o", "a.png", "--false-colour", "1:10"}, "needs --quantity"},
        {{"render", "a.toml", "-o", "a.png", "--quantity", "luminance", "--false-colour", "10:1"}, "the lower first"},
        {{"render", "a.toml", "-o", "a.png", "--quantity", "luminance", "--false-colour", "0:1"}, "1e-6..1e12"},
        {{"render", "a.toml", "-o", "a.png", "--quantity", "luminance", "--false-colour", "auto", "--clip", "clamp"},
         "a scale of its own"},
        {{"render", "a.toml", "-o", "a.png", "--isolux", "100"}, "without --false-colour"},
        {{"render", "a.toml", "-o", "a.png", "--quantity", "illuminance", "--false-colour", "auto", "--isolux", "0"},
         "auto, none"},
        {{"render", "a.toml", "-o", "a.png", "--quantity", "illuminance", "--max-display", "lecture"}, "pNN"},
        {{"render", "a.toml", "-o", "a.png", "--quantity", "lux"}, "colour, luminance, illuminance"},
        {{"render", "a.toml", "-o", "a.png", "--error", "0"}, "above 0"},
        {{"render", "a.toml", "-o", "a.png", "--time", "soon"}, "above 0"},
        {{"render", "a.toml", "-o", "a.png", "--threads", "0"}, "from 1 to 1024"},
        {{"render", "a.toml", "-o", "a.png", "--threads", "1.5"}, "from 1 to 1024"},
        {{"render", "a.toml", "-o", "a.png", "--seed", "4294967296"}, "from 0 to 4294967295"},
        {{"measure", "a.toml", "-o", "o.csv"}, "--points"},
        {{"measure", "a.toml", "--points", "i.csv"}, "--output"},
        {{"measure", "a.toml", "--points", "i.csv", "-o", "o.csv", "--at", "wall"}, "gather, field"},
        {{"measure", "a.toml", "--points", "i.csv", "-o", "o.csv", "--solver", "magic"},
         "gauss_seidel, hierarchical, reference"},
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

TEST(CommandLine, Plan) {
    const auto plan = parsed<PlanCommand>(
        {"plan", "room.toml", "--wavelengths", "folded:9", "--colour-error", "1.5", "--report", "plan.json"});
    EXPECT_EQ(plan.batch.scene, "room.toml");
    EXPECT_EQ(plan.batch.solve.wavelengths, (WavelengthsSpec{WavelengthRule::folded, 9}));
    EXPECT_EQ(plan.batch.solve.colour_error, 1.5);
    EXPECT_EQ(plan.batch.report, "plan.json");
    for (const std::vector<const char*>& wrong : {std::vector<const char*>{"plan"},
                                                  {"plan", "room.toml", "--time", "3"},
                                                  {"plan", "room.toml", "--colour-error", "0"},
                                                  {"plan", "room.toml", "--wavelengths", "some"},
                                                  {"plan", "a.toml", "b.toml"}}) {
        const CommandLine line = parse(wrong);
        const auto* stop = std::get_if<ExitNow>(&line);
        ASSERT_NE(stop, nullptr);
        EXPECT_EQ(stop->code, 2);
        EXPECT_THAT(stop->text, testing::StartsWith("lueur plan: "));
    }
}

TEST(CommandLine, Chart) {
    const auto chart = parsed<ChartCommand>({"chart", "--of", "spectra", "-o", "a.svg", "--csv", "a.csv"});
    EXPECT_TRUE(chart.batch.scene.empty());
    EXPECT_EQ(chart.of, ChartSubject::spectra);
    EXPECT_EQ(chart.output, "a.svg");
    EXPECT_EQ(chart.csv, "a.csv");
    EXPECT_EQ(parsed<ChartCommand>({"chart", "room.toml", "--of", "spectra", "-o", "a.svg"}).batch.scene, "room.toml");
    for (const std::vector<const char*>& wrong : {std::vector<const char*>{"chart", "-o", "a.svg"},
                                                  {"chart", "--of", "tea", "-o", "a.svg"},
                                                  {"chart", "--of", "spectra"},
                                                  {"chart", "--of", "spectra", "-o", "a.png"},
                                                  {"chart", "--of", "spectra", "-o", "a.svg", "--wavelengths", "8"}}) {
        const CommandLine line = parse(wrong);
        const auto* stop = std::get_if<ExitNow>(&line);
        ASSERT_NE(stop, nullptr);
        EXPECT_EQ(stop->code, 2);
        EXPECT_THAT(stop->text, testing::StartsWith("lueur chart: "));
    }
}

} // namespace
} // namespace lueur
