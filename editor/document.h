// The scene being edited, with undo. One thread (the window's, a command's or a test's) owns it.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/edit.h"

namespace lueur {

class Document {
public:
    explicit Document(Scene scene = {}, std::filesystem::path file = {});

    const Scene& scene() const { return *scene_; }
    std::shared_ptr<const Scene> shared_scene() const { return scene_; }
    std::uint64_t revision() const { return revision_; } // grows with every change, undo and redo included
    const std::filesystem::path& file() const { return file_; }
    bool modified() const; // since it was opened or saved; where the camera stands does not count

    // Applies the edit and returns the first stale stage, or the reason why it was refused. Camera edits change the
    // scene but not undo: undo and redo leave the camera where it is, unless they bring back another scene.
    std::expected<Stage, std::string> apply(const Edit& edit);
    void end_drag(); // the next edit starts a new step of undo

    bool can_undo() const { return !undo_.empty(); }
    bool can_redo() const { return !redo_.empty(); }
    std::string undo_text() const; // what undo would take back; empty when nothing
    std::string redo_text() const;
    Stage undo();
    Stage redo();

    // Opens a file; on errors the document keeps the scene it had. Warnings are appended to `warnings`.
    std::expected<void, std::vector<std::string>> open(const std::filesystem::path& file,
                                                       std::vector<std::string>& warnings);
    std::expected<void, std::string> save(const std::filesystem::path& file);

private:
    struct Step {
        std::shared_ptr<const Scene> scene;
        Stage stage;
        std::string text;
    };
    Stage exchange(std::vector<Step>& from, std::vector<Step>& to);

    std::shared_ptr<const Scene> scene_;
    std::shared_ptr<const Scene> saved_;
    std::filesystem::path file_;
    std::uint64_t revision_ = 1;
    std::vector<Step> undo_, redo_;
    std::optional<Edit> last_edit_;
};

} // namespace lueur
