#include "ui/exposure.h"

#include <atomic>

#include "core/view/picture.h"

namespace lueur {

DisplaySettings display_in_use(const DisplaySettings& scene, const Exposure& exposure) {
    auto settings = scene;
    if (scene.max_display_auto && exposure.chosen) settings.max_display = *exposure.chosen;
    return settings;
}

std::optional<double> max_display_of(const Snapshot& snapshot, const Camera& camera, double aspect) {
    if (!snapshot.scene || !snapshot.mesh || !snapshot.world || !snapshot.field) return {};
    const FieldView view{snapshot.scene, snapshot.mesh, snapshot.world, snapshot.field};
    PictureParams params;
    params.height = 64; // some 6,000 rays: under 5 ms, and the share of unclipped pixels is known to 1 %
    params.width = std::max(1, static_cast<int>(params.height * std::clamp(aspect, 0.2, 5.0)));
    params.samples_per_axis = 1;
    const std::atomic<bool> cancel{false};
    const auto picture = render_picture(view, camera, params, PictureQuantity::colour, cancel);
    std::vector<float> luminances;
    bool any = false;
    for (const auto& xyz : picture.xyz) {
        luminances.push_back(xyz.y);
        any = any || xyz.y > 0;
    }
    if (!any) return {};
    const double value = auto_max_display(std::move(luminances));
    if (!(value > 0)) return {};
    return value;
}

bool update_exposure(Exposure& exposure, const DisplaySettings& scene, const Snapshot& snapshot, const Camera& camera,
                     double aspect) {
    if (!scene.max_display_auto) {
        exposure.asked = false;
        return false;
    }
    const bool settled = snapshot.status.settled;
    const bool useful =
        settled || snapshot.status.stage == SolveStage::solving || snapshot.status.stage == SolveStage::gathering_rays;
    if (!useful) return false;
    const bool first = !exposure.chosen;
    const bool first_settled = settled && !exposure.final;
    const bool follows =
        settled && !scene.max_display_locked && exposure.settled_revision != snapshot.document_revision;
    if (!first && !first_settled && !follows && !exposure.asked) return false;
    const auto value = max_display_of(snapshot, camera, aspect);
    if (settled) exposure.settled_revision = snapshot.document_revision;
    if (!value) {
        if (settled) exposure.final = true;
        return false;
    }
    exposure.asked = false;
    exposure.final = exposure.final || settled;
    exposure.chosen = value;
    return true;
}

} // namespace lueur
