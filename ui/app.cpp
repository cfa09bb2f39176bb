#include "ui/app.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "core/scene/scene_file.h"
#include "editor/asset_path.h"
#include "editor/worker.h"
#include "ui/dialogs.h"
#include "ui/dropped_files.h"
#include "ui/file_browser.h"
#include "ui/main_layout.h"
#include "ui/menu_bar.h"
#include "ui/panels.h"
#include "ui/preferences.h"
#include "ui/renderer.h"
#include "ui/screenshot.h"
#include "ui/viewport.h"
#include "ui/window.h"

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

WorkerParams worker_params(int threads) {
    WorkerParams params;
    params.threads = threads;
    params.wake = Window::wake;
    return params;
}

class App {
public:
    App(std::unique_ptr<Window> window, std::unique_ptr<Renderer> renderer, Preferences preferences, int threads)
        : window_(std::move(window))
        , renderer_(std::move(renderer))
        , preferences_(std::move(preferences))
        , screenshots_(Window::wake)
        , worker_(worker_params(threads)) {
        state_.layout = preferences_.layout;
        if (const char* file = std::getenv("LUEUR_FRAME_LOG")) frame_log_.open(file);
        if (!window_->font_complaint().empty()) say(Severity::warning, window_->font_complaint());
    }

    void start(const EditorCommand& command);
    void loop();

private:
    struct Pending { // waits for the answer about unsaved changes
        bool quit = false;
        std::filesystem::path open;
    };

    void say(Severity severity, std::string text) { state_.messages.add(severity, std::move(text), window_->now()); }
    void show_scene(Document document);
    void open(const std::filesystem::path& file);
    bool save(const std::filesystem::path& file);
    void apply(const Edit& edit);
    void submit(Stage stage) {
        submitted_revision_ = document_.revision();
        worker_.submit(document_.shared_scene(), submitted_revision_, stage);
    }
    void do_command(Command command);
    void ask_first(Pending pending);
    void do_pending();
    void take_events();
    void frame();
    void draw();
    void dialogs();
    void file_chosen(const std::filesystem::path& file);
    void request_file(const FileRequest& request);
    void log_facts();
    double seconds_to_wait() const;

    std::unique_ptr<Window> window_;
    std::unique_ptr<Renderer> renderer_;
    Preferences preferences_;
    UiState state_;
    ViewportState view_;
    Document document_;
    FileBrowser browser_;
    FileRequest browsing_for_;
    Screenshots screenshots_;
    std::shared_ptr<const Snapshot> snapshot_ = std::make_shared<Snapshot>();
    std::optional<Pending> pending_;
    bool ask_unsaved_ = false, pending_after_save_ = false;
    bool quit_ = false;
    bool previewing_ = false;
    bool item_was_active_ = false;
    std::uint64_t modified_revision_ = 0, submitted_revision_ = 0;
    bool modified_ = false;
    int frames_left_ = 3;
    double wake_at_ = 0, last_frame_ = 0; // s
    std::ofstream frame_log_;
    Worker worker_; // the last: it stops first
};

void App::start(const EditorCommand& command) {
    const auto file = command.scene.empty() ? default_scene_file() : command.scene;
    auto loaded = load_scene(file);
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

void App::show_scene(Document document) {
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
    submit(Stage::mesh);
}

void App::open(const std::filesystem::path& file) {
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

bool App::save(const std::filesystem::path& file) {
    if (auto saved = document_.save(file); !saved) {
        say(Severity::error, saved.error());
        return false;
    }
    modified_revision_ = 0;
    say(Severity::note, "Saved " + file.string());
    remember_recent(preferences_, file);
    return true;
}

void App::apply(const Edit& edit) {
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

void App::do_command(Command command) {
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
    case Command::screenshot: {
        ScreenshotParams params;
        params.snapshot = snapshot_;
        params.camera = document_.scene().camera;
        params.display = display_in_use(document_.scene().display, state_.exposure);
        params.width = std::max(view_.width, 16);
        params.height = std::max(view_.height, 16);
        params.scene_file = document_.file();
        params.output = new_screenshot_file();
        screenshots_.start(std::move(params));
        break;
    }
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
    case Command::frame_selection:
    case Command::home:
        if (const auto edit = camera_command(command, document_, state_, view_)) apply(*edit);
        break;
    case Command::toggle_panels:
        state_.layout.panels_visible = !state_.layout.panels_visible;
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

void App::ask_first(Pending pending) {
    pending_ = std::move(pending);
    if (document_.modified())
        ask_unsaved_ = true;
    else
        do_pending();
}

void App::do_pending() {
    const auto pending = std::exchange(pending_, std::nullopt);
    if (!pending) return;
    if (pending->quit)
        quit_ = true;
    else
        open(pending->open);
}

void App::take_events() {
    auto events = window_->take_events();
    if (events.any) {
        frames_left_ = 3;                // ImGui reacts to what it saw a frame ago
        wake_at_ = window_->now() + 0.6; // tooltips that wait for a still pointer
    }
    if (events.close) ask_first({true, {}});
    const bool modal = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    for (const auto& [key, modifiers] : events.keys)
        if (!modal && !ImGui::GetIO().WantTextInput)
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
            if (auto edit = edit_of_dropped(file, document_.scene(), target)) {
                apply(*edit);
                document_.end_drag();
            } else
                say(Severity::error, edit.error());
            break;
        }
        case DroppedKind::unknown:
            say(Severity::error,
                file.filename().string() + ": not a scene (.toml .obj .gltf .glb), picture or spectrum (.csv)");
            break;
        }
    }
}

void App::request_file(const FileRequest& request) {
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
    case FilePurpose::reflectance_spectrum:
        browser_.open("Spectrum of a reflectance", {".csv"}, false, folder);
        break;
    case FilePurpose::emission_spectrum:
        browser_.open("Spectrum of a lamp", {".csv"}, false, folder);
        break;
    case FilePurpose::texture:
        browser_.open("Texture", picture_extensions(), false, folder);
        break;
    }
}

void App::file_chosen(const std::filesystem::path& file) {
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

void App::dialogs() {
    errors_dialog(state_);
    help_dialog(state_);
    about_dialog(state_);
    draw_log(state_.messages, state_.log_open, state_.scale);
    switch (unsaved_dialog(document_, ask_unsaved_, state_)) {
    case UnsavedAnswer::none:
        break;
    case UnsavedAnswer::cancel:
        pending_.reset();
        break;
    case UnsavedAnswer::discard:
        do_pending();
        break;
    case UnsavedAnswer::save:
        if (!document_.file().empty() && document_.file().extension() == ".toml") {
            if (save(document_.file())) do_pending();
        } else {
            pending_after_save_ = true;
            request_file(FileRequest{FilePurpose::save_scene, {}, {}, {}});
        }
        break;
    }
    if (state_.file_request) request_file(*std::exchange(state_.file_request, std::nullopt));
    if (const auto file = browser_.draw(state_)) file_chosen(*file);
}

void App::draw() {
    const double now = window_->now(), dt = now - last_frame_;
    last_frame_ = now;
    state_.scale = window_->scale();
    state_.fonts = window_->fonts();

    snapshot_ = worker_.latest();
    const bool present = snapshot_->scene && snapshot_->scene->geometry == document_.scene().geometry;
    if (present && update_exposure(state_.exposure, document_.scene().display, *snapshot_, document_.scene().camera,
                                   aspect_of(view_)))
        frames_left_ = std::max(frames_left_, 1);

    if (const double scale = menu_bar(document_, preferences_, state_); scale > 0) {
        preferences_.scale = scale;
        window_->set_scale(scale);
        frames_left_ = 3;
    }
    const auto edits = main_layout(document_, *snapshot_, state_,
                                   [&] { return viewport(document_, *snapshot_, state_, view_, *renderer_, now, dt); });
    for (const auto& edit : edits) apply(edit);
    if (!edits.empty()) frames_left_ = std::max(frames_left_, 1);

    if (state_.preview) {
        worker_.submit(std::make_shared<const Scene>(*std::exchange(state_.preview, std::nullopt)),
                       document_.revision(), Stage::sources);
        previewing_ = true;
    } else if (previewing_ && state_.master == 1) {
        submit(Stage::sources); // back to the document's own dimmers
        previewing_ = false;
    }
    const bool item_active = ImGui::IsAnyItemActive();
    if (item_was_active_ && !item_active) document_.end_drag();
    item_was_active_ = item_active;

    dialogs();
    const auto* screen = ImGui::GetMainViewport();
    const float right = view_.width > 16 ? static_cast<float>(view_.x + view_.width) : screen->WorkSize.x;
    const float bottom = view_.height > 16 ? static_cast<float>(view_.y + view_.height) : screen->WorkSize.y;
    const auto note_changes = draw_notes(state_.messages, now, right, bottom, state_.scale);

    const auto soon = [&](double seconds) {
        wake_at_ = wake_at_ > now ? std::min(wake_at_, now + seconds) : now + seconds;
    };
    if (note_changes) soon(*note_changes);
    if (ImGui::GetIO().WantTextInput) soon(0.4); // the caret
    if (!view_.refined) soon(0.16);
}

void App::log_facts() {
    auto& log = state_.layout_log;
    if (!log.enabled()) return;
    const auto truth = [](bool value) { return std::string(value ? "true" : "false"); };
    const auto display = display_in_use(document_.scene().display, state_.exposure);
    log.fact("document_revision", fmt::format("{}", document_.revision()));
    log.fact("snapshot_document_revision", fmt::format("{}", snapshot_->document_revision));
    log.fact("settled",
             truth(snapshot_->status.settled && snapshot_->document_revision >= submitted_revision_ && !previewing_));
    log.fact("refined", truth(view_.refined));
    log.fact("max_display", fmt::format("{}", display.max_display));
    log.fact("gamma", fmt::format("{}", display.gamma));
    log.fact("srgb_curve", truth(display.curve == TransferCurve::srgb));
    log.fact("exposure_final", truth(state_.exposure.final || !document_.scene().display.max_display_auto));
    std::string dimmers, separator;
    for (const auto& luminaire : document_.scene().luminaires) {
        dimmers += fmt::format("{}{}", separator, luminaire.dimmer);
        separator = ",";
    }
    log.fact("dimmers", "[" + dimmers + "]");
    log.fact("selected", state_.selected ? fmt::format("{}", at(*state_.selected)) : "null");
    log.fact("pictures_being_saved", fmt::format("{}", screenshots_.running()));
    log.end_frame();
}

void App::frame() {
    const double start = window_->now();
    window_->begin_frame();
    draw();
    window_->end_frame({view_.picture.framebuffer, view_.picture.width, view_.picture.height, view_.x, view_.y,
                        view_.width, view_.height});
    log_facts();
    if (modified_revision_ != document_.revision()) {
        modified_revision_ = document_.revision();
        modified_ = document_.modified();
    }
    const auto name = document_.file().empty() ? std::string("untitled") : document_.file().filename().string();
    window_->set_title(name + (modified_ ? " *" : "") + " - Lueur");
    if (frame_log_) {
        frame_log_ << fmt::format("{:.4f} frame_ms {:.2f} picture_ms {:.2f} picture {}x{} samples {} solving {}\n",
                                  start, 1000 * (window_->now() - start),
                                  view_.drew_mesh ? 1000 * view_.draw_seconds : 0.0, view_.picture.width,
                                  view_.picture.height, view_.picture.samples, snapshot_->status.settled ? 0 : 1)
                   << std::flush;
    }
}

double App::seconds_to_wait() const {
    if (frames_left_ > 0 || view_.flying) return 0;
    return wake_at_ > 0 ? std::max(wake_at_ - window_->now(), 0.001) : -1;
}

void App::loop() {
    while (!quit_) {
        window_->wait(seconds_to_wait());
        take_events();
        for (const auto& done : screenshots_.finished()) {
            frames_left_ = std::max(frames_left_, 2);
            if (done)
                say(Severity::note, "Picture saved: " + done->string());
            else
                say(Severity::error, done.error());
        }
        for (const auto command : std::exchange(state_.commands, {})) do_command(command);
        for (const auto& file : std::exchange(state_.files_to_open, {})) ask_first({false, file});
        if (worker_.latest()->revision != snapshot_->revision) frames_left_ = std::max(frames_left_, 1);
        if (wake_at_ > 0 && window_->now() >= wake_at_) {
            wake_at_ = 0;
            frames_left_ = std::max(frames_left_, 1);
        }
        if (frames_left_ == 0 && !view_.flying) continue;
        frames_left_ = std::max(frames_left_ - 1, 0);
        frame();
    }
    preferences_.layout = state_.layout;
    preferences_.maximized = window_->maximized();
    if (!preferences_.maximized) {
        preferences_.width = window_->width();
        preferences_.height = window_->height();
    }
    save_preferences(preferences_, preferences_file());
}

} // namespace

int run_editor(const EditorCommand& command) {
    auto preferences = load_preferences(preferences_file());
    WindowParams params;
    params.width = preferences.width;
    params.height = preferences.height;
    params.maximized = preferences.maximized;
    params.scale = preferences.scale;
    auto window = Window::open(params);
    if (!window) {
        fmt::print(stderr, "lueur: no window: {}; without one use lueur render or lueur measure\n", window.error());
        return 1;
    }
    auto renderer = Renderer::make();
    if (!renderer) {
        fmt::print(stderr, "lueur: no window: {}\n", renderer.error());
        return 1;
    }
    App app(std::move(*window), std::move(*renderer), std::move(preferences), command.threads);
    app.start(command);
    app.loop();
    return 0;
}

} // namespace lueur
