#include "editor/commands/command_line.h"

#include <algorithm>
#include <array>
#include <functional>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/display/image_file.h"
#include "core/scene/solver_words.h"
#include "editor/commands/display_options.h"
#include "editor/commands/form_factor_options.h"
#include "editor/commands/number_text.h"
#include "editor/commands/option_text.h"

namespace lueur {

namespace {

void add_path(CLI::App& app, const std::string& name, const std::string& help, std::filesystem::path& target,
              bool required) {
    add(app, name, "FILE", help, [name, &target](const std::string& text) {
        if (text.empty()) refuse(name, text, "a file name is needed");
        target = text;
    })->required(required);
}

// Words of the scene file; hyphens are as good as underscores.
template <typename Enum, std::size_t N>
void add_word(CLI::App& app, const std::string& name, const std::string& help, const std::array<Enum, N>& all,
              std::optional<Enum>& target) {
    add(app, name, "NAME", fmt::format("{}: {}", help, words_of(all)), [name, all, &target](const std::string& text) {
        target = from_word(text, all);
        if (!target) refuse(name, text, "allowed: " + words_of(all));
    });
}

void add_form_factor_options(CLI::App& app, SolveOverrides& solve) {
    add_word(app, "--form-factor", "How form factors between patches are found, else as the scene says",
             all_form_factor_methods, solve.form_factors);
    add_integer(app, "--form-factor-samples",
                "Sub-elements, rays, or edge of the hemicube, 1 to 1048576; 0 for the method's default; else as the "
                "scene says",
                0, most_form_factor_samples, solve.form_factor_samples);
    add_word(app, "--oracle", "What links of the hierarchical solver are refined by, else as the scene says",
             all_oracles, solve.oracle);
    add_number(app, "--link-tolerance", "TOLERANCE",
               "Of the oracle; 0 for what the target error asks; else as the scene says", {0, 1e12},
               solve.link_tolerance);
    add_integer(app, "--matrix-memory",
                "MiB that a full matrix of form factors may take, 1 to 1048576; else as the scene says (1024)", 1,
                most_matrix_memory, solve.matrix_memory);
}

void add_solver(CLI::App& app, SolveOverrides& solve) {
    add_word(app, "--solver", "How the light is solved, auto takes what the charts found best; else as the scene says",
             all_solvers, solve.solver);
    add_form_factor_options(app, solve);
}

void add_wavelength_options(CLI::App& app, SolveOverrides& solve) {
    add(app, "--wavelengths", "RULE",
        "Channels of the light: auto (as many as the scene needs), folded:N or N alone, uniform:N, meyer:N, gauss:N or "
        "rgb (three channels, for comparison); else as the scene says",
        [&solve](const std::string& text) {
            const auto spec = parse_wavelengths(text);
            if (!spec) throw CLI::ValidationError("--wavelengths", spec.error());
            solve.wavelengths = *spec;
        });
    add_number(app, "--colour-error", "DE2000",
               "Worst colour difference that --wavelengths auto may be predicted; else as the scene says",
               {0, 100, true}, solve.colour_error);
}

void add_ray_options(CLI::App& app, SolveOverrides& solve, int& threads) {
    add_number(app, "--error", "PERCENT",
               "Estimated relative RMS error of irradiance to reach, in percent; else as the scene says",
               {0, 100, true}, solve.target_error, 0.01);
    add_integer(app, "--threads", "Threads to use, 1 to 1024; else all (the editor leaves one to its window)", 1, 1024,
                threads);
    add_integer(app, "--seed", "Seed of the random sequences, 0 to 4294967295; the same seed gives the same rays", 0,
                4294967295L, solve.seed);
}

void add_solve_options(CLI::App& app, SolveOverrides& solve, int& threads) {
    add_wavelength_options(app, solve);
    add_ray_options(app, solve, threads);
}

void add_scene(CLI::App& app, BatchParams& batch) {
    add_path(app, "SCENE", "A .toml scene, or an .obj, .gltf or .glb as it is", batch.scene, true);
}

void add_batch_options(CLI::App& app, BatchParams& batch) {
    add_solve_options(app, batch.solve, batch.threads);
    add_number(app, "--time", "SECONDS", "Stop solving after so many seconds, but not before there is a first solution",
               {0, 1e6, true}, batch.time_limit);
    add_path(app, "--report",
             "Write stage times, rays, rows, elements, sweeps, estimated error and peak memory as JSON", batch.report,
             false);
}

void add_render_options(CLI::App& app, RenderCommand& render) {
    add_scene(app, render.batch);
    add_path(app, "-o,--output",
             "The picture: .png, .jpg or .tif as displayed, .exr or .hdr as linear sRGB radiance in cd/m2",
             render.output, true);
    add(app, "--size", "WxH", "Pixels, each side 1 to 16384 (1280x800)", [&render](const std::string& text) {
        const auto cross = text.find('x');
        const auto width = integer_from_text(std::string_view(text).substr(0, cross));
        const auto height =
            cross == std::string::npos ? std::nullopt : integer_from_text(std::string_view(text).substr(cross + 1));
        if (!width || !height || *width < 1 || *height < 1 || *width > 16384 || *height > 16384)
            refuse("--size", text, "WIDTHxHEIGHT in pixels is allowed, each from 1 to 16384, like 1280x800");
        render.width = static_cast<int>(*width);
        render.height = static_cast<int>(*height);
    });
    add_choice(app, "--bits", "Bits a channel of .png and .tif (8)", Choices<int, 2>{{{{"8", 8}, {"16", 16}}}},
               render.bits);
    app.add_flag("--spectral", render.spectral,
                 "An .exr of spectral radiance at 41 wavelengths, 380 to 780 nm, in the layout of Fichet et al. 2021");
    add_choice(app, "--quantity",
               "What a pixel shows, all but colour in grey or with --false-colour; colour_difference is the CIEDE2000 "
               "between the spectral and the trichromatic approach, error the estimated one of illuminance in per cent "
               "(colour)",
               Choices<PictureQuantity, 5>{{{{"colour", PictureQuantity::colour},
                                             {"luminance", PictureQuantity::luminance},
                                             {"illuminance", PictureQuantity::illuminance},
                                             {"colour_difference", PictureQuantity::colour_difference},
                                             {"error", PictureQuantity::error}}}},
               render.quantity);
    add_display_options(app, render);
    add_false_colour_options(app, render);
    add_solver(app, render.batch.solve);
    add_batch_options(app, render.batch);
}

// What --solver reference asks for is a way to measure, not to solve.
struct MeasureWords {
    std::optional<MeasureAt> at;
    bool reference = false;
    std::optional<std::uint32_t> rays;
};

void add_measure_options(CLI::App& app, MeasureCommand& measure, MeasureWords& words) {
    add_scene(app, measure.batch);
    add_path(app, "--points", "CSV with the columns x,y,z,nx,ny,nz in any order; others are kept", measure.points,
             true);
    add_path(app, "-o,--output",
             "The same CSV with the columns illuminance_lx, irradiance_w_m2, standard_error_percent added",
             measure.output, true);
    add_choice(app, "--at",
               "Look from each point anew (the default), read the field as the window shows it, interpolated, or trace "
               "unbiased paths",
               Choices<MeasureAt, 3>{
                   {{{"gather", MeasureAt::gather}, {"field", MeasureAt::field}, {"reference", MeasureAt::reference}}}},
               words.at);
    add_integer(app, "--rays", "Hemisphere rays (paths of the reference) a point, 1 to 100000000 (1024)", 1, 100000000,
                words.rays);
    add(app, "--solver", "NAME",
        fmt::format(
            "How the light is solved, auto takes what the charts found best and reference traces unbiased paths from "
            "each point, "
            "without radiosity; else as the scene says: {}",
            words_of(all_solvers)),
        [&measure, &words](const std::string& text) {
            const auto solver = from_word(text, all_solvers);
            if (!solver) refuse("--solver", text, "allowed: " + words_of(all_solvers));
            words.reference = solver == SolverKind::reference;
            if (!words.reference) measure.batch.solve.solver = solver;
        });
    add_form_factor_options(app, measure.batch.solve);
    add_batch_options(app, measure.batch);
}

void add_plan_options(CLI::App& app, PlanCommand& plan) {
    add_scene(app, plan.batch);
    add_wavelength_options(app, plan.batch.solve);
    add_path(app, "--report", "Write the plan as JSON", plan.batch.report, false);
}

void add_chart_options(CLI::App& app, ChartCommand& chart) {
    add_path(app, "SCENE", "The scene that is solved, with its own lights and paints; without it the Cornell box",
             chart.batch.scene, false);
    add_choice(app, "--of",
               "What is charted, error against time of every method (the default) or colour error against wavelengths",
               Choices<ChartSubject, 2>{{{{"methods", ChartSubject::methods}, {"spectra", ChartSubject::spectra}}}},
               chart.of);
    add_path(app, "-o,--output", "The chart: .svg", chart.output, true);
    add_path(app, "--csv", "Its figures", chart.csv, false);
    add_number(app, "--time", "SECONDS", "Of methods: for everything (90, quick 25)", {0, 1e6, true},
               chart.batch.time_limit);
    add_number(app, "--run-time", "SECONDS", "Of methods: of solving for one run (a twelfth of --time)", {0, 1e6, true},
               chart.run_time);
    add_integer(app, "--points", "Of methods: random surface points to measure at, 10 to 100000 (400, quick 200)", 10,
                100000, chart.points);
    add_integer(app, "--paths",
                "Of methods: paths of the reference at each point, 64 to 10000000; else as many as bring its standard "
                "error to 1 % (quick 2 %) within a third of the time",
                64, 10000000, chart.paths);
    app.add_flag("--quick", chart.quick, "Of methods: fewer points, a rougher reference, less time");
    add_word(app, "--solver", "Of methods: this solver alone", all_solvers, chart.batch.solve.solver);
    add_ray_options(app, chart.batch.solve, chart.batch.threads);
    add_path(app, "--report", "Of spectra: write what the solving cost as JSON", chart.batch.report, false);
}

// Options that would do nothing are mistakes, not noise.
void check_render(const CLI::App& app, const RenderCommand& render) {
    if (!is_display_image_name(render.output) && !is_radiance_image_name(render.output))
        refuse("--output", render.output.string(),
               "a name that ends in .png, .jpg, .jpeg, .tif, .tiff, .exr or .hdr is allowed");
    check_display_options(app, render);
}

void check_measure(const CLI::App& app, MeasureCommand& measure, const MeasureWords& words) {
    if (words.reference || words.at == MeasureAt::reference) {
        if (words.at && words.at != MeasureAt::reference)
            throw CLI::ValidationError("--at",
                                       "does nothing with --solver reference, which traces paths from each point");
        for (const char* name : {"--error", "--time"})
            if (app.count(name) > 0)
                throw CLI::ValidationError(name,
                                           fmt::format("does nothing with {}; --rays says how many paths to trace",
                                                       words.reference ? "--solver reference" : "--at reference"));
        measure.at = MeasureAt::reference;
    } else if (words.at) {
        measure.at = *words.at;
    }
    if (words.rays && measure.at == MeasureAt::field)
        throw CLI::ValidationError("--rays", "does nothing with --at field, which traces no ray");
    if (words.rays) measure.rays = static_cast<int>(*words.rays);
}

void check_chart(const CLI::App& app, const ChartCommand& chart) {
    if (chart.output.extension() != ".svg")
        refuse("--output", chart.output.string(), "a name that ends in .svg is allowed");
    const auto does_nothing = [&](std::initializer_list<const char*> names, const char* subject) {
        for (const char* name : names)
            if (app.count(name) > 0)
                throw CLI::ValidationError(name, fmt::format("does nothing with --of {}", subject));
    };
    switch (chart.of) {
    case ChartSubject::methods:
        does_nothing({"--error", "--report"}, "methods");
        break;
    case ChartSubject::spectra:
        does_nothing({"--time", "--run-time", "--points", "--paths", "--quick", "--solver"}, "spectra");
        break;
    }
}

constexpr const char* program_footer = R"(Examples:
  lueur                                        edit the measured Cornell box
  lueur room.toml                              edit another scene
  lueur render room.toml -o room.png           a picture, without a window
  lueur measure room.toml --points desk.csv -o desk_lux.csv
  lueur form-factors pairs.json -o factors.json
  lueur plan room.toml                         how many wavelengths it needs
Each command has its own --help.

Exit status: 0 done; 1 could not be done; 2 a mistake on the command line or in a file; 130 stopped with Ctrl-C.)";

constexpr const char* render_footer =
    R"(Without options of the display the picture is displayed as the scene file says.
PNG, JPEG and TIFF carry the display settings and the state of the solution as metadata; so does EXR the latter.)";

constexpr const char* plan_footer =
    R"(Colour differences are CIEDE2000 of one to three reflections of the scene's paints under each of its lamps, against
integration at 1 nm. They are predicted from the spectra alone: nothing is solved.)";

constexpr const char* chart_footer =
    R"(--of methods: every solver with every method of finding form factors, with ever larger budgets, against paths traced at
random surface points: relative RMS error without the paths' own noise, median and 95th percentile, against solve time.
--of spectra: CIEDE2000 of the ColorChecker's patches, up to three bounces, for each rule of --wavelengths under smooth,
mixed and spiky lights, against the number of channels and against the time that solving the scene with them takes.)";

constexpr const char* measure_footer =
    R"(Points are in metres, in the axes of the scene file (a file whose up axis is z takes points with z up).
Normals are unit vectors to within 0.001; they say which way the meter looks.
With --wavelengths rgb the columns irradiance_r, irradiance_g and irradiance_b are added, in the units of the scene's emission.)";

} // namespace

SolveSettings with_overrides(SolveSettings settings, const SolveOverrides& overrides) {
    if (overrides.solver) settings.solver = *overrides.solver;
    if (overrides.form_factors) settings.form_factors = *overrides.form_factors;
    if (overrides.form_factor_samples) settings.form_factor_samples = *overrides.form_factor_samples;
    if (overrides.oracle) settings.oracle = *overrides.oracle;
    if (overrides.link_tolerance) settings.link_tolerance = *overrides.link_tolerance;
    if (overrides.matrix_memory) settings.matrix_memory = *overrides.matrix_memory;
    if (overrides.wavelengths) settings.wavelengths = *overrides.wavelengths;
    if (overrides.colour_error) settings.colour_error = *overrides.colour_error;
    if (overrides.target_error) settings.target_error = *overrides.target_error;
    if (overrides.seed) settings.seed = *overrides.seed;
    return settings;
}

CommandLine parse_command_line(int argc, const char* const* argv) {
    CLI::App app(
        "Lueur: a live lighting editor. Solves the light of a scene in spectra and shows it while you change it.",
        "lueur");
    app.set_version_flag("--version", std::string("lueur ") + LUEUR_VERSION);
    app.set_help_flag("-h,--help", "Print this help and leave");
    app.footer(program_footer);
    app.require_subcommand(0, 1);

    EditorCommand editor;
    add_path(app, "SCENE", "The scene to edit: .toml, .obj, .gltf or .glb; without it the Cornell box", editor.scene,
             false);
    add_solver(app, editor.solve);
    add_solve_options(app, editor.solve, editor.threads);

    RenderCommand render;
    CLI::App* render_app = app.add_subcommand("render", "Solve a scene and save a picture of it");
    add_render_options(*render_app, render);
    render_app->footer(render_footer);

    MeasureCommand measure;
    MeasureWords words;
    CLI::App* measure_app = app.add_subcommand("measure", "Irradiance and illuminance at points of a scene");
    add_measure_options(*measure_app, measure, words);
    measure_app->footer(measure_footer);

    PlanCommand plan;
    CLI::App* plan_app = app.add_subcommand("plan", "How many wavelengths a scene needs, and why");
    add_plan_options(*plan_app, plan);
    plan_app->footer(plan_footer);

    ChartCommand chart;
    CLI::App* chart_app = app.add_subcommand("chart", "Charts of accuracy against cost");
    add_chart_options(*chart_app, chart);
    chart_app->footer(chart_footer);

    FormFactorsCommand form_factors;
    CLI::App* form_factors_app =
        app.add_subcommand("form-factors", "Form factors between polygons by every method, and where each fails");
    add_form_factor_command(*form_factors_app, form_factors);

    const auto commands = {render_app, measure_app, plan_app, chart_app, form_factors_app};
    const std::string* command = nullptr;
    try {
        app.parse(argc, argv);
        for (const CLI::App* sub : commands) {
            if (!sub->parsed()) continue;
            command = &sub->get_name();
            for (const CLI::Option* option : app.get_options())
                if (option->count() > 0)
                    throw CLI::ValidationError(option->get_name(),
                                               fmt::format("stands before {0}; put it after {0}", *command));
        }
        if (render_app->parsed()) check_render(*render_app, render);
        if (measure_app->parsed()) check_measure(*measure_app, measure, words);
        if (chart_app->parsed()) check_chart(*chart_app, chart);
        if (form_factors_app->parsed()) check_form_factor_command(*form_factors_app, form_factors);
    } catch (const CLI::ParseError& stop) {
        std::ostringstream out, errors;
        if (app.exit(stop, out, errors) == 0) return ExitNow{0, out.str()};
        for (const CLI::App* sub : commands)
            if (sub->parsed()) command = &sub->get_name();
        const std::string called = command ? "lueur " + *command : std::string("lueur");
        return ExitNow{2, fmt::format("{0}: {1} (see {0} --help)\n", called, stop.what())};
    }
    if (render_app->parsed()) return render;
    if (measure_app->parsed()) return measure;
    if (plan_app->parsed()) return plan;
    if (chart_app->parsed()) return chart;
    if (form_factors_app->parsed()) return form_factors;
    return editor;
}

} // namespace lueur
