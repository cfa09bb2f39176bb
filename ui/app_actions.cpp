#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "core/display/calibration.h"
#include "core/display/image_file.h"
#include "core/scene/files.h"
#include "core/scene/scene_file.h"
#include "core/spectrum/read_spectrum.h"
#include "editor/asset_path.h"
#include "editor/chart/chart_table.h"
#include "ui/dropped_files.h"
#include "ui/editor_window.h"

namespace lueur {
namespace {

// The master dimmer and solo replace the scene, but nothing in it but dimmers: no ray is stale.
Stage narrowed(Stage stage, const Scene& before, const Scene& after) {
    if (stage != Stage::mesh || before.geometry != after.geometry ||
        before.luminaires.size() != after.luminaires.size())
        return stage;
    Scene same = after;
    for (std::size_t i = 0; i < same.luminaires.size(); ++i) same.luminaires[i].dimmer = before.luminaires[i].dimmer;
    return same == before ? Stage::sources : stage;
}

} // namespace

void EditorWindow::start(const EditorCommand& command) {
    const auto file = command.scene.empty() ? default_scene_file() : command.scene;
    auto loaded = load_scene(file, {.spectrum_library = asset_path("spectra")});
    if (!loaded) {
        for (const auto& error : loaded.error()) fmt::print(stderr, "{}\n", error);
        state_.open_errors = loaded.error();
        state_.open_errors_file = file.string();
        show_scene(Document{});
        return;
    }
    for (auto& warning : loaded->warnings) say(Severity::warning, std::move(warning));
    loaded->scene.solve = with_overrides(loaded->scene.solve, command.solve);
    show_scene(Document(std::move(loaded->scene), file));
    remember_recent(preferences_, file);
}

void EditorWindow::show_scene(Document document) {
    document_ = std::move(document);
    state_.selected.reset();
    state_.material.reset();
    state_.luminaire.reset();
    if (document_.scene().luminaires.size() == 1) state_.luminaire = LuminaireIndex{0};
    state_.hovered.reset();
    state_.muted.clear();
    state_.preview.reset();
    state_.exposure = {};
    state_.unshot_top = 0;
    view_.home = document_.scene().camera;
    find_chart();
    submit(Stage::mesh);
}

void EditorWindow::find_chart() {
    charting_.cancel();
    state_.chart = {};
    const auto file = chart_file_of(document_.file());
    if (file.empty()) return;
    const auto text = read_bytes(file);
    auto chart = text ? parse_chart_table(*text, file.string())
                      : std::unexpected(std::vector{file.string() + ": " + text.error()});
    if (!chart) {
        for (const auto& fault : chart.error()) say(Severity::warning, fault);
        return;
    }
    chart->scene = document_.scene().name;
    state_.chart.chart = std::make_shared<const MethodChart>(std::move(*chart));
    state_.chart.source = "from " + file.filename().string();
}

// Begins and ends what was asked for, and takes over what there is to show.
void EditorWindow::follow_chart() {
    ChartPanelState& panel = state_.chart;
    switch (std::exchange(panel.request, ChartRequest::none)) {
    case ChartRequest::none:
        break;
    case ChartRequest::compute:
        charting_.start(document_.shared_scene(), {});
        panel.running = true;
        break;
    case ChartRequest::cancel:
        charting_.cancel();
        break;
    }
    if (!panel.running) return;
    const ChartJob::View job = charting_.view();
    if (job.share != panel.share || job.what != panel.what || job.running != panel.running)
        frames_left_ = std::max(frames_left_, 1);
    if (job.chart && job.chart != panel.chart) {
        panel.chart = job.chart;
        panel.scene = job.scene;
        panel.source = "made here";
    }
    panel.running = job.running;
    panel.share = job.share;
    panel.what = job.what;
}

void EditorWindow::open(const std::filesystem::path& file) {
    std::vector<std::string> warnings;
    auto document = document_; // keeps the revision growing
    if (auto opened = document.open(file, warnings); !opened) {
        state_.open_errors = opened.error();
        state_.open_errors_file = file.string();
        return;
    }
    for (auto& warning : warnings) say(Severity::warning, std::move(warning));
    show_scene(std::move(document));
    remember_recent(preferences_, file);
}

bool EditorWindow::save(const std::filesystem::path& file) {
    if (auto saved = document_.save(file); !saved) {
        say(Severity::error, saved.error());
        return false;
    }
    modified_revision_ = 0;
    say(Severity::note, "Saved " + file.string());
    remember_recent(preferences_, file);
    return true;
}

void EditorWindow::submit(Stage stage) {
    submitted_revision_ = document_.revision();
    worker_.submit(document_.shared_scene(), submitted_revision_, stage);
}

void EditorWindow::apply(const Edit& edit) {
    const auto before = document_.shared_scene();
    const auto stage = document_.apply(edit);
    if (!stage) {
        say(Severity::error, stage.error());
        return;
    }
    if (*stage == Stage::nothing) return;
    // From the first change of the light on, the picture is not rescaled unasked.
    if (*stage < Stage::view && state_.exposure.chosen) state_.exposure.final = true;
    // Camera and display are read from the document, frame by frame: the solver need not know.
    if (std::holds_alternative<SetCamera>(edit) || std::holds_alternative<SetDisplay>(edit)) return;
    submit(narrowed(*stage, *before, document_.scene()));
}

void EditorWindow::save_picture(const std::filesystem::path& file, bool spectral) {
    ScreenshotParams params;
    params.snapshot = snapshot_;
    params.camera = document_.scene().camera;
    params.display = display_in_use(document_.scene().display, state_.exposure);
    params.display.luminance_scale = state_.scales_in_use.luminance;
    params.display.illuminance_scale = state_.scales_in_use.illuminance;
    take_view(params, state_.view);
    params.bits = state_.picture_bits;
    params.width = std::max(view_.width, 16);
    params.height = std::max(view_.height, 16);
    params.scene_file = document_.file();
    params.output = file;
    if (spectral) params.spectral = true, params.quantity = PictureQuantity::colour, params.false_colour = false;
    screenshots_.start(std::move(params));
}

// As large as a monitor shows it whole; its lines are pixels.
void EditorWindow::save_calibration(const std::filesystem::path& file) {
    constexpr int width = 1920, height = 1080;
    const DisplaySettings& display = document_.scene().display;
    const auto picture = calibration_picture(width, height, display.curve, display.gamma);
    if (auto written = write_display_image(file, picture, {}); !written)
        say(Severity::error, written.error());
    else
        say(Severity::note, "Saved " + file.string() + "; look at it pixel for pixel.");
}

void EditorWindow::do_command(Command command) {
    switch (command) {
    case Command::open:
        state_.file_request = FileRequest{};
        break;
    case Command::save:
        if (!document_.file().empty() && document_.file().extension() == ".toml")
            save(document_.file());
        else
            state_.file_request = FileRequest{FilePurpose::save_scene, {}, {}, {}};
        break;
    case Command::save_as:
        state_.file_request = FileRequest{FilePurpose::save_scene, {}, {}, {}};
        break;
    case Command::screenshot:
        save_picture(new_screenshot_file(), false);
        break;
    case Command::screenshot_as:
        state_.file_request = FileRequest{FilePurpose::save_picture, {}, {}, {}};
        break;
    case Command::spectral_picture_as:
        state_.file_request = FileRequest{FilePurpose::save_spectral_picture, {}, {}, {}};
        break;
    case Command::quit:
        ask_first({true, {}});
        break;
    case Command::undo:
    case Command::redo: {
        const auto before = document_.shared_scene();
        const auto stage = command == Command::undo ? document_.undo() : document_.redo();
        if (stage < Stage::display) submit(narrowed(stage, *before, document_.scene()));
        if (state_.selected && at(*state_.selected) >= document_.scene().objects.size()) state_.selected.reset();
        break;
    }
    case Command::view_shaded:
        state_.view = ViewMode::shaded;
        break;
    case Command::view_elements:
        state_.view = ViewMode::elements;
        break;
    case Command::view_unshot:
        state_.view = ViewMode::unshot;
        break;
    case Command::view_luminance:
        state_.view = ViewMode::luminance;
        break;
    case Command::view_illuminance:
        state_.view = ViewMode::illuminance;
        break;
    case Command::view_error:
        state_.view = ViewMode::error;
        break;
    case Command::view_side_by_side:
    case Command::view_difference:
        state_.view = command == Command::view_difference ? ViewMode::difference : ViewMode::side_by_side;
        if (auto solve = document_.scene().solve;
            !solve.compare_trichromatic && solve.wavelengths.rule != WavelengthRule::rgb) {
            solve.compare_trichromatic = true;
            apply(SetSolve{solve});
        }
        break;
    case Command::frame_selection:
    case Command::home:
        if (const auto edit = camera_command(command, document_, state_, view_)) apply(*edit);
        break;
    case Command::toggle_panels:
        state_.layout.panels_visible = !state_.layout.panels_visible;
        break;
    case Command::toggle_links:
        state_.links_shown = !state_.links_shown;
        break;
    case Command::toggle_levels:
        state_.levels_shown = !state_.levels_shown;
        break;
    case Command::toggle_probe:
        state_.layout.probe_at_cursor = !state_.layout.probe_at_cursor;
        break;
    case Command::deselect:
        state_.selected.reset();
        break;
    case Command::pause:
        state_.paused = !state_.paused;
        worker_.set_paused(state_.paused);
        break;
    case Command::step:
        if (state_.paused) worker_.step();
        break;
    case Command::restart:
        state_.unshot_top = 0;
        worker_.restart();
        break;
    case Command::help:
        state_.help_open = !state_.help_open;
        break;
    case Command::log:
        state_.log_open = !state_.log_open;
        break;
    case Command::about:
        state_.about_open = true;
        break;
    }
}

void EditorWindow::ask_first(Pending pending) {
    pending_ = std::move(pending);
    if (document_.modified())
        ask_unsaved_ = true;
    else
        do_pending();
}

void EditorWindow::do_pending() {
    const auto pending = std::exchange(pending_, std::nullopt);
    if (!pending) return;
    if (pending->quit)
        quit_ = true;
    else
        open(pending->open);
}

void EditorWindow::take_events() {
    auto events = window_->take_events();
    if (events.any) {
        frames_left_ = 3;                // ImGui reacts to what it saw a frame ago
        wake_at_ = window_->now() + 0.6; // tooltips that wait for a still pointer
    }
    if (events.close) ask_first({true, {}});
    const bool modal = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    for (const auto& [key, modifiers] : events.keys)
        if (!modal && !ImGui::GetIO().WantTextInput && !state_.curve.active()) // whose keys a point being dragged takes
            if (const auto command = command_for_key(key, modifiers)) state_.commands.push_back(*command);
    for (const auto& file : events.dropped) {
        switch (kind_of_dropped(file)) {
        case DroppedKind::scene:
            state_.files_to_open.push_back(file);
            break;
        case DroppedKind::picture:
        case DroppedKind::spectrum: {
            double x = 0, y = 0;
            window_->pointer(x, y);
            const auto target =
                probe_at(*snapshot_, document_.scene().camera, view_, static_cast<float>(x), static_cast<float>(y));
            if (auto edit = edit_of_dropped(file, document_.scene(), target, state_.spectrum_target)) {
                apply(*edit);
                document_.end_drag();
            } else
                say(Severity::error, edit.error());
            break;
        }
        case DroppedKind::unknown:
            say(Severity::error, file.filename().string() +
                                     ": not a scene (.toml .obj .gltf .glb), picture or spectrum (.csv .spd .sp .cmf)");
            break;
        }
    }
}

void EditorWindow::request_file(const FileRequest& request) {
    browsing_for_ = request;
    const auto folder = document_.scene().folder.empty() ? std::filesystem::path(".") : document_.scene().folder;
    switch (request.purpose) {
    case FilePurpose::open_scene:
        browser_.open("Open a scene", {".toml", ".obj", ".gltf", ".glb"}, false, folder);
        break;
    case FilePurpose::save_scene: {
        auto name = document_.file().empty() ? folder / "scene.toml" : document_.file();
        browser_.open("Save the scene", {".toml"}, true, name.replace_extension(".toml"));
        break;
    }
    case FilePurpose::save_picture: // the first ending is the one that a name without any gets
        browser_.open("Save the picture", {".png", ".jpg", ".tif", ".exr", ".hdr"}, true, new_screenshot_file());
        break;
    case FilePurpose::save_spectral_picture:
        browser_.open("Save the picture at 41 wavelengths", {".exr"}, true,
                      new_screenshot_file().replace_extension(".exr"));
        break;
    case FilePurpose::save_calibration_picture:
        browser_.open("Save the calibration picture", {".png", ".tif"}, true, "calibration.png");
        break;
    case FilePurpose::reflectance_spectrum:
        browser_.open("Spectrum of a reflectance", spectrum_extensions(), false, folder);
        break;
    case FilePurpose::emission_spectrum:
        browser_.open("Spectrum of a lamp", spectrum_extensions(), false, folder);
        break;
    case FilePurpose::texture:
        browser_.open("Texture", picture_extensions(), false, folder);
        break;
    }
}

void EditorWindow::file_chosen(const std::filesystem::path& file) {
    const auto use = [&](std::expected<Edit, std::string> edit) {
        if (!edit) {
            say(Severity::error, edit.error());
            return;
        }
        apply(*edit);
        document_.end_drag();
    };
    switch (browsing_for_.purpose) {
    case FilePurpose::open_scene:
        ask_first({false, file});
        break;
    case FilePurpose::save_scene:
        if (save(file) && pending_after_save_) do_pending();
        pending_after_save_ = false;
        break;
    case FilePurpose::save_picture:
        save_picture(file, false);
        break;
    case FilePurpose::save_spectral_picture:
        save_picture(file, true);
        break;
    case FilePurpose::save_calibration_picture:
        save_calibration(file);
        break;
    case FilePurpose::reflectance_spectrum:
        use(reflectance_edit(file, browsing_for_.column, document_.scene(), browsing_for_.material));
        break;
    case FilePurpose::emission_spectrum:
        use(emission_edit(file, browsing_for_.column, document_.scene(), browsing_for_.luminaire));
        break;
    case FilePurpose::texture:
        use(texture_edit(file, document_.scene(), browsing_for_.material));
        break;
    }
}

} // namespace lueur
