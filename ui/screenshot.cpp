#include "ui/screenshot.h"

#include <cstdlib>
#include <ctime>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "core/display/image_file.h"
#include "core/view/picture.h"
#include "editor/picture_metadata.h"

namespace lueur {
namespace {

std::expected<std::filesystem::path, std::string> save(const ScreenshotParams& params,
                                                       const std::atomic<bool>& cancel) {
    const auto& snapshot = *params.snapshot;
    if (!snapshot.scene || !snapshot.mesh || !snapshot.world || !snapshot.field)
        return std::unexpected("There is no picture to save yet.");
    const FieldView view{snapshot.scene, snapshot.mesh, snapshot.world, snapshot.field};
    PictureParams size;
    size.width = params.width;
    size.height = params.height;
    const auto image = render_picture(view, params.camera, size, PictureQuantity::colour, cancel);
    if (cancel) return std::unexpected("The picture was not saved: cancelled.");
    auto display = params.display;
    if (display.clip == ClipRule::scale_all)
        display.max_display = std::max(display.max_display, largest_component(image));
    auto metadata =
        picture_metadata(*snapshot.scene, params.scene_file, params.camera, snapshot.status, PictureQuantity::colour);
    add_display_metadata(metadata, display);
    if (auto written = write_display_image(params.output, display_image(image, display), metadata); !written)
        return std::unexpected(written.error());
    return params.output;
}

} // namespace

std::filesystem::path new_screenshot_file() {
    std::error_code error;
    std::filesystem::path folder;
    if (const char* pictures = std::getenv("XDG_PICTURES_DIR");
        pictures && std::filesystem::is_directory(pictures, error))
        folder = pictures;
    else
        folder = std::filesystem::current_path(error);
    const auto stem = fmt::format("lueur-{:%Y%m%d-%H%M%S}", fmt::localtime(std::time(nullptr)));
    auto file = folder / (stem + ".png");
    for (int number = 2; std::filesystem::exists(file, error); ++number)
        file = folder / fmt::format("{}-{}.png", stem, number);
    return file;
}

Screenshots::Screenshots(std::function<void()> wake)
    : wake_(std::move(wake)) {}

Screenshots::~Screenshots() {
    cancel_ = true;
}

void Screenshots::start(ScreenshotParams params) {
    {
        const std::lock_guard lock(mutex_);
        ++running_;
    }
    threads_.emplace_back([this, params = std::move(params)] {
        auto result = save(params, cancel_);
        {
            const std::lock_guard lock(mutex_);
            finished_.push_back(std::move(result));
            --running_;
        }
        wake_();
    });
}

std::size_t Screenshots::running() const {
    const std::lock_guard lock(mutex_);
    return running_;
}

std::vector<std::expected<std::filesystem::path, std::string>> Screenshots::finished() {
    std::vector<std::jthread> done;
    const std::lock_guard lock(mutex_);
    if (running_ == 0) done = std::exchange(threads_, {}); // all but returned: joined as `done` ends
    return std::exchange(finished_, {});
}

} // namespace lueur
