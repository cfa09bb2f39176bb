#include "core/spectrum/wavelengths.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

#include "core/spectrum/channel_hat.h"
#include "core/spectrum/colour.h"
#include "core/spectrum/folded_samples.h"
#include "core/spectrum/observer_integral.h"
#include "core/spectrum/operations.h"
#include "core/spectrum/point_samples.h"
#include "core/spectrum/visible_grid.h"

namespace lueur {

namespace {

constexpr int min_uniform = 4, max_uniform = 81, most_within_400_700 = 31;
constexpr int min_folded = 1, max_folded = 32;

constexpr const char* allowed_rules =
    "auto, rgb, uniform:N with N from 4 to 81, meyer:4, meyer:6, meyer:10, gauss:N with N from 3 to 20, folded:N or N "
    "alone with N from 1 to 32";

// The lights that are seen, each with the same luminous flux; equal energy without any.
std::vector<Spectrum> lights_of_one_flux(const SpectralContent& content) {
    std::vector<Spectrum> lights;
    for (const Spectrum& light : content.lights)
        if (const double y = xyz_from_spectrum(light).y; y > 0) lights.push_back(scaled(light, 1 / y));
    if (lights.empty()) lights.push_back({{observer_first_nm, observer_last_nm}, {1, 1}});
    return lights;
}

Wavelengths make_uniform(const WavelengthsSpec& spec, const SpectralContent& content) {
    Wavelengths wavelengths;
    wavelengths.asked = wavelengths.spec = spec;
    const bool narrow = spec.count <= most_within_400_700;
    const double first = narrow ? 400 : visible_first_nm, last = narrow ? 700 : visible_last_nm;
    const double spacing = (last - first) / (spec.count - 1);
    for (int k = 0; k < spec.count; ++k) wavelengths.nm.push_back(first + k * spacing);
    wavelengths.nm.back() = last;
    // The observer is averaged under each hat with the scene's own light, so that a light's lines count where they
    // are; where that has nothing, with equal energy. The end channels stand for the observer's tails too: white stays
    // the white of the 1 nm integral over 360..830 nm.
    VisibleGrid moments{};
    std::vector<double> powers(static_cast<std::size_t>(spec.count), 0.0);
    for (const Spectrum& light : lights_of_one_flux(content)) {
        const VisibleGrid of_light = moments_on_visible_grid(light);
        for (std::size_t j = 0; j < moments.size(); ++j) moments[j] += of_light[j];
        const std::vector<double> means = emission_channels(wavelengths, light);
        for (std::size_t k = 0; k < means.size(); ++k) powers[k] += means[k];
    }
    for (int k = 0; k < spec.count; ++k) {
        const Spectrum hat = channel_hat(wavelengths, k), whole = emission_hat(wavelengths, k);
        Xyz seen(0), seen_flat(0);
        for (int j = 0; j < visible_count; ++j) {
            const double nm = observer_first_nm + j;
            const bool tail = (k == 0 && nm < first) || (k + 1 == spec.count && nm > last);
            const Xyz part = (tail ? 1 : value_at(hat, nm, Outside::zero)) * observer_xyz(nm);
            seen += moments[static_cast<std::size_t>(j)] * part;
            seen_flat += part;
        }
        const double power = powers[static_cast<std::size_t>(k)];
        wavelengths.xyz_weight.push_back(luminous_efficacy_km * (power > 0 ? seen / power : seen_flat));
        wavelengths.watt_weight.push_back(integral(whole, whole.nm.front(), whole.nm.back(), Outside::zero));
    }
    return wavelengths;
}

Wavelengths make_rgb(const WavelengthsSpec& spec) {
    const glm::dmat3 xyz = rgb_white_lumens() * xyz_from_rgb(srgb);
    Wavelengths wavelengths;
    wavelengths.asked = wavelengths.spec = spec;
    wavelengths.nm = {611, 549, 464};
    wavelengths.xyz_weight = {xyz[0], xyz[1], xyz[2]};
    wavelengths.watt_weight = {1.0 / 3, 1.0 / 3, 1.0 / 3}; // each channel carries a third of the evenly spread watt
    return wavelengths;
}

Wavelengths make_points(const WavelengthsSpec& spec, const PointSamples& samples) {
    Wavelengths wavelengths;
    wavelengths.asked = wavelengths.spec = spec;
    wavelengths.nm = samples.nm;
    for (const Xyz& weight : samples.weight) wavelengths.xyz_weight.push_back(luminous_efficacy_km * weight);
    wavelengths.watt_weight = samples.width;
    return wavelengths;
}

template <typename Number>
Xyz weighted_sum(const Wavelengths& wavelengths, std::span<const Number> channels) {
    Xyz sum(0);
    const std::size_t count = std::min(wavelengths.xyz_weight.size(), channels.size());
    for (std::size_t k = 0; k < count; ++k) sum += wavelengths.xyz_weight[k] * static_cast<double>(channels[k]);
    return sum;
}

} // namespace

Spectrum channel_hat(const Wavelengths& wavelengths, int channel) {
    Spectrum hat;
    for (int neighbour = std::max(channel - 1, 0); neighbour <= std::min(channel + 1, wavelengths.size() - 1);
         ++neighbour) {
        hat.nm.push_back(wavelengths.nm[static_cast<std::size_t>(neighbour)]);
        hat.value.push_back(neighbour == channel ? 1 : 0);
    }
    return hat;
}

Spectrum emission_hat(const Wavelengths& wavelengths, int channel) {
    Spectrum hat = channel_hat(wavelengths, channel);
    if (channel == 0) {
        hat.nm.insert(hat.nm.begin(), visible_first_nm);
        hat.value.insert(hat.value.begin(), 1);
    }
    if (channel == wavelengths.size() - 1) {
        hat.nm.push_back(visible_last_nm);
        hat.value.push_back(1);
    }
    return hat;
}

double rgb_white_lumens() {
    const Spectrum flat{{observer_first_nm, observer_last_nm}, {1, 1}};
    return luminous_efficacy_km * observer_integral(flat, Outside::zero).y / 400;
}

std::expected<WavelengthsSpec, std::string> parse_wavelengths(std::string_view text) {
    const auto wrong = [&] {
        return std::unexpected(fmt::format("wavelengths \"{}\" are not known; allowed: {}", text, allowed_rules));
    };
    if (text == "rgb") return WavelengthsSpec{WavelengthRule::rgb, 3};
    if (text == "auto") return WavelengthsSpec{WavelengthRule::automatic, 0};
    const std::size_t colon = text.find(':');
    const std::string_view rule = colon == std::string_view::npos ? "folded" : text.substr(0, colon);
    const std::string_view number = colon == std::string_view::npos ? text : text.substr(colon + 1);
    int count = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
    if (error != std::errc() || end != number.data() + number.size()) return wrong();
    const auto within = [&](int least, int most) { return count >= least && count <= most; };
    if (rule == "uniform" && within(min_uniform, max_uniform)) return WavelengthsSpec{WavelengthRule::uniform, count};
    if (rule == "meyer" && std::ranges::find(meyer_counts, count) != std::end(meyer_counts))
        return WavelengthsSpec{WavelengthRule::meyer, count};
    if (rule == "gauss" && within(fewest_gauss, most_gauss)) return WavelengthsSpec{WavelengthRule::gauss, count};
    if (rule == "folded" && within(min_folded, max_folded)) return WavelengthsSpec{WavelengthRule::folded, count};
    return wrong();
}

std::string to_string(const WavelengthsSpec& spec) {
    switch (spec.rule) {
    case WavelengthRule::uniform:
        return fmt::format("uniform:{}", spec.count);
    case WavelengthRule::meyer:
        return fmt::format("meyer:{}", spec.count);
    case WavelengthRule::gauss:
        return fmt::format("gauss:{}", spec.count);
    case WavelengthRule::folded:
        return fmt::format("folded:{}", spec.count);
    case WavelengthRule::automatic:
        return "auto";
    case WavelengthRule::rgb:
        return "rgb";
    }
    return {};
}

Wavelengths make_folded(const WavelengthsSpec& spec, const std::vector<double>& nm, const SpectralContent& content,
                        const FoldedFit& fit) {
    Wavelengths wavelengths;
    wavelengths.asked = spec;
    wavelengths.spec = {WavelengthRule::folded, static_cast<int>(nm.size())};
    wavelengths.lights = content.lights;
    wavelengths.samples = static_cast<int>(nm.size());
    for (std::size_t light = 0; light < content.lights.size(); ++light) {
        const FoldedWeights weights = fit.weights(light, nm);
        Xyz white(0);
        double watts = 0;
        for (std::size_t k = 0; k < nm.size(); ++k)
            white += luminous_efficacy_km * weights.xyz[k], watts += weights.watt[k];
        const double norm = white.y > 0 ? white.y : watts > 0 ? watts : 1;
        wavelengths.light_norm.push_back(norm);
        for (std::size_t k = 0; k < nm.size(); ++k) {
            wavelengths.nm.push_back(nm[k]);
            wavelengths.xyz_weight.push_back(luminous_efficacy_km / norm * weights.xyz[k]);
            wavelengths.watt_weight.push_back(weights.watt[k] / norm);
        }
    }
    return wavelengths;
}

Wavelengths make_wavelengths(const WavelengthsSpec& spec, const SpectralContent& content) {
    switch (spec.rule) {
    case WavelengthRule::uniform:
        return make_uniform({spec.rule, std::clamp(spec.count, min_uniform, max_uniform)}, content);
    case WavelengthRule::meyer:
        return make_points(spec, meyer_samples(spec.count));
    case WavelengthRule::gauss:
        return make_points(spec, gauss_samples(std::clamp(spec.count, fewest_gauss, most_gauss)));
    case WavelengthRule::folded:
    case WavelengthRule::automatic: {
        const SpectralContent lit = with_a_light(content);
        const FoldedFit fit(lit);
        const int count = spec.rule == WavelengthRule::automatic ? 8 : std::clamp(spec.count, min_folded, max_folded);
        return make_folded(spec, fit.choose(count), lit, fit);
    }
    case WavelengthRule::rgb:
        return make_rgb({spec.rule, 3});
    }
    return {};
}

Xyz xyz_from_channels(const Wavelengths& wavelengths, std::span<const float> channels) {
    return weighted_sum(wavelengths, channels);
}
Xyz xyz_from_channels(const Wavelengths& wavelengths, std::span<const double> channels) {
    return weighted_sum(wavelengths, channels);
}

double watts_from_channels(const Wavelengths& wavelengths, std::span<const double> channels) {
    double sum = 0;
    const std::size_t count = std::min(wavelengths.watt_weight.size(), channels.size());
    for (std::size_t k = 0; k < count; ++k) sum += wavelengths.watt_weight[k] * channels[k];
    return sum;
}

Spectrum spectrum_from_channels(const Wavelengths& wavelengths, std::span<const double> channels) {
    Spectrum spectrum;
    if (wavelengths.spec.rule == WavelengthRule::rgb) return spectrum;
    const std::size_t block = static_cast<std::size_t>(wavelengths.folded() ? wavelengths.samples : wavelengths.size());
    const auto value = [&](std::size_t first, double nm) { // linear between the samples, constant outside
        const auto begin = wavelengths.nm.begin() + static_cast<std::ptrdiff_t>(first),
                   end = begin + static_cast<std::ptrdiff_t>(block);
        const auto above = std::lower_bound(begin, end, nm);
        const auto channel = [&](auto place) {
            return channels[static_cast<std::size_t>(place - wavelengths.nm.begin())];
        };
        if (above == begin) return channel(begin);
        if (above == end) return channel(end - 1);
        const double part = (nm - *(above - 1)) / (*above - *(above - 1));
        return (1 - part) * channel(above - 1) + part * channel(above);
    };
    if (!wavelengths.folded()) {
        for (double nm = visible_first_nm; nm <= visible_last_nm; nm += 5) {
            spectrum.nm.push_back(nm);
            spectrum.value.push_back(value(0, nm));
        }
        return spectrum;
    }
    // Whole nanometres keep each light's power: its moments, not its values there.
    const int first = static_cast<int>(visible_first_nm), last = static_cast<int>(visible_last_nm);
    for (int nm = first; nm <= last; ++nm) spectrum.nm.push_back(nm);
    spectrum.value.assign(spectrum.nm.size(), 0);
    for (std::size_t light = 0; light < wavelengths.lights.size(); ++light) {
        const VisibleGrid moments = moments_on_visible_grid(wavelengths.lights[light]);
        for (int nm = first; nm <= last; ++nm)
            spectrum.value[static_cast<std::size_t>(nm - first)] +=
                moments[static_cast<std::size_t>(nm - observer_first_nm)] / wavelengths.light_norm[light] *
                value(light * block, nm);
    }
    return spectrum;
}

} // namespace lueur
