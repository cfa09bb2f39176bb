// `lueur` as it is called: what the words on the command line ask for, as plain values.
//
//     lueur [SCENE]                                   the editor
//     lueur render SCENE -o IMAGE                     solve and save a picture
//     lueur measure SCENE --points IN.csv -o OUT.csv  irradiance and illuminance at points
//     lueur form-factors CASES.json -o OUT.json       every method on pairs of polygons with occluders
//     lueur plan SCENE                                how many wavelengths the scene needs, and why
//     lueur chart SCENE -o OUT.svg --csv OUT.csv      error against time of every method
//     lueur chart --of spectra -o OUT.svg             colour difference against the number of samples and solve time
//
// Nothing is printed and nothing is opened here; ui/main.cpp visits the variant. Exit status: 0 done, 1 could not be
// done, 2 bad command line or bad input file (said in full on stderr before anything is written), 130 cancelled by
// Ctrl-C.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/scene/scene.h"
#include "core/transport/form_factor.h"
#include "core/view/measure.h"
#include "core/view/picture.h"

namespace lueur {

// What the command line asks for in the place of what the scene file says.
struct SolveOverrides {
    std::optional<SolverKind> solver;
    std::optional<FormFactorMethod> form_factors;
    std::optional<int> form_factor_samples;
    std::optional<RefinementOracle> oracle;
    std::optional<double> link_tolerance;
    std::optional<int> matrix_memory; // MiB
    std::optional<WavelengthsSpec> wavelengths;
    std::optional<double> colour_error; // CIEDE2000
    std::optional<double> target_error; // relative RMS, 0.02 is 2 %
    std::optional<std::uint32_t> seed;
};
SolveSettings with_overrides(SolveSettings settings, const SolveOverrides& overrides);

struct EditorCommand {
    std::filesystem::path scene; // empty: the default scene (editor/asset_path.h)
    SolveOverrides solve;
    int threads = 0; // 0: the worker's own choice
};

struct BatchParams { // what every command without a window shares
    std::filesystem::path scene;
    SolveOverrides solve;
    double time_limit = 0;        // s of solving; 0: until the target error is met
    int threads = 0;              // 0: all
    std::filesystem::path report; // empty: none
};

// False colours in the place of grey; unset: as the scene says.
struct FalseColourOverrides {
    bool on = false;
    bool automatic = false;
    std::optional<std::pair<double, double>> range; // cd m^-2 or lx
    std::optional<bool> logarithmic;
    std::optional<std::vector<double>> levels; // of the contours; empty: the legend's numbers
    bool no_isolines = false;
};

struct RenderCommand {
    BatchParams batch;
    std::filesystem::path output;
    int width = 1280, height = 800;
    int bits = 8; // a channel, or 16
    PictureQuantity quantity = PictureQuantity::colour;
    bool spectral = false; // an .exr of 41 wavelengths
    FalseColourOverrides false_colour;
    // Unset: as the scene says.
    std::optional<glm::dvec3> gamma;   // also selects TransferCurve::gamma
    std::optional<double> max_display; // cd m^-2 (lx for illuminance); by hand
    std::optional<MaxDisplayRule> max_display_rule;
    std::optional<double> percentile;
    std::optional<ClipRule> clip;
    std::optional<TransferCurve> curve;
    std::optional<ToneOperator> tone_operator;
    std::optional<double> adaptation; // cd m^-2
    bool adaptation_auto = false;
    std::optional<RgbSpace> primaries;
    std::optional<double> white_luminance; // cd m^-2
    bool mark_clipped = false, mark_out_of_gamut = false;
};

struct MeasureCommand {
    BatchParams batch;
    std::filesystem::path points, output;
    MeasureAt at = MeasureAt::gather;
    int rays = 1024;
};

struct PlanCommand {
    BatchParams batch;
};

enum class ChartSubject { methods, spectra };

struct ChartCommand {
    BatchParams batch; // without a scene: the default one (editor/asset_path.h)
    ChartSubject of = ChartSubject::methods;
    std::filesystem::path output, csv; // csv empty: none
    // Of methods only. 0: as ChartParams (editor/chart/run_chart.h) has it, or less for a quick chart.
    bool quick = false;
    int points = 0, paths = 0;
    double run_time = 0; // s
};

struct FormFactorsCommand {
    BatchParams batch;                   // nothing of it is asked for
    std::filesystem::path cases, output; // output: a folder with failures
    bool failures = false;
    std::vector<FormFactorMethod> methods; // empty: all but automatic
    FormFactorSettings settings;
};

struct ExitNow { // --help, --version, or a mistake
    int code = 0;
    std::string text; // for stdout with code 0, else for stderr; ends with a new line
};

using CommandLine =
    std::variant<EditorCommand, RenderCommand, MeasureCommand, PlanCommand, ChartCommand, FormFactorsCommand, ExitNow>;

CommandLine parse_command_line(int argc, const char* const* argv);

int run(const RenderCommand& command);
int run(const MeasureCommand& command);
int run(const PlanCommand& command);
int run(const ChartCommand& command);
int run(const FormFactorsCommand& command);

} // namespace lueur
