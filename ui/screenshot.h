// Saves pictures from snapshots on a thread of its own, through the same ray-cast picture as `lueur render`.
#pragma once

#include <atomic>
#include <expected>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/display/display.h"
#include "core/view/picture.h"
#include "editor/snapshot.h"
#include "ui/ui_state.h"

namespace lueur {

struct ScreenshotParams {
    std::shared_ptr<const Snapshot> snapshot;
    Camera camera;
    DisplaySettings display; // with the numbers in use
    PictureQuantity quantity = PictureQuantity::colour;
    bool false_colour = false; // of a luminance or illuminance
    int width = 1280, height = 800;
    int bits = 8;                     // a channel, or 16: .png and .tif
    bool spectral = false;            // an .exr of 41 wavelengths
    bool beside_rgb = false;          // the right half by the trichromatic approach
    std::filesystem::path scene_file; // named in the metadata
    std::filesystem::path output;     // its ending says the kind: .png .jpg .tif as displayed, .exr .hdr as radiance
};

// What the view shows, as a picture.
void take_view(ScreenshotParams& params, ViewMode view);

// $XDG_PICTURES_DIR or the current folder / lueur-YYYYMMDD-HHMMSS.png; a number is added when the name is taken.
std::filesystem::path new_screenshot_file();

class Screenshots {
public:
    explicit Screenshots(std::function<void()> wake); // called from the thread when a picture is done
    ~Screenshots();                                   // cancels

    void start(ScreenshotParams params);
    // What has been finished since the last call: a path or why not.
    std::vector<std::expected<std::filesystem::path, std::string>> finished();
    std::size_t running() const;

private:
    std::function<void()> wake_;
    std::atomic<bool> cancel_{false};
    std::vector<std::expected<std::filesystem::path, std::string>> finished_;
    mutable std::mutex mutex_;
    std::size_t running_ = 0;
    std::vector<std::jthread> threads_;
};

} // namespace lueur
