// `lueur render`: solve a scene and save a picture of it.
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "core/display/false_colour.h"
#include "core/display/image_file.h"
#include "core/scene/floor.h"
#include "core/scene/scene_file.h"
#include "core/solve/choose_solver.h"
#include "core/transport/mesh.h"
#include "core/view/reference_picture.h"
#include "core/view/spectral_picture.h"
#include "editor/commands/batch_session.h"
#include "editor/commands/output_file.h"
#include "editor/false_colour_range.h"
#include "editor/picture_metadata.h"
#include "editor/write_picture.h"

namespace lueur {

namespace {

FalseColourSettings scale_of(const FalseColourOverrides& wanted, FalseColourSettings scale) {
    if (wanted.automatic) scale.automatic = true;
    if (wanted.range) {
        scale.automatic = false;
        scale.low = wanted.range->first;
        scale.high = wanted.range->second;
    }
    if (wanted.logarithmic) scale.logarithmic = *wanted.logarithmic;
    if (wanted.levels) {
        scale.isolines = true;
        scale.levels = *wanted.levels;
    }
    if (wanted.no_isolines) scale.isolines = false;
    return scale;
}

DisplaySettings display_of(const RenderCommand& command, DisplaySettings display) {
    if (command.gamma) {
        display.gamma = *command.gamma;
        display.curve = TransferCurve::gamma;
    }
    if (command.curve) display.curve = *command.curve;
    if (command.clip) display.clip = *command.clip;
    if (command.tone_operator) display.tone_operator = *command.tone_operator;
    if (command.adaptation) {
        display.adaptation_luminance = *command.adaptation;
        display.adaptation_automatic = false;
    }
    if (command.adaptation_auto) display.adaptation_automatic = true;
    if (command.primaries) display.primaries = *command.primaries;
    if (command.white_luminance) display.white_luminance = *command.white_luminance;
    display.mark_clipped = display.mark_clipped || command.mark_clipped;
    display.mark_out_of_gamut = display.mark_out_of_gamut || command.mark_out_of_gamut;
    // The scene's MAXDISPLAY is a luminance: it says nothing of lux.
    if (command.quantity == PictureQuantity::illuminance) display.max_display_rule = MaxDisplayRule::percentile;
    if (command.max_display_rule) display.max_display_rule = *command.max_display_rule;
    if (command.percentile) display.percentile = *command.percentile;
    if (command.max_display) {
        display.max_display = *command.max_display;
        display.max_display_rule = MaxDisplayRule::by_hand;
    }
    if (command.quantity == PictureQuantity::illuminance)
        display.illuminance_scale = scale_of(command.false_colour, display.illuminance_scale);
    else
        display.luminance_scale = scale_of(command.false_colour, display.luminance_scale);
    return display;
}

// A traced picture has no field: its pixels are what scales are fitted to.
Field field_of_pixels(const RadianceImage& image) {
    Field field;
    field.irradiance_xyz = field.reflected_xyz = image.xyz;
    return field;
}

// The numbers that are really used, so that the picture can be made again.
DisplaySettings display_used(const RadianceImage& image, const Scene& scene, const Field& field,
                             const std::vector<float>& areas) {
    DisplaySettings display = scene.display;
    std::vector<float> luminances;
    luminances.reserve(image.xyz.size());
    for (const auto& xyz : image.xyz) luminances.push_back(xyz.y);
    double lecture = 0;
    if (display.max_display_rule == MaxDisplayRule::lecture) {
        const FloorFacts facts = floor_facts(scene);
        lecture = lecture_max_display(facts.luminous_flux, facts.floor_area, facts.mean_reflectance, display.primaries);
    }
    display = resolved(display, luminances, lecture);
    display.luminance_scale = fitted_to(display.luminance_scale, field, areas, PictureQuantity::luminance);
    display.illuminance_scale = fitted_to(display.illuminance_scale, field, areas, PictureQuantity::illuminance);
    return display;
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

    if (command.spectral && (command.output.extension() != ".exr" || command.quantity != PictureQuantity::colour ||
                             scene->solve.wavelengths.rule == WavelengthRule::rgb)) {
        session.error("--spectral: needs an output ending in .exr, --quantity colour and other wavelengths than rgb");
        return exit_mistake;
    }
    const bool traced = chosen_solver(*scene) == SolverKind::reference;
    const bool of_the_field =
        command.quantity == PictureQuantity::colour_difference || command.quantity == PictureQuantity::error;
    if (traced && (command.spectral || of_the_field)) {
        session.error(fmt::format("{}: the reference solver traces pictures without a field; another --solver has one",
                                  command.spectral ? "--spectral" : "--quantity " + to_string(command.quantity)));
        return exit_mistake;
    }
    if (command.quantity == PictureQuantity::colour_difference) {
        if (scene->solve.wavelengths.rule == WavelengthRule::rgb) {
            session.error("--quantity colour_difference: compares other wavelengths with rgb; needs others than rgb");
            return exit_mistake;
        }
        scene->solve.compare_trichromatic = true;
    }
    Solution solution(scene);
    if (const auto solved = session.solve(solution, traced); !solved) return solved.error();
    SolveStatus status = solution.status();

    ReferencePicture picture;
    RadianceImage image;
    SpectralImage spectral;
    session.timed("picture", [&] {
        if (traced) {
            picture = trace_picture(solution, scene->camera,
                                    {.width = command.width,
                                     .height = command.height,
                                     .quantity = command.quantity,
                                     .target_error = scene->solve.target_error,
                                     .time_limit = command.batch.time_limit,
                                     .seed = scene->solve.seed},
                                    session.cancel(), [&](double share) { session.bar().show("paths", share); });
            image = picture.image;
            status.estimated_error = picture.relative_error;
            status.paths = std::uint64_t(picture.passes) * image.xyz.size();
            status.settled = picture.relative_error <= scene->solve.target_error;
            return;
        }
        const FieldView view{scene, solution.mesh(), solution.world(), solution.field()};
        const PictureParams size{.width = command.width, .height = command.height};
        image = render_picture(view, scene->camera, size, command.quantity, session.cancel(),
                               [&](double share) { session.bar().show("picture", share); });
        if (command.spectral && !session.cancel())
            spectral = render_spectral_picture(view, scene->camera, size, session.cancel(),
                                               [&](double share) { session.bar().show("wavelengths", share); });
    });
    if (session.cancel()) return exit_interrupted;

    std::expected<void, std::string> written;
    session.timed("write", [&] {
        auto metadata = picture_metadata(*scene, command.batch.scene, scene->camera, status, command.quantity);
        if (command.spectral) {
            written = spectral.planes.empty()
                          ? std::unexpected(std::string("--spectral: the scene is too large to keep its wavelengths"))
                          : write_spectral_image(command.output, spectral, image, metadata);
            return;
        }
        PictureFile file{command.output, command.quantity, {}, command.false_colour.on, command.bits};
        if (!is_radiance_image_name(command.output))
            file.display =
                traced ? display_used(image, *scene, field_of_pixels(image), std::vector<float>(image.xyz.size(), 1.0f))
                       : display_used(image, *scene, *solution.field(), vertex_areas(*solution.mesh()));
        written = write_picture(file, image, std::move(metadata));
    });
    if (!written) return session.failed(written.error());
    session.bar().wipe();
    if (traced)
        fmt::print("{}: {}x{}, {} paths a pixel, standard error of a pixel {:.2f} %\n", command.output.string(),
                   image.width, image.height, picture.passes, 100 * picture.relative_error);
    else
        fmt::print("{}: {}x{}, solved in {:.2f} s, {}\n", command.output.string(), image.width, image.height,
                   session.solve_seconds(), error_text(status));
    return session.finish(solution, status);
}

} // namespace

int run(const RenderCommand& command) {
    return run_batch("render", command.batch, [&](BatchSession& session) { return render(command, session); });
}

} // namespace lueur
