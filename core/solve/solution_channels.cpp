// Sources and paints of a solution in channels: which wavelengths the scene needs, and what everything is in them.
#include <algorithm>
#include <cmath>
#include <future>
#include <utility>

#include <fmt/format.h>

#include "core/scene/luminaire.h"
#include "core/scene/spectral_content.h"
#include "core/solve/solution_steps.h"

namespace lueur {

using State = Solution::State;

namespace {

// But for rounding: a lamp of the same flux in its own channels may differ in its last digit.
bool nearly_equal(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
    return std::ranges::equal(a, b, [](const std::vector<double>& one, const std::vector<double>& other) {
        return std::ranges::equal(one, other,
                                  [](double x, double y) { return std::abs(x - y) <= 1e-12 * std::abs(x); });
    });
}

} // namespace

void plan_channels(State& s) {
    s.choosing = std::async(std::launch::async,
                            [scene = s.scene, before = s.choice] { return choose_wavelengths(scene, before); });
}

namespace {

// Everything in the wavelengths that are chosen.
void read_channels(State& s) {
    const Scene& scene = *s.scene;
    const auto scene_before = std::exchange(s.scene_of_channels, s.scene);
    const auto wavelengths_before = s.wavelengths;
    s.wavelengths = s.choice.wavelengths;
    s.status.predicted_colour_error = s.choice.predicted_error;
    s.status.wavelengths = s.choice.words;
    const bool compare = scene.solve.compare_trichromatic && scene.solve.wavelengths.rule != WavelengthRule::rgb &&
                         s.wavelengths->size() + 3 <= max_channels;
    const bool compared_before = s.trichromatic.has_value();
    s.trichromatic = compare ? std::optional(make_wavelengths(WavelengthsSpec{WavelengthRule::rgb, 3})) : std::nullopt;
    const auto with_trichromatic = [&](const auto& channels_in) {
        std::vector<double> channels = channels_in(*s.wavelengths);
        if (s.trichromatic) {
            const std::vector<double> more = channels_in(*s.trichromatic);
            channels.insert(channels.end(), more.begin(), more.end());
        }
        return channels;
    };
    const bool same_paints = scene_before && scene_before->materials == scene.materials &&
                             wavelengths_before == s.wavelengths && compared_before == compare;
    if (!same_paints) {
        s.material_rho.clear();
        for (const Material& material : scene.materials)
            s.material_rho.push_back(
                with_trichromatic([&](const Wavelengths& w) { return reflectance_channels(material, w); }));
    }
    s.luminaire_exitance.clear();
    s.status.emitted_lumens = 0;
    std::string dark;
    for (const Luminaire& luminaire : scene.luminaires) {
        s.luminaire_exitance.push_back(
            with_trichromatic([&](const Wavelengths& w) { return exitance_channels(scene, luminaire, w); }));
        const double lumens =
            xyz_from_channels(*s.wavelengths, s.luminaire_exitance.back()).y * emitting_area(scene, luminaire);
        s.status.emitted_lumens += lumens;
        if (!(lumens > 0) && luminous_flux(scene, luminaire) > 0 && dark.empty())
            dark =
                fmt::format("\"{}\" is dark: its spectrum has nothing at the wavelengths of {}; folded samples see it",
                            luminaire.name, to_string(s.wavelengths->spec));
    }
    s.object_luminaire = luminaire_of_objects(scene);
    if (s.status.emitted_lumens <= 0 && dark.empty()) dark = "nothing emits light: the picture is black";
    s.status.message = dark;
}

// Other paints only: the wavelengths there are show them nearly as well.
bool differs_in_paints(const Scene& a, const Scene& b) {
    return a.solve.wavelengths == b.solve.wavelengths && a.solve.colour_error == b.solve.colour_error &&
           std::ranges::equal(a.luminaires, b.luminaires, {}, &Luminaire::spectrum, &Luminaire::spectrum);
}

} // namespace

void make_channels(State& s) {
    s.choice = s.choosing.valid() ? s.choosing.get() : choose_wavelengths(s.scene, s.choice);
    s.choice_waits = false;
    read_channels(s);
}

SameChannels take_channels(State& s, bool may_wait) {
    const auto wavelengths_before = s.wavelengths;
    const auto rho_before = s.material_rho, exitance_before = s.luminaire_exitance;
    const int channels_before = s.channels();
    if (s.choosing.valid()) s.choice = s.choosing.get(); // of a scene before
    s.choice_waits = may_wait && differs_in_paints(*s.choice.scene, *s.scene);
    s.choice_waits ? read_channels(s) : make_channels(s);
    const bool same_channels = s.channels() == channels_before && s.wavelengths->nm == wavelengths_before->nm &&
                               s.wavelengths->spec == wavelengths_before->spec;
    // Another lamp of the same flux where all lamps have one spectrum: only the weights to XYZ have changed.
    return {same_channels,
            same_channels && s.material_rho == rho_before && nearly_equal(s.luminaire_exitance, exitance_before)};
}

double luminous(const State& s, const float* channels) {
    double y = 0;
    for (int c = 0; c < s.wavelengths->size(); ++c) y += s.wavelengths->xyz_weight[c].y * channels[c];
    return y;
}

double mean_luminous_reflectance(const State& s) {
    double mean_rho = 0, area = 0, white = 0;
    for (const Xyz& w : s.wavelengths->xyz_weight) white += w.y;
    std::vector<double> of_material;
    for (const std::vector<double>& rho : s.material_rho) {
        of_material.push_back(0);
        for (std::size_t c = 0; c < s.wavelengths->xyz_weight.size(); ++c)
            of_material.back() += s.wavelengths->xyz_weight[c].y * rho[c] / white;
    }
    for (std::uint32_t v = 0; v < s.mesh.coarse_vertex_count; ++v) {
        mean_rho += s.coarse_area[v] * of_material[s.material_of(s.mesh.vertices[v].surface)];
        area += s.coarse_area[v];
    }
    return area > 0 ? mean_rho / area : 0;
}

std::vector<float> flux_weights(const State& s) {
    // A fitted sample may weigh less than nothing in Y: flux is not shot for its sake. The trichromatic channels ride
    // along.
    std::vector<float> weight(static_cast<std::size_t>(s.channels()), 0.0f);
    double mean = 0;
    for (const Xyz& w : s.wavelengths->xyz_weight) mean += std::max(w.y, 0.0) / s.wavelengths->size();
    for (int c = 0; c < s.wavelengths->size(); ++c)
        weight[c] = static_cast<float>(0.95 * std::max(s.wavelengths->xyz_weight[c].y, 0.0) + 0.05 * mean);
    return weight;
}

} // namespace lueur
