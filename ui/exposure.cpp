#include "ui/exposure.h"

#include <atomic>

#include "core/scene/floor.h"
#include "core/view/picture.h"

namespace lueur {

namespace {

// Rules that choose something else than those did.
bool same_rules(const DisplaySettings& a, const DisplaySettings& b) {
    if (a.max_display_rule != b.max_display_rule || a.adaptation_automatic != b.adaptation_automatic) return false;
    switch (a.max_display_rule) {
    case MaxDisplayRule::by_hand:
        return true;
    case MaxDisplayRule::percentile:
        return a.percentile == b.percentile;
    case MaxDisplayRule::lecture:
        return a.primaries == b.primaries;
    }
    return false;
}

} // namespace

bool follows_picture(const DisplaySettings& display) {
    return display.max_display_rule != MaxDisplayRule::by_hand ||
           (display.tone_operator == ToneOperator::tumblin_rushmeier && display.adaptation_automatic);
}

DisplaySettings display_in_use(const DisplaySettings& scene, const Exposure& exposure) {
    auto settings = scene;
    if (!exposure.chosen) return settings;
    if (scene.max_display_rule != MaxDisplayRule::by_hand) settings.max_display = *exposure.chosen;
    if (scene.adaptation_automatic && exposure.adaptation > 0) settings.adaptation_luminance = exposure.adaptation;
    return settings;
}

std::optional<DisplaySettings> display_for(const Snapshot& snapshot, const DisplaySettings& display,
                                           const Camera& camera, double aspect) {
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
    double lecture = 0;
    if (display.max_display_rule == MaxDisplayRule::lecture) {
        const FloorFacts facts = floor_facts(*snapshot.scene);
        lecture = lecture_max_display(facts.luminous_flux, facts.floor_area, facts.mean_reflectance, display.primaries);
    }
    return resolved(display, luminances, lecture);
}

bool update_exposure(Exposure& exposure, const DisplaySettings& scene, const Snapshot& snapshot, const Camera& camera,
                     double aspect) {
    if (!follows_picture(scene)) {
        exposure.asked = false;
        return false;
    }
    const bool settled = snapshot.status.settled;
    const bool useful = settled || snapshot.status.stage == SolveStage::solving ||
                        snapshot.status.stage == SolveStage::gathering_rays ||
                        snapshot.status.stage == SolveStage::form_factors;
    if (!useful) return false;
    const bool first = !exposure.chosen;
    const bool first_settled = settled && !exposure.final;
    const bool follows =
        settled && !scene.max_display_locked && exposure.settled_revision != snapshot.document_revision;
    const bool other_rules = !first && !same_rules(exposure.rules, scene);
    if (!first && !first_settled && !follows && !other_rules && !exposure.asked) return false;
    const auto chosen = display_for(snapshot, scene, camera, aspect);
    if (settled) exposure.settled_revision = snapshot.document_revision;
    if (!chosen) {
        if (settled) exposure.final = true;
        return false;
    }
    exposure.asked = false;
    exposure.final = exposure.final || settled;
    exposure.chosen = chosen->max_display;
    exposure.adaptation = chosen->adaptation_luminance;
    exposure.rules = scene;
    return true;
}

} // namespace lueur
