#include "ui/app.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>
#include <imgui.h>

#include "ui/dialogs.h"
#include "ui/editor_window.h"
#include "ui/main_layout.h"
#include "ui/menu_bar.h"
#include "ui/panels.h"

namespace lueur {
namespace {

WorkerParams worker_params(int threads) {
    WorkerParams params;
    params.threads = threads;
    params.wake = Window::wake;
    return params;
}

} // namespace

EditorWindow::EditorWindow(std::unique_ptr<Window> window, std::unique_ptr<Renderer> renderer, Preferences preferences,
                           int threads)
    : window_(std::move(window))
    , renderer_(std::move(renderer))
    , preferences_(std::move(preferences))
    , screenshots_(Window::wake)
    , charting_(Window::wake)
    , worker_(worker_params(threads)) {
    state_.layout = preferences_.layout;
    if (const char* file = std::getenv("LUEUR_FRAME_LOG")) frame_log_.open(file);
    if (!window_->font_complaint().empty()) say(Severity::warning, window_->font_complaint());
}

void EditorWindow::dialogs() {
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

void EditorWindow::draw() {
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
    const auto shares = state_.shares;
    const auto edits = main_layout(document_, *snapshot_, state_,
                                   [&] { return viewport(document_, *snapshot_, state_, view_, *renderer_, now, dt); });
    if (!(shares == state_.shares)) frames_left_ = std::max(frames_left_, 1); // the panels stood before the picture
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

void EditorWindow::log_facts() {
    auto& log = state_.layout_log;
    if (!log.enabled()) return;
    const auto truth = [](bool value) { return std::string(value ? "true" : "false"); };
    const auto display = display_in_use(document_.scene().display, state_.exposure);
    log.fact("document_revision", fmt::format("{}", document_.revision()));
    log.fact("snapshot_document_revision", fmt::format("{}", snapshot_->document_revision));
    log.fact("settled",
             truth(snapshot_->status.settled && snapshot_->document_revision >= submitted_revision_ && !previewing_));
    log.fact("refined", truth(view_.refined));
    log.fact("snapshot_revision", fmt::format("{}", snapshot_->revision));
    log.fact("rays", fmt::format("{}", snapshot_->status.rays));
    log.fact("sweeps", fmt::format("{}", snapshot_->status.sweeps));
    log.fact("max_display", fmt::format("{}", display.max_display));
    log.fact("gamma", fmt::format("{}", display.gamma.g));
    log.fact("srgb_curve", truth(display.curve == TransferCurve::srgb));
    log.fact("exposure_final", truth(state_.exposure.final || !follows_picture(document_.scene().display)));
    std::string dimmers, separator;
    for (const auto& luminaire : document_.scene().luminaires) {
        dimmers += fmt::format("{}{}", separator, luminaire.dimmer);
        separator = ",";
    }
    log.fact("dimmers", "[" + dimmers + "]");
    const ImGuiIO& io = ImGui::GetIO(); // what has been seen of the hand
    const ImVec2 mouse = ImGui::IsMousePosValid() ? io.MousePos : ImVec2(-1, -1);
    log.fact("mouse", fmt::format("[{:.0f},{:.0f},{}]", mouse.x, mouse.y, io.MouseDown[0] ? 1 : 0));
    log.fact("selected", state_.selected ? fmt::format("{}", at(*state_.selected)) : "null");
    log.fact("pictures_being_saved", fmt::format("{}", screenshots_.running()));
    log.end_frame();
}

void EditorWindow::frame() {
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
    window_->set_title(fmt::format("{}{} - Lueur", name, modified_ ? " *" : ""));
    if (frame_log_) {
        frame_log_ << fmt::format("{:.4f} frame_ms {:.2f} picture_ms {:.2f} picture {}x{} samples {} solving {}\n",
                                  start, 1000 * (window_->now() - start),
                                  view_.drew_mesh ? 1000 * view_.draw_seconds : 0.0, view_.picture.width,
                                  view_.picture.height, view_.picture.samples, snapshot_->status.settled ? 0 : 1)
                   << std::flush;
    }
}

double EditorWindow::seconds_to_wait() const {
    if (frames_left_ > 0 || view_.flying) return 0;
    return wake_at_ > 0 ? std::max(wake_at_ - window_->now(), 0.001) : -1;
}

void EditorWindow::loop() {
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
        follow_chart();
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
        if (window_->has_more_input()) frames_left_ = std::max(frames_left_, 2);
    }
    preferences_.layout = state_.layout;
    preferences_.maximized = window_->maximized();
    if (!preferences_.maximized) {
        preferences_.width = window_->width();
        preferences_.height = window_->height();
    }
    save_preferences(preferences_, preferences_file());
}

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
    EditorWindow editor(std::move(*window), std::move(*renderer), std::move(preferences), command.threads);
    editor.start(command);
    editor.loop();
    return 0;
}

} // namespace lueur
