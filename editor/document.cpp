#include "editor/document.h"

#include <algorithm>

#include "core/scene/scene_file.h"
#include "editor/asset_path.h"

namespace lueur {

namespace {

// Undo takes back what was done to the room, not where one stands in it; another scene brings its own camera.
std::shared_ptr<const Scene> seen_from(std::shared_ptr<const Scene> scene, const Scene& present) {
    if (scene->geometry != present.geometry || scene->camera == present.camera) return scene;
    auto moved = std::make_shared<Scene>(*scene);
    moved->camera = present.camera;
    return moved;
}

} // namespace

Document::Document(Scene scene, std::filesystem::path file)
    : scene_(std::make_shared<const Scene>(std::move(scene)))
    , saved_(scene_)
    , file_(std::move(file)) {}

bool Document::modified() const {
    return *seen_from(saved_, *scene_) != *scene_;
}

std::expected<Stage, std::string> Document::apply(const Edit& edit) {
    auto after = lueur::apply(edit, *scene_);
    if (!after) return std::unexpected(after.error());
    // Textures are equal by name: one that was read again from a changed file is another.
    if (*after == *scene_ && !std::holds_alternative<SetTexture>(edit)) return Stage::nothing;

    const Stage stage = first_stale_stage(edit, *scene_);
    if (!std::holds_alternative<SetCamera>(edit)) {
        const bool continues = last_edit_ && !undo_.empty() && same_target(*last_edit_, edit);
        if (continues)
            undo_.back().stage = std::min(undo_.back().stage, stage);
        else
            undo_.push_back({scene_, stage, describe(edit, *scene_)});
        redo_.clear();
        last_edit_ = edit;
    }
    scene_ = std::make_shared<const Scene>(std::move(*after));
    ++revision_;
    return stage;
}

void Document::end_drag() {
    last_edit_.reset();
}

std::string Document::undo_text() const {
    return undo_.empty() ? std::string() : undo_.back().text;
}
std::string Document::redo_text() const {
    return redo_.empty() ? std::string() : redo_.back().text;
}

Stage Document::undo() {
    return exchange(undo_, redo_);
}
Stage Document::redo() {
    return exchange(redo_, undo_);
}

// Takes the last step of `from` and puts what it replaces onto `to`. What an edit makes stale, taking it back makes
// stale too.
Stage Document::exchange(std::vector<Step>& from, std::vector<Step>& to) {
    if (from.empty()) return Stage::nothing;
    Step step = std::move(from.back());
    from.pop_back();
    to.push_back({scene_, step.stage, std::move(step.text)});
    scene_ = seen_from(std::move(step.scene), *scene_);
    ++revision_;
    last_edit_.reset();
    return step.stage;
}

std::expected<void, std::vector<std::string>> Document::open(const std::filesystem::path& file,
                                                             std::vector<std::string>& warnings) {
    auto loaded = load_scene(file, {.spectrum_library = asset_path("spectra")});
    if (!loaded) return std::unexpected(std::move(loaded.error()));
    warnings.insert(warnings.end(), loaded->warnings.begin(), loaded->warnings.end());
    scene_ = std::make_shared<const Scene>(std::move(loaded->scene));
    saved_ = scene_;
    file_ = file;
    undo_.clear();
    redo_.clear();
    last_edit_.reset();
    ++revision_;
    return {};
}

std::expected<void, std::string> Document::save(const std::filesystem::path& file) {
    if (file.extension() != ".toml")
        return std::unexpected(file.string() + ": scenes are saved as .toml files; give a name that ends in .toml");
    if (auto saved = save_scene(*scene_, file); !saved) return saved;
    saved_ = scene_;
    file_ = file;
    return {};
}

} // namespace lueur
