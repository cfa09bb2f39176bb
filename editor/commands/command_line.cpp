#include "editor/commands/command_line.h"

#include <algorithm>
#include <array>
#include <functional>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/display/image_file.h"
#include "editor/commands/number_text.h"

namespace lueur {

namespace {

// Every value is read from its text here, so that a mistake gets one line that says what is allowed.
using Read = std::function<void(const std::string&)>;

[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& allowed) {
    throw CLI::ValidationError(option, fmt::format("'{}' cannot be used; {}", text, allowed));
}

// CLI11 indents what follows a line end, and does not wrap by itself.
std::string wrapped(const std::string& text) {
    constexpr std::size_t width = 84;
    std::string lines;
    std::size_t column = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        if (column > 0 && column + 1 + end - at > width) {
            lines += '\n';
            column = 0;
        } else if (column > 0) {
            lines += ' ';
            ++column;
        }
        lines += text.substr(at, end - at);
        column += end - at;
        at = end + 1;
    }
    return lines;
}

CLI::Option* add(CLI::App& app, const std::string& name, const std::string& type, const std::string& help,
                 const Read& read) {
    return app.add_option_function<std::string>(name, read, wrapped(help))->type_name(type);
}

struct Range {
    double low, high;
    bool above_low = false; // low itself is not allowed
    bool contains(double value) const { return (above_low ? value > low : value >= low) && value <= high; }
    std::string text() const {
        if (above_low) return fmt::format("a number above {} and up to {} is allowed", low, high);
        return fmt::format("a number from {} to {} is allowed", low, high);
    }
};

template <typename Target>
CLI::Option* add_number(CLI::App& app, const std::string& name, const std::string& type, const std::string& help,
                        Range range, Target& target, double scale = 1) {
    return add(app, name, type, help, [name, range, scale, &target](const std::string& text) {
        const auto value = number_from_text(text);
        if (!value || !range.contains(*value)) refuse(name, text, range.text());
        target = *value * scale;
    });
}

template <typename Target>
CLI::Option* add_integer(CLI::App& app, const std::string& name, const std::string& help, long low, long high,
                         Target& target) {
    return add(app, name, "N", help, [name, low, high, &target](const std::string& text) {
        const auto value = integer_from_text(text);
        if (!value || *value < low || *value > high)
            refuse(name, text, fmt::format("a whole number from {} to {} is allowed", low, high));
        target = static_cast<std::uint32_t>(*value);
    });
}

template <typename Value, std::size_t N>
struct Choices {
    std::array<std::pair<const char*, Value>, N> list;
    std::string text() const {
        std::string names;
        for (const auto& [name, value] : list) names += (names.empty() ? "" : ", ") + std::string(name);
        return names;
    }
};
template <typename Value, std::size_t N, typename Target>
CLI::Option* add_choice(CLI::App& app, const std::string& name, const std::string& help,
                        const Choices<Value, N>& choices, Target& target) {
    return add(app, name, "NAME", fmt::format("{}: {}", help, choices.text()),
               [name, choices, &target](const std::string& text) {
                   for (const auto& [known, value] : choices.list)
                       if (text == known) {
                           target = value;
                           return;
                       }
                   refuse(name, text, "allowed: " + choices.text());
               });
}

void add_path(CLI::App& app, const std::string& name, const std::string& help, std::filesystem::path& target,
              bool required) {
    add(app, name, "FILE", help, [name, &target](const std::string& text) {
        if (text.empty()) refuse(name, text, "a file name is needed");
        target = text;
    })->required(required);
}

// `auto` is the method with the least error for its time in what was measured so far.
constexpr SolverKind automatic_solver = SolverKind::gathering;

void add_solver(CLI::App& app, SolveOverrides& solve) {
    add_choice(
        app, "--solver", "How the light is solved, auto is gathering; else as the scene says",
        Choices<SolverKind, 3>{
            {{{"gathering", SolverKind::gathering}, {"shooting", SolverKind::shooting}, {"auto", automatic_solver}}}},
        solve.solver);
}

void add_solve_options(CLI::App& app, SolveOverrides& solve, int& threads) {
    add(app, "--wavelengths", "RULE",
        "Channels of the light: uniform:N (N wavelengths from 400 to 700 nm, 4 to 31) or rgb (three channels, for "
        "comparison); "
        "else as the scene says",
        [&solve](const std::string& text) {
            const auto spec = parse_wavelengths(text);
            if (!spec) throw CLI::ValidationError("--wavelengths", spec.error());
            solve.wavelengths = *spec;
        });
    add_number(app, "--error", "PERCENT",
               "Estimated relative RMS error of irradiance to reach, in percent; else as the scene says",
               {0, 100, true}, solve.target_error, 0.01);
    add_integer(app, "--threads", "Threads to use, 1 to 1024; else all (the editor leaves one to its window)", 1, 1024,
                threads);
    add_integer(app, "--seed", "Seed of the random sequences, 0 to 4294967295; the same seed gives the same rays", 0,
                4294967295L, solve.seed);
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
    add_choice(app, "--quantity", "What a pixel shows, the last two in grey (colour)",
               Choices<PictureQuantity, 3>{{{{"colour", PictureQuantity::colour},
                                             {"luminance", PictureQuantity::luminance},
                                             {"illuminance", PictureQuantity::illuminance}}}},
               render.quantity);
    add(app, "--max-display", "X|auto",
        "Luminance in cd/m2 (illuminance in lx with --quantity illuminance) shown as full white, or auto from the "
        "picture; else as the scene says",
        [&render](const std::string& text) {
            if (text == "auto") {
                render.max_display_auto = true;
                return;
            }
            const auto value = number_from_text(text);
            if (!value || *value <= 0) refuse("--max-display", text, "auto or a number above 0 is allowed");
            render.max_display = *value;
        });
    std::array<std::pair<const char*, ClipRule>, 4> rules{{{"clamp", ClipRule::clamp},
                                                           {"keep_chromaticity", ClipRule::keep_chromaticity},
                                                           {"desaturate", ClipRule::desaturate},
                                                           {"scale_all", ClipRule::scale_all}}};
    add_choice(app, "--clip", "What becomes of colours that the display cannot show", Choices<ClipRule, 4>{rules},
               render.clip);
    add_choice(app, "--curve", "From light to pixel value",
               Choices<TransferCurve, 2>{{{{"gamma", TransferCurve::gamma}, {"srgb", TransferCurve::srgb}}}},
               render.curve);
    add_number(app, "--gamma", "G", "Exponent of the gamma curve, 0.1 to 10; takes --curve gamma", {0.1, 10},
               render.gamma);
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
               "Look from each point anew (the default) or read the field as the window shows it, interpolated",
               Choices<MeasureAt, 2>{{{{"gather", MeasureAt::gather}, {"field", MeasureAt::field}}}}, words.at);
    add_integer(app, "--rays", "Hemisphere rays (paths with --solver reference) a point, 1 to 100000000 (1024)", 1,
                100000000, words.rays);
    add(app, "--solver", "NAME",
        "How the light is solved: gathering, shooting, auto (gathering), or reference (unbiased paths from each point, "
        "no radiosity); "
        "else as the scene says",
        [&measure, &words](const std::string& text) {
            words.reference = text == "reference";
            if (text == "gathering")
                measure.batch.solve.solver = SolverKind::gathering;
            else if (text == "shooting")
                measure.batch.solve.solver = SolverKind::shooting;
            else if (text == "auto")
                measure.batch.solve.solver = automatic_solver;
            else if (!words.reference)
                refuse("--solver", text, "allowed: gathering, shooting, auto, reference");
        });
    add_batch_options(app, measure.batch);
}

// Options that would do nothing are mistakes, not noise.
void check_render(const CLI::App& app, const RenderCommand& render) {
    const auto given = [&](const char* name) { return app.count(name) > 0; };
    if (!is_display_image_name(render.output) && !is_radiance_image_name(render.output))
        refuse("--output", render.output.string(),
               "a name that ends in .png, .jpg, .jpeg, .tif, .tiff, .exr or .hdr is allowed");
    if (is_radiance_image_name(render.output))
        for (const char* name : {"--gamma", "--max-display", "--clip", "--curve"})
            if (given(name))
                throw CLI::ValidationError(
                    name, fmt::format("does nothing in {}, which holds radiance; use it with .png, .jpg or .tif",
                                      render.output.filename().string()));
    if (render.gamma && render.curve == TransferCurve::srgb)
        throw CLI::ValidationError("--gamma", "does nothing with --curve srgb; use it with --curve gamma or alone");
}

void check_measure(const CLI::App& app, MeasureCommand& measure, const MeasureWords& words) {
    if (words.reference) {
        if (words.at)
            throw CLI::ValidationError("--at",
                                       "does nothing with --solver reference, which traces paths from each point");
        for (const char* name : {"--error", "--time"})
            if (app.count(name) > 0)
                throw CLI::ValidationError(name,
                                           "does nothing with --solver reference; --rays says how many paths to trace");
        measure.at = MeasureAt::reference;
    } else if (words.at) {
        measure.at = *words.at;
    }
    if (words.rays && measure.at == MeasureAt::field)
        throw CLI::ValidationError("--rays", "does nothing with --at field, which traces no ray");
    if (words.rays) measure.rays = static_cast<int>(*words.rays);
}

constexpr const char* program_footer = R"(Examples:
  lueur                                        edit the measured Cornell box
  lueur room.toml                              edit another scene
  lueur render room.toml -o room.png           a picture, without a window
  lueur measure room.toml --points desk.csv -o desk_lux.csv
Each command has its own --help.

Exit status: 0 done; 1 could not be done; 2 a mistake on the command line or in a file; 130 stopped with Ctrl-C.)";

constexpr const char* render_footer =
    R"(Without --max-display, --clip, --curve and --gamma the picture is displayed as the scene file says.
PNG, JPEG and TIFF carry the display settings and the state of the solution as metadata; so does EXR the latter.)";

constexpr const char* measure_footer =
    R"(Points are in metres, in the axes of the scene file (a file whose up axis is z takes points with z up).
Normals are unit vectors to within 0.001; they say which way the meter looks.
With --wavelengths rgb the columns irradiance_r, irradiance_g and irradiance_b are added, in the units of the scene's emission.)";

} // namespace

SolveSettings with_overrides(SolveSettings settings, const SolveOverrides& overrides) {
    if (overrides.solver) settings.solver = *overrides.solver;
    if (overrides.wavelengths) settings.wavelengths = *overrides.wavelengths;
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

    const std::string* command = nullptr;
    try {
        app.parse(argc, argv);
        for (const CLI::App* sub : {render_app, measure_app}) {
            if (!sub->parsed()) continue;
            command = &sub->get_name();
            for (const CLI::Option* option : app.get_options())
                if (option->count() > 0)
                    throw CLI::ValidationError(option->get_name(),
                                               fmt::format("stands before {0}; put it after {0}", *command));
        }
        if (render_app->parsed()) check_render(*render_app, render);
        if (measure_app->parsed()) check_measure(*measure_app, measure, words);
    } catch (const CLI::ParseError& stop) {
        std::ostringstream out, errors;
        if (app.exit(stop, out, errors) == 0) return ExitNow{0, out.str()};
        for (const CLI::App* sub : {render_app, measure_app})
            if (sub->parsed()) command = &sub->get_name();
        const std::string called = command ? "lueur " + *command : std::string("lueur");
        return ExitNow{2, fmt::format("{0}: {1} (see {0} --help)\n", called, stop.what())};
    }
    if (render_app->parsed()) return render;
    if (measure_app->parsed()) return measure;
    return editor;
}

} // namespace lueur
