// What the window runs: a document, the worker that solves it, and the state of the hand. app.cpp makes it and draws
// its frames, app_actions.cpp does what was asked for.
#pragma once

#include <array>
#include <fstream>
#include <memory>
#include <optional>

#include "editor/chart/chart_job.h"
#include "editor/commands/command_line.h"
#include "editor/document.h"
#include "editor/worker.h"
#include "ui/file_browser.h"
#include "ui/preferences.h"
#include "ui/renderer.h"
#include "ui/screenshot.h"
#include "ui/ui_state.h"
#include "ui/viewport.h"
#include "ui/window.h"

namespace lueur {

class EditorWindow {
public:
    EditorWindow(std::unique_ptr<Window> window, std::unique_ptr<Renderer> renderer, Preferences preferences,
                 int threads);

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
    void save_picture(const std::filesystem::path& file, bool spectral);
    void save_calibration(const std::filesystem::path& file);
    void apply(const Edit& edit);
    void submit(Stage stage);
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
    void find_chart(); // that lies beside the scene or is shipped with it
    void follow_chart();
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
    ChartJob charting_;
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

} // namespace lueur
