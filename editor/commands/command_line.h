// `lueur` as it is called: what the words on the command line ask for, as plain values.
//
//     lueur [SCENE]                                   the editor
//     lueur render SCENE -o IMAGE                     solve and save a picture
//     lueur measure SCENE --points IN.csv -o OUT.csv  irradiance and illuminance at points
//
// Nothing is printed and nothing is opened here; ui/main.cpp visits the variant. Exit status: 0 done, 1 could not be
// done, 2 bad command line or bad input file (said in full on stderr before anything is written), 130 cancelled by
// Ctrl-C.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "core/scene/scene.h"
#include "core/view/measure.h"
#include "core/view/picture.h"

namespace lueur {

// What the command line asks for in the place of what the scene file says.
struct SolveOverrides {
    std::optional<SolverKind> solver;
    std::optional<WavelengthsSpec> wavelengths;
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

struct RenderCommand {
    BatchParams batch;
    std::filesystem::path output;
    int width = 1280, height = 800;
    PictureQuantity quantity = PictureQuantity::colour;
    // Unset: as the scene says.
    std::optional<double> gamma;       // also selects TransferCurve::gamma
    std::optional<double> max_display; // cd m^-2 (lx for illuminance)
    bool max_display_auto = false;
    std::optional<ClipRule> clip;
    std::optional<TransferCurve> curve;
};

struct MeasureCommand {
    BatchParams batch;
    std::filesystem::path points, output;
    MeasureAt at = MeasureAt::gather;
    int rays = 1024;
};

struct ExitNow { // --help, --version, or a mistake
    int code = 0;
    std::string text; // for stdout with code 0, else for stderr; ends with a new line
};

using CommandLine = std::variant<EditorCommand, RenderCommand, MeasureCommand, ExitNow>;

CommandLine parse_command_line(int argc, const char* const* argv);

int run(const RenderCommand& command);
int run(const MeasureCommand& command);

} // namespace lueur
