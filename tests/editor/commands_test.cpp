// `lueur render` and `lueur measure` from file to file.
#include "editor/commands/command_line.h"

#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/display/image_file.h"
#include "editor/asset_path.h"
#include "editor/chart/chart_table.h"
#include "editor/commands/csv.h"
#include "editor/commands/number_text.h"
#include "tests/support/temporary_folder.h"

namespace lueur {
namespace {

using testing::HasSubstr;

std::size_t files_in(const std::filesystem::path& folder) {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
    return count;
}

// A cube of 2 m (24 m^2): all six walls reflect half and emit 1 W m^-2. Radiosity is B = E / (1 - rho) = 2 W m^-2
// everywhere, and what arrives anywhere inside is what the walls send out: 2 W m^-2.
constexpr const char* furnace = R"(units = "metre"

[[polygon]]
name = "floor"
material = "grey"
vertices = [[0, 0, 0], [0, 0, 2], [2, 0, 2], [2, 0, 0]]
[[polygon]]
name = "ceiling"
material = "grey"
vertices = [[0, 2, 0], [2, 2, 0], [2, 2, 2], [0, 2, 2]]
[[polygon]]
name = "left"
material = "grey"
vertices = [[0, 0, 0], [0, 2, 0], [0, 2, 2], [0, 0, 2]]
[[polygon]]
name = "right"
material = "grey"
vertices = [[2, 0, 0], [2, 0, 2], [2, 2, 2], [2, 2, 0]]
[[polygon]]
name = "back"
material = "grey"
vertices = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]
[[polygon]]
name = "front"
material = "grey"
vertices = [[0, 0, 2], [0, 2, 2], [2, 2, 2], [2, 0, 2]]

[[material]]
name = "grey"
reflectance = 0.5

[[luminaire]]
name = "walls"
objects = ["floor", "ceiling", "left", "right", "back", "front"]
power = { watt = 24 }

[solve]
element_size = 0.5

[camera]
position = [1, 1, 1.9]
target = [1, 1, 0]
)";

class Furnace : public testing::Test {
protected:
    Furnace() { write("furnace.toml", furnace); }
    std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
    void write(const std::string& name, const std::string& text) const { std::ofstream(file(name)) << text; }

    MeasureCommand measure(const std::string& points) const {
        write("in.csv", points);
        MeasureCommand command;
        command.batch.scene = file("furnace.toml");
        command.points = file("in.csv");
        command.output = file("out.csv");
        return command;
    }
    RenderCommand render(const std::string& name) const {
        RenderCommand command;
        command.batch.scene = file("furnace.toml");
        command.output = file(name);
        command.width = 32;
        command.height = 24;
        return command;
    }
    // The appended columns of each row.
    std::vector<std::vector<double>> measured() const {
        std::vector<std::vector<double>> rows;
        const auto text = test::text_of(file("out.csv"));
        const auto records = parse_csv(text);
        for (std::size_t r = 1; r < records.size(); ++r) {
            rows.emplace_back();
            for (std::size_t i = 6; i < records[r].fields.size(); ++i)
                rows.back().push_back(number_from_text(records[r].fields[i].text).value_or(-1));
        }
        return rows;
    }
    test::TemporaryFolder folder_;
};

const std::string points = "x,y,z,nx,ny,nz\n"
                           "1,0,1,0,1,0\n"      // on the floor
                           "0,0.5,1.5,1,0,0\n"  // on a wall
                           "1,1,1,0.6,0,0.8\n"; // in the air

TEST_F(Furnace, MeasuresTwoWattsEverywhere) {
    ASSERT_EQ(run(measure(points)), 0);
    const auto rows = measured();
    ASSERT_EQ(rows.size(), 3u);
    for (const auto& row : rows) {
        ASSERT_EQ(row.size(), 3u);
        EXPECT_NEAR(row[1], 2, 0.002);
        // A flat spectrum of 1 W over the solved channels; the field is even, so all rays agree.
        EXPECT_NEAR(row[0] / rows[0][0], 1, 0.002);
        EXPECT_GE(row[2], 0);
        EXPECT_LT(row[2], 0.5);
    }
}

TEST_F(Furnace, MeasuresWithEverySolverAndAtEveryPlace) {
    const std::string on_walls = "x,y,z,nx,ny,nz\n1,0,1,0,1,0\n0,0.5,1.5,1,0,0\n";
    for (const auto solver : {SolverKind::gathering, SolverKind::shooting, SolverKind::overshooting, SolverKind::jacobi,
                              SolverKind::gauss_seidel})
        for (const auto at : {MeasureAt::gather, MeasureAt::field}) {
            const bool reads_as_jacobi = solver == SolverKind::overshooting || solver == SolverKind::gauss_seidel;
            if (at == MeasureAt::field && reads_as_jacobi) continue;
            auto command = measure(on_walls);
            if (solver != SolverKind::gathering) {
                std::string scene = furnace;
                const std::string size = "element_size = 0.5";
                write("furnace.toml", scene.replace(scene.find(size), size.size(), "element_size = 1"));
            }
            command.batch.solve.solver = solver;
            command.at = at;
            ASSERT_EQ(run(command), 0);
            // The others send light from whole elements, here a metre wide.
            for (const auto& row : measured()) EXPECT_NEAR(row[1], 2, solver == SolverKind::gathering ? 0.01 : 0.1);
        }
    auto reference = measure(on_walls);
    reference.at = MeasureAt::reference;
    reference.rays = 4096;
    ASSERT_EQ(run(reference), 0);
    for (const auto& row : measured()) EXPECT_NEAR(row[1], 2, std::max(0.01, 4 * 2 * row[2] / 100));
}

// Emission of (1, 1.5, 2) in the scene's own units, reflectance 0.5: twice that arrives, channel by channel.
TEST_F(Furnace, MeasuresTheChannelsWithRgb) {
    auto command = measure(points);
    std::string scene = furnace;
    const std::string power = "power = { watt = 24 }";
    scene.replace(scene.find(power), power.size(), "spectrum = [1, 1.5, 2]\npower = { exitance = 1 }");
    write("furnace.toml", scene);
    command.batch.solve.wavelengths = WavelengthsSpec{WavelengthRule::rgb, 3};
    ASSERT_EQ(run(command), 0);
    EXPECT_THAT(test::text_of(command.output), HasSubstr(",irradiance_r,irradiance_g,irradiance_b\n"));
    ASSERT_EQ(measured().size(), 3u);
    for (const auto& row : measured()) {
        ASSERT_EQ(row.size(), 6u);
        EXPECT_NEAR(row[3], 2, 0.002);
        EXPECT_NEAR(row[4], 3, 0.003);
        EXPECT_NEAR(row[5], 4, 0.004);
    }
}

TEST_F(Furnace, APointOffEverySurfaceReadsNanInTheField) {
    auto command = measure("x,y,z,nx,ny,nz\n1,1,1,0,1,0\n");
    command.at = MeasureAt::field;
    testing::internal::CaptureStderr();
    ASSERT_EQ(run(command), 0);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("warning: 1 of 1 points"));
    EXPECT_THAT(test::text_of(command.output), HasSubstr("1,1,1,0,1,0,nan,nan,nan\n"));
}

TEST_F(Furnace, TellsAllMistakesOfSceneAndPointsAndWritesNothing) {
    auto command = measure("x,y,z,nx,ny,nz\n1,oops,1,0,1,0\n1,1,1,0,3,0\n");
    write("furnace.toml", std::string(furnace) + "colour = 3\n");
    testing::internal::CaptureStderr();
    EXPECT_EQ(run(command), 2);
    const auto told = testing::internal::GetCapturedStderr();
    EXPECT_THAT(told, HasSubstr("furnace.toml:"));
    EXPECT_THAT(told, HasSubstr("in.csv:2:3: y is 'oops'"));
    EXPECT_THAT(told, HasSubstr("in.csv:3:7: the normal has the length 3"));
    EXPECT_EQ(files_in(folder_.path()), 2u);
}

TEST_F(Furnace, IsRefusedBeforeTheSolveWhenItCannotBeWritten) {
    auto no_folder = measure(points);
    no_folder.output = file("absent") / "out.csv";
    auto a_folder = measure(points);
    a_folder.output = folder_.path();
    auto no_points = measure(points);
    no_points.points = file("absent.csv");
    for (const auto& command : {no_folder, a_folder, no_points}) {
        testing::internal::CaptureStderr();
        EXPECT_EQ(run(command), 2);
        EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::StartsWith(folder_.path().string()));
    }
    auto picture = render("a.png");
    picture.output = "/dev/null";
    EXPECT_EQ(run(picture), 2);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

// A wall is even: radiance (E + rho H) / pi = 2 / pi W m^-2 sr^-1 in every pixel, so every pixel of the picture is the
// same.
TEST_F(Furnace, RendersAnEvenPictureThatSaysHowItWasMade) {
    auto command = render("furnace.png");
    command.max_display = 300;
    command.gamma = glm::dvec3(2.0);
    command.batch.report = file("report.json");
    ASSERT_EQ(run(command), 0);
    const auto picture = read_texture(command.output);
    ASSERT_TRUE(picture.has_value()) << picture.error();
    ASSERT_EQ(picture->width, 32);
    ASSERT_EQ(picture->height, 24);
    const glm::vec3 first = picture->rgb.front();
    EXPECT_GT(first.g, 0.01f);
    EXPECT_LT(first.g, 0.99f);
    for (const auto& pixel : picture->rgb)
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixel[c], first[c], 0.012f); // one step of 1/255, decoded

    const auto metadata = read_image_metadata(command.output);
    ASSERT_TRUE(metadata.has_value()) << metadata.error();
    EXPECT_EQ(metadata->at("lueur:solver"), "auto");
    EXPECT_EQ(metadata->at("lueur:max_display"), "300");
    EXPECT_EQ(metadata->at("lueur:curve"), "gamma");
    EXPECT_EQ(metadata->at("lueur:gamma"), "2");
    EXPECT_EQ(metadata->at("lueur:settled"), "yes");
    EXPECT_EQ(metadata->at("lueur:version"), LUEUR_VERSION);
    EXPECT_EQ(metadata->at("lueur:camera_position"), "1 1 1.9");

    const auto report = nlohmann::json::parse(test::text_of(file("report.json")));
    EXPECT_EQ(report.at("command"), "render");
    EXPECT_EQ(report.at("end"), "settled");
    EXPECT_GT(report.at("rays").get<double>(), 0);
    EXPECT_GT(report.at("rows").get<double>(), 0);
    EXPECT_GT(report.at("elements").get<double>(), 0);
    EXPECT_GE(report.at("sweeps").get<double>(), 0);
    EXPECT_GT(report.at("peak_memory_bytes").get<double>(), 1e6);
    EXPECT_LE(report.at("estimated_error_percent").get<double>(), report.at("target_error_percent").get<double>());
    for (const char* stage : {"load", "meshing", "gathering_rays", "solving", "picture", "write"})
        EXPECT_GE(report.at("stage_seconds").at(stage).get<double>(), 0) << stage;
}

// The walls send out as much as arrives (B = H), so their luminance is the illuminance / pi: shown with a MAXDISPLAY pi
// times as high, the illuminance is the same picture.
TEST_F(Furnace, IlluminanceIsPiTimesTheLuminance) {
    auto luminance = render("luminance.png"), illuminance = render("illuminance.png");
    luminance.quantity = PictureQuantity::luminance;
    luminance.max_display = 300;
    illuminance.quantity = PictureQuantity::illuminance;
    illuminance.max_display = 300 * 3.14159265;
    ASSERT_EQ(run(luminance), 0);
    ASSERT_EQ(run(illuminance), 0);
    const auto a = read_texture(luminance.output), b = read_texture(illuminance.output);
    ASSERT_TRUE(a && b);
    const glm::vec3 grey = a->rgb.front();
    EXPECT_GT(grey.g, 0.1f);
    EXPECT_LT(grey.g, 0.9f);
    EXPECT_NEAR(grey.r, grey.g, 0.01f);
    for (std::size_t i = 0; i < a->rgb.size(); ++i) ASSERT_NEAR(a->rgb[i].g, b->rgb[i].g, 0.012f);
}

// Grey walls under an even spectrum: the trichromatic approach shows them as they are.
TEST_F(Furnace, ColourDifferenceIsAskedForAndSolvedBeside) {
    auto command = render("difference.exr");
    command.quantity = PictureQuantity::colour_difference;
    ASSERT_EQ(run(command), 0);
    EXPECT_EQ(read_image_metadata(command.output)->at("lueur:quantity"), "colour_difference");
    command.batch.solve.wavelengths = WavelengthsSpec{WavelengthRule::rgb, 3};
    EXPECT_EQ(run(command), 2) << "rgb differs from nothing";
}

TEST_F(Furnace, SavesRadianceWithItsStoryToo) {
    auto command = render("furnace.exr");
    ASSERT_EQ(run(command), 0);
    const auto metadata = read_image_metadata(command.output);
    ASSERT_TRUE(metadata.has_value()) << metadata.error();
    EXPECT_EQ(metadata->at("lueur:solver"), "auto");
    EXPECT_FALSE(metadata->contains("lueur:max_display"));
}

TEST_F(Furnace, ATimeThatIsTooShortStillGivesAPicture) {
    auto command = render("quick.png");
    command.batch.time_limit = 1e-6;
    command.batch.solve.target_error = 1e-6;
    command.batch.report = file("report.json");
    ASSERT_EQ(run(command), 0);
    EXPECT_EQ(nlohmann::json::parse(test::text_of(file("report.json"))).at("end"), "out of time");
    EXPECT_TRUE(std::filesystem::exists(command.output));
}

TEST_F(Furnace, OneThreadGivesTheSameAsMany) {
    auto command = measure(points);
    ASSERT_EQ(run(command), 0);
    const auto many = test::text_of(command.output);
    command.batch.threads = 1;
    ASSERT_EQ(run(command), 0);
    EXPECT_EQ(test::text_of(command.output), many);
}

// In a process of its own: the signal is sent while a picture is made that would take many seconds.
TEST_F(Furnace, CtrlCEndsWithoutAHalfFile) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto run_and_stop = [](const RenderCommand& command) {
        std::thread([] {
            std::this_thread::sleep_for(std::chrono::milliseconds(300));
            kill(getpid(), SIGINT);
        }).detach();
        std::_Exit(run(command));
    };
    auto picture = render("stopped.png");
    picture.width = picture.height = 8000;
    EXPECT_EXIT(run_and_stop(picture), testing::ExitedWithCode(130), "");
    EXPECT_FALSE(std::filesystem::exists(file("stopped.png")));
    EXPECT_EQ(files_in(folder_.path()), 1u) << "the scene";
}

TEST_F(Furnace, PlansItsWavelengths) {
    PlanCommand plan;
    plan.batch.scene = file("furnace.toml");
    plan.batch.solve.wavelengths = WavelengthsSpec{WavelengthRule::automatic, 0};
    plan.batch.report = file("plan.json");
    testing::internal::CaptureStdout();
    ASSERT_EQ(run(plan), 0);
    const auto told = testing::internal::GetCapturedStdout();
    // Grey walls need one sample, whatever the lamp.
    EXPECT_THAT(told, HasSubstr("12 triangles, 6 surfaces, 1 luminaires with 1 different spectra, 1 different"));
    EXPECT_THAT(told, HasSubstr("auto (folded:1)"));
    EXPECT_THAT(told, HasSubstr("one lamp spectrum: predicted dE2000 0.00 on average, 0.00 at worst"));
    for (const char* rule : {"meyer:4", "gauss:10", "uniform:31", "uniform:81", "rgb"})
        EXPECT_THAT(told, HasSubstr(rule));
    const auto report = nlohmann::json::parse(test::text_of(file("plan.json")));
    EXPECT_EQ(report["asked"], "auto");
    EXPECT_EQ(report["wavelengths"], "folded:1");
    EXPECT_EQ(report["channel_nm"].size(), 1u);
    EXPECT_EQ(report["lamps"][0]["luminaires"], "walls");
    EXPECT_NEAR(report["worst_de2000"].get<double>(), 0, 1e-3);
    ASSERT_EQ(report["rules"].size(), 6u);
    EXPECT_EQ(report["rules"][4]["rule"], "uniform:81");
    EXPECT_EQ(report["rules"][4]["padded_channels"], 88);
    EXPECT_DOUBLE_EQ(report["rules"][4]["sweep_of_uniform_31"], 88.0 / 32);
    EXPECT_DOUBLE_EQ(report["rules"][0]["sweep_of_uniform_81"], 8.0 / 88);

    // A rule of one's own is predicted and compared with the others once.
    plan.batch.solve.wavelengths = WavelengthsSpec{WavelengthRule::uniform, 31};
    testing::internal::CaptureStdout();
    ASSERT_EQ(run(plan), 0);
    testing::internal::GetCapturedStdout();
    EXPECT_EQ(nlohmann::json::parse(test::text_of(file("plan.json")))["rules"].size(), 5u);
}

TEST_F(Furnace, PlanTellsMistakesAndWritesNothing) {
    PlanCommand plan;
    plan.batch.scene = file("missing.toml");
    plan.batch.report = file("plan.json");
    testing::internal::CaptureStderr();
    EXPECT_EQ(run(plan), 2);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("missing.toml"));
    plan.batch.scene = file("furnace.toml");
    plan.batch.report = file("nowhere") / "plan.json";
    testing::internal::CaptureStderr();
    EXPECT_EQ(run(plan), 2);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("there is no folder"));
    EXPECT_EQ(files_in(folder_.path()), 1u);
}

TEST_F(Furnace, ChartsSpectra) {
    ChartCommand chart;
    chart.of = ChartSubject::spectra;
    chart.batch.scene = file("furnace.toml");
    chart.output = file("chart.svg");
    chart.csv = file("chart.csv");
    testing::internal::CaptureStdout();
    ASSERT_EQ(run(chart), 0);
    testing::internal::GetCapturedStdout();
    const std::string svg = test::text_of(file("chart.svg"));
    for (const char* word : {"folded", "uniform", "gauss", "meyer", "rgb", "auto", "LED-B3", "solve time, ms"})
        EXPECT_THAT(svg, HasSubstr(word));
    const std::string text = test::text_of(file("chart.csv"));
    const auto records = parse_csv(text);
    ASSERT_GT(records.size(), 200u);
    EXPECT_EQ(records[0].raw, "lights,light,rule,wavelengths,channels,mean_de2000,worst_de2000,solve_seconds");
    int autos = 0;
    for (std::size_t r = 1; r < records.size(); ++r) {
        ASSERT_EQ(records[r].fields.size(), 8u);
        const double worst = number_from_text(records[r].fields[6].text).value_or(-1),
                     seconds = number_from_text(records[r].fields[7].text).value_or(-1);
        EXPECT_GT(seconds, 0);
        EXPECT_GE(worst, number_from_text(records[r].fields[5].text).value_or(1e9));
        if (records[r].fields[2].text == "auto") {
            ++autos;
            EXPECT_LE(worst, 0.5);
        }
    }
    EXPECT_EQ(autos, 6);
}

TEST_F(Furnace, ChartsMethods) {
    ChartCommand chart;
    chart.batch.scene = file("furnace.toml");
    chart.batch.time_limit = 2;
    chart.run_time = 0.2;
    chart.points = 40;
    chart.paths = 256;
    chart.output = file("chart.svg");
    chart.csv = file("chart.csv");
    testing::internal::CaptureStdout();
    ASSERT_EQ(run(chart), 0);
    EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("The best of them:\n  from "));
    const std::string svg = test::text_of(file("chart.svg"));
    for (const char* word : {"gathering", "shooting", "solve time, s", "256 traced paths"})
        EXPECT_THAT(svg, HasSubstr(word));
    const auto table = parse_chart_table(test::text_of(file("chart.csv")), "chart.csv");
    ASSERT_TRUE(table) << table.error().front();
    EXPECT_EQ(methods_of(*table), all_chart_methods()) << "every method is there, whether it ended well or not";
    EXPECT_EQ(table->runs.size(), all_chart_methods().size() * chart_budgets().size());
    for (const ChartRun& run : table->runs) {
        if (run.end != RunEnd::settled || run.method.solver != SolverKind::gathering) continue;
        EXPECT_LT(run.points.back().error.rms, 0.2) << "a furnace is as bright everywhere";
    }
}

TEST_F(Furnace, AnInterruptedChartWritesNothing) {
    ChartCommand chart;
    chart.of = ChartSubject::spectra;
    chart.batch.scene = file("furnace.toml");
    chart.output = file("chart.svg");
    chart.csv = file("nowhere") / "chart.csv";
    testing::internal::CaptureStderr();
    EXPECT_EQ(run(chart), 2);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("there is no folder"));
    chart.csv = file("chart.csv");
    for (const ChartSubject subject : {ChartSubject::spectra, ChartSubject::methods}) {
        chart.of = subject;
        std::jthread ctrl_c([] {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            kill(getpid(), SIGINT);
        });
        EXPECT_EQ(run(chart), 130);
    }
    EXPECT_EQ(files_in(folder_.path()), 1u);
}

} // namespace
} // namespace lueur
