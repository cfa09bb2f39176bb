// What the window remembers between frames that is not part of the document: selection, layout, drafts, what was asked
// for. One thread (the window's) owns it. Panels read and change it freely; what changes the scene goes through an
// Edit.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/chart/method_chart.h"
#include "editor/edit.h"
#include "editor/snapshot.h"
#include "ui/commands.h"
#include "ui/convergence_runs.h"
#include "ui/exposure.h"
#include "ui/layout_log.h"
#include "ui/light_readings.h"
#include "ui/messages.h"
#include "ui/spectrum_state.h"
#include "ui/theme.h"

namespace lueur {

enum class ViewMode { shaded, elements, unshot, luminance, illuminance, side_by_side, difference, error };

enum class ChromaticityScale { xy, uv }; // CIE 1931 x y, CIE 1976 u' v'

// Which file the browser is open for.
enum class FilePurpose {
    open_scene,
    save_scene,
    save_picture,
    save_spectral_picture,
    save_calibration_picture,
    reflectance_spectrum,
    emission_spectrum,
    texture
};
struct FileRequest {
    FilePurpose purpose = FilePurpose::open_scene;
    MaterialIndex material{};
    LuminaireIndex luminaire{};
    std::string column; // of a spectrum file
};

// Sizes in unscaled pixels; kept in the preferences.
struct Layout {
    float column_width = 348;
    float strip_height = 168;
    float lower_height = 312; // of the lower half of the column
    bool panels_visible = true;
    bool probe_at_cursor = false;
};

// The chart of methods: what there is to show, and what was asked for.
enum class ChartRequest { none, compute, cancel };
struct ChartPanelState {
    std::shared_ptr<const MethodChart> chart; // null: none yet
    std::shared_ptr<const Scene> scene;       // that it was made of; null: read from a file
    std::string source;                       // "made here", or the file
    bool running = false;
    double share = 0; // done, 0..1
    std::string what; // is being run; or why there is no chart
    ChartRequest request = ChartRequest::none;
};

struct UiState {
    ViewMode view = ViewMode::shaded;
    std::optional<ObjectIndex> selected;
    std::optional<MaterialIndex> material;   // open in the materials panel
    std::optional<LuminaireIndex> luminaire; // unfolded in the luminaires panel
    bool show_luminaires = false;            // bring the luminaires tab to the front once
    std::optional<Probe> hovered;

    // The hierarchical solver's links and elements over the picture.
    struct Place {
        glm::vec3 position, normal;
    };
    bool links_shown = false, levels_shown = false;
    std::optional<Place> link_place; // clicked at

    Layout layout;
    Fonts fonts;
    float scale = 1; // pixels for each unscaled pixel

    std::string material_filter, luminaire_filter;
    SpectrumShelf spectra;
    CurveDrag curve;                     // of a point of a drawn spectrum
    SpectrumTarget spectrum_target;      // of the panel in front
    std::map<std::size_t, double> muted; // luminaire -> dimmer before it was muted
    float master = 1;                    // of the drag of the master dimmer that is going on
    std::optional<Scene> preview; // shown to the solver while the master dimmer is dragged; becomes an edit at its end
    std::optional<SolveSettings> solve_draft; // while a slider that costs rays is being dragged

    Exposure exposure; // MAXDISPLAY in use
    struct {
        FalseColourSettings luminance, illuminance;
    } scales_in_use;            // of the false colours, automatic ranges included
    bool shares_wanted = false; // by a panel, in this frame
    DisplayShares shares;       // clipped and out of gamut, of the last still picture
    int picture_bits = 8;       // a channel of saved pictures, or 16
    bool each_gamma = false;    // a slider for each channel
    bool own_primaries = false; // numbers in the place of a preset
    bool calibrating = false;   // the picture to set gamma by is unfolded
    float unshot_top = 0;       // top of the false-colour scale, lm m^-2

    ConvergenceRuns convergence_runs;

    ChromaticityScale chromaticity_scale = ChromaticityScale::uv;
    bool chromaticity_whites = false; // only the part of the diagram where lamps lie
    LightReadings readings;           // of the colour panel

    ChartPanelState chart;

    bool paused = false;
    bool help_open = false, log_open = false, about_open = false;
    std::vector<std::string> open_errors; // shown in a box until closed
    std::string open_errors_file;
    Messages messages;

    // Asked for this frame; the application does them between frames.
    std::vector<Command> commands;
    std::vector<std::filesystem::path> files_to_open;
    std::optional<FileRequest> file_request;

    LayoutLog layout_log;
};

} // namespace lueur
