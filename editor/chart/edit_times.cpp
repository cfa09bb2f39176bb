#include "editor/chart/edit_times.h"

#include <algorithm>
#include <array>

#include "core/solve/solution.h"

namespace lueur {

std::optional<EditTimes> edit_times(Scene scene, double time_limit, const std::atomic<bool>& cancel) {
    if (scene.materials.empty() || scene.luminaires.empty()) return {};
    Solution solution(std::make_shared<const Scene>(scene));
    const auto settled = [&] {
        while (!cancel && solution.step(cancel))
            if (solution.status().seconds > time_limit) return false;
        return !cancel && solution.status().settled;
    };
    if (!settled()) return {};
    std::array<double, 5> paint{}, dimmer{}, spectrum{};
    const auto seconds = [&](SolveFrom from) -> std::optional<double> {
        while (solution.prepare_edits(cancel)) {
        }
        solution.update(std::make_shared<const Scene>(scene), from);
        if (!settled()) return {};
        return solution.status().last_edit_seconds;
    };
    for (std::size_t k = 0; k < paint.size(); ++k) {
        const double step = 0.1 * static_cast<double>(k);
        scene.materials[k % scene.materials.size()].reflectance = 0.2 + step;
        const auto painted = seconds(SolveFrom::reflectance);
        scene.luminaires[k % scene.luminaires.size()].dimmer = 0.3 + step;
        const auto dimmed = seconds(SolveFrom::sources);
        scene.luminaires[k % scene.luminaires.size()].spectrum = Blackbody{2700 + 5000 * step};
        const auto recoloured = seconds(SolveFrom::sources);
        if (!painted || !dimmed || !recoloured) return {};
        paint[k] = *painted, dimmer[k] = *dimmed, spectrum[k] = *recoloured;
    }
    for (auto* times : {&paint, &dimmer, &spectrum}) std::ranges::sort(*times);
    return EditTimes{paint[2], dimmer[2], spectrum[2]};
}

} // namespace lueur
