#include "core/spectrum/wavelengths.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

#include "core/spectrum/channel_hat.h"
#include "core/spectrum/colour.h"
#include "core/spectrum/observer_integral.h"

namespace lueur {

namespace {

constexpr double uniform_first_nm = 400, uniform_last_nm = 700;
constexpr double visible_first_nm = 380, visible_last_nm = 780;
constexpr int min_uniform = 4, max_uniform = 31;

Wavelengths make_uniform(const WavelengthsSpec& spec) {
    Wavelengths wavelengths{.spec = spec, .nm = {}, .xyz_weight = {}, .watt_weight = {}};
    const double spacing = (uniform_last_nm - uniform_first_nm) / (spec.count - 1);
    for (int k = 0; k < spec.count; ++k) wavelengths.nm.push_back(uniform_first_nm + k * spacing);
    wavelengths.nm.back() = uniform_last_nm;
    for (int k = 0; k < spec.count; ++k) {
        const Spectrum hat = channel_hat(wavelengths, k);
        const Spectrum powers = emission_hat(wavelengths, k);
        wavelengths.watt_weight.push_back(integral(powers, powers.nm.front(), powers.nm.back(), Outside::zero));
        wavelengths.xyz_weight.push_back(luminous_efficacy_km * observer_integral(hat, Outside::zero));
    }
    // The end channels stand for the observer's tails outside 400..700 nm too, so that a flat spectrum has the XYZ of
    // its 1 nm integral over 360..830 nm: white stays white.
    const Spectrum below{{observer_first_nm, uniform_first_nm}, {1, 1}},
        above{{uniform_last_nm, observer_last_nm}, {1, 1}};
    wavelengths.xyz_weight.front() += luminous_efficacy_km * observer_integral(below, Outside::zero);
    wavelengths.xyz_weight.back() += luminous_efficacy_km * observer_integral(above, Outside::zero);
    return wavelengths;
}

Wavelengths make_rgb(const WavelengthsSpec& spec) {
    const glm::dmat3 xyz = rgb_white_lumens() * xyz_from_rgb(srgb);
    return {.spec = spec,
            .nm = {611, 549, 464},
            .xyz_weight = {xyz[0], xyz[1], xyz[2]},
            .watt_weight = {1.0 / 3, 1.0 / 3, 1.0 / 3}}; // each channel carries a third of the evenly spread watt
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
    if (text == "rgb") return WavelengthsSpec{WavelengthRule::rgb, 3};
    constexpr std::string_view prefix = "uniform:";
    if (text.starts_with(prefix)) {
        const std::string_view number = text.substr(prefix.size());
        int count = 0;
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
        if (error == std::errc() && end == number.data() + number.size() && count >= min_uniform &&
            count <= max_uniform)
            return WavelengthsSpec{WavelengthRule::uniform, count};
    }
    return std::unexpected(fmt::format("wavelengths \"{}\" are not known; allowed: rgb, uniform:N with N from {} to {}",
                                       text, min_uniform, max_uniform));
}

std::string to_string(const WavelengthsSpec& spec) {
    switch (spec.rule) {
    case WavelengthRule::uniform:
        return fmt::format("uniform:{}", spec.count);
    case WavelengthRule::rgb:
        return "rgb";
    }
    return {};
}

Wavelengths make_wavelengths(const WavelengthsSpec& spec) {
    switch (spec.rule) {
    case WavelengthRule::uniform:
        return make_uniform({spec.rule, std::clamp(spec.count, min_uniform, max_uniform)});
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

} // namespace lueur
