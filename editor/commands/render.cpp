// `lueur render`: solve a scene and save a picture of it.
#include <cstdio>

#include <fmt/format.h>

#include "core/display/image_file.h"
#include "core/scene/scene_file.h"
#include "editor/commands/batch_session.h"
#include "editor/commands/output_file.h"
#include "editor/picture_metadata.h"

namespace lueur {

namespace {

DisplaySettings display_of(const RenderCommand& command, DisplaySettings display) {
    if (command.gamma) {
        display.gamma = *command.gamma;
        display.curve = TransferCurve::gamma;
    }
    if (command.curve) display.curve = *command.curve;
    if (command.clip) display.clip = *command.clip;
    // The scene's MAXDISPLAY is a luminance: it says nothing of lux.
    if (command.max_display_auto || command.quantity == PictureQuantity::illuminance) display.max_display_auto = true;
    if (command.max_display) {
        display.max_display = *command.max_display;
        display.max_display_auto = false;
    }
    return display;
}

// The MAXDISPLAY that is really used, so that the picture can be made again.
double used_max_display(const RadianceImage& image, const DisplaySettings& display) {
    if (display.clip == ClipRule::scale_all)
        if (const double largest = largest_component(image); largest > 0) return largest;
    if (!display.max_display_auto) return display.max_display;
    std::vector<float> luminances;
    luminances.reserve(image.xyz.size());
    for (const auto& xyz : image.xyz) luminances.push_back(xyz.y);
    return auto_max_display(std::move(luminances));
}

int render(const RenderCommand& command, BatchSession& session) {
    auto scene = session.load();
    const auto place = check_writable(command.output);
    if (!place) session.error(place.error());
    if (!scene || !place) return exit_mistake;
    scene->display = display_of(command, scene->display);
    const auto faults = check(*scene);
    for (const auto& fault : faults) session.error(command.batch.scene.string() + ": " + fault);
    if (!faults.empty()) return exit_mistake;

    Solution solution(scene);
    if (const auto solved = session.solve(solution, false); !solved) return solved.error();

    RadianceImage image;
    session.timed("picture", [&] {
        const FieldView view{scene, solution.mesh(), solution.world(), solution.field()};
        const PictureParams size{.width = command.width, .height = command.height};
        image = render_picture(view, scene->camera, size, command.quantity, session.cancel(),
                               [&](double share) { session.bar().show("picture", share); });
    });
    if (session.cancel()) return exit_interrupted;

    std::expected<void, std::string> written;
    session.timed("write", [&] {
        auto metadata =
            picture_metadata(*scene, command.batch.scene, scene->camera, solution.status(), command.quantity);
        if (is_radiance_image_name(command.output)) {
            written = write_radiance_image(command.output, image, metadata);
            return;
        }
        scene->display.max_display = used_max_display(image, scene->display);
        add_display_metadata(metadata, scene->display);
        written = write_display_image(command.output, display_image(image, scene->display), metadata);
    });
    if (!written) return session.failed(written.error());
    session.bar().wipe();
    fmt::print("{}: {}x{}, solved in {:.2f} s, {}\n", command.output.string(), image.width, image.height,
               session.solve_seconds(), error_text(solution.status()));
    return session.finish(solution);
}

} // namespace

int run(const RenderCommand& command) {
    return run_batch("render", command.batch, [&](BatchSession& session) { return render(command, session); });
}

} // namespace lueur
