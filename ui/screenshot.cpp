#include "ui/screenshot.h"

#include <cstdlib>
#include <ctime>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "core/display/image_file.h"
#include "core/view/picture.h"
#include "core/view/spectral_picture.h"
#include "editor/picture_metadata.h"
#include "editor/write_picture.h"

namespace lueur {
namespace {

std::expected<std::filesystem::path, std::string> save(const ScreenshotParams& params,
                                                       const std::atomic<bool>& cancel) {
    const auto& snapshot = *params.snapshot;
    if (!snapshot.scene || !snapshot.mesh || !snapshot.world || !snapshot.field)
        return std::unexpected("There is no picture to save yet.");
    FieldView view{snapshot.scene, snapshot.mesh, snapshot.world, snapshot.field};
    PictureParams size;
    size.width = params.width;
    size.height = params.height;
    auto image = render_picture(view, params.camera, size, params.quantity, cancel);
    if (params.beside_rgb && snapshot.field->trichromatic && !cancel) {
        view.trichromatic = true;
        const auto rgb = render_picture(view, params.camera, size, params.quantity, cancel);
        for (std::size_t i = 0; i < rgb.xyz.size(); ++i)
            if (static_cast<int>(i) % params.width >= params.width / 2) image.xyz[i] = rgb.xyz[i];
    }
    SpectralImage spectral;
    if (params.spectral && !cancel) {
        spectral = render_spectral_picture(view, params.camera, size, cancel);
        if (!cancel && spectral.planes.empty())
            return std::unexpected(
                "The spectral picture was not saved: it needs other wavelengths than RGB, and a scene "
                "small enough to keep its channels.");
    }
    if (cancel) return std::unexpected("The picture was not saved: cancelled.");
    const auto metadata =
        picture_metadata(*snapshot.scene, params.scene_file, params.camera, snapshot.status, params.quantity);
    if (params.spectral) {
        if (auto written = write_spectral_image(params.output, spectral, image, metadata); !written)
            return std::unexpected(written.error());
        return params.output;
    }
    const PictureFile file{params.output, params.quantity, params.display, params.false_colour, params.bits};
    if (auto written = write_picture(file, image, metadata); !written) return std::unexpected(written.error());
    return params.output;
}

} // namespace

void take_view(ScreenshotParams& params, ViewMode view) {
    params.beside_rgb = view == ViewMode::side_by_side;
    switch (view) {
    case ViewMode::difference:
        params.quantity = PictureQuantity::colour_difference;
        params.false_colour = true;
        return;
    case ViewMode::error:
        params.quantity = PictureQuantity::error;
        params.false_colour = true;
        return;
    case ViewMode::shaded:
    case ViewMode::elements:
    case ViewMode::unshot:
    case ViewMode::side_by_side:
        params.quantity = PictureQuantity::colour;
        params.false_colour = false;
        return;
    case ViewMode::luminance:
        params.quantity = PictureQuantity::luminance;
        params.false_colour = true;
        return;
    case ViewMode::illuminance:
        params.quantity = PictureQuantity::illuminance;
        params.false_colour = true;
        return;
    }
}

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
