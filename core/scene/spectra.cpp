#include "core/scene/spectra.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/spectrum/colour_temperature.h"
#include "core/spectrum/observer.h"
#include "core/spectrum/operations.h"
#include "core/spectrum/overload.h"
#include "core/spectrum/rgb_spectrum.h"

namespace lueur {

namespace {

// Equal energy over the range that one unit of RGB white is spread over (wavelengths.h).
const Spectrum flat_spectrum{{380, 780}, {1, 1}};

Spectrum spectrum_of_lines(const std::vector<SpectralLine>& lines) {
    Spectrum all;
    for (const SpectralLine& line : lines) {
        const double height = line.power / line.width;
        all = sum(all, Spectrum{{line.nm - line.width / 2, line.nm + line.width / 2}, {height, height}});
    }
    return all;
}

// Scaled to give that many lumens; no light when it has none.
Spectrum of_flux(const SimpleEmission& emission, double lumens) {
    const Spectrum spectrum = spectrum_of(emission);
    const double own = xyz_from_spectrum(spectrum).y;
    return scaled(spectrum, own > 0 ? lumens / own : 0);
}

std::string out_of_range(std::string_view what, double value, std::string_view allowed) {
    return fmt::format("{} is {}; {} is allowed", what, value, allowed);
}

constexpr double largest_value = 1e12; // far from overflow in every sum

void check_samples(std::vector<std::string>& faults, const Spectrum& spectrum, double highest, std::string_view what,
                   std::string_view allowed) {
    if (const auto made = make_spectrum(spectrum.nm, spectrum.value); !made) {
        if (spectrum.nm.empty())
            faults.push_back(fmt::format("{} has no samples; two or more are allowed", what));
        else
            faults.push_back(fmt::format("{}: {}", what, made.error()));
        return;
    }
    const auto bad = std::ranges::find_if_not(spectrum.value, [&](double v) { return v >= 0 && v <= highest; });
    if (bad == spectrum.value.end()) return;
    const double nm = spectrum.nm[static_cast<std::size_t>(bad - spectrum.value.begin())];
    // A file of a spectrophotometer often counts in percent.
    const double most = *std::ranges::max_element(spectrum.value);
    const bool percent = highest == 1 && most > 2 && most <= 120 && *std::ranges::min_element(spectrum.value) >= 0;
    faults.push_back(fmt::format("{} is {} at {} nm; {} is allowed{}", what, *bad, nm, allowed,
                                 percent ? " (percent? divide by 100)" : ""));
}

void check_light(std::vector<std::string>& faults, const Spectrum& spectrum) {
    check_samples(faults, spectrum, largest_value, "spectrum", "0..1e12");
}

void check_kelvin(std::vector<std::string>& faults, double kelvin, double lowest, std::string_view what,
                  std::string_view allowed) {
    if (!(kelvin >= lowest && kelvin <= 25000)) faults.push_back(out_of_range(what, kelvin, allowed));
}

void check_lines(std::vector<std::string>& faults, const std::vector<SpectralLine>& lines) {
    if (lines.empty()) faults.emplace_back("spectrum has no lines; one or more are allowed");
    bool any = false;
    for (const SpectralLine& line : lines) {
        if (!(line.nm >= 1 && line.nm <= 1e6))
            faults.push_back(out_of_range("wavelength of a line", line.nm, "1..1e6 nm"));
        if (!(line.width >= 1e-3 && line.width <= 1000 && line.width < 2 * line.nm))
            faults.push_back(out_of_range("width of a line", line.width, "0.001..1000 nm"));
        if (!(line.power >= 0 && line.power <= largest_value))
            faults.push_back(out_of_range("power of a line", line.power, "0..1e12"));
        any = any || line.power > 0;
    }
    if (!any && !lines.empty()) faults.emplace_back("no line has power; more than 0 is allowed");
}

struct FaultsOfLight {
    std::vector<std::string>& faults;

    void operator()(const Flat&) const {}
    void operator()(const Rgb& rgb) const {
        for (int k = 0; k < 3; ++k)
            if (!(rgb[k] >= 0 && rgb[k] <= largest_value))
                faults.push_back(out_of_range("spectrum", rgb[k], "0..1e12"));
    }
    void operator()(const SpectrumFile& file) const { check_light(faults, file.spectrum); }
    void operator()(const LibrarySpectrum& library) const { check_light(faults, library.spectrum); }
    void operator()(const Drawn& drawn) const { check_light(faults, drawn.spectrum); }
    void operator()(const Blackbody& body) const {
        check_kelvin(faults, body.kelvin, 1000, "blackbody", "1000..25000 K");
    }
    void operator()(const Daylight& day) const {
        check_kelvin(faults, day.kelvin, least_daylight_temperature, "daylight", "4000..25000 K");
    }
    void operator()(const Lines& lines) const { check_lines(faults, lines.lines); }
    void operator()(const Mix& mix) const {
        if (!(mix.share >= 0 && mix.share <= 1)) faults.push_back(out_of_range("share", mix.share, "0..1"));
        const std::size_t before = faults.size();
        for (const SimpleEmission& light : mix.lights) std::visit(*this, light);
        if (faults.size() != before) return;
        for (const SimpleEmission& light : mix.lights)
            if (!(xyz_from_spectrum(spectrum_of(light)).y > 0)) {
                faults.emplace_back("a light of the mixture gives no lumens; lights that can be seen are allowed");
                return;
            }
    }
};

} // namespace

Spectrum spectrum_of(const SimpleEmission& emission) {
    return std::visit(Overload{[](const Flat&) { return flat_spectrum; },
                               [](const SpectrumFile& file) { return piecewise_linear(file.spectrum); },
                               [](const LibrarySpectrum& library) { return piecewise_linear(library.spectrum); },
                               [](const Blackbody& body) { return blackbody(body.kelvin); },
                               [](const Daylight& day) { return daylight(day.kelvin); },
                               [](const Lines& lines) { return spectrum_of_lines(lines.lines); },
                               [](const Drawn& drawn) { return piecewise_linear(drawn.spectrum); }},
                      emission);
}

std::optional<Spectrum> spectrum_of(const EmissionSpectrum& emission) {
    if (const Mix* mix = std::get_if<Mix>(&emission))
        return sum(of_flux(mix->lights[0], 1 - mix->share), of_flux(mix->lights[1], mix->share));
    const std::optional<SimpleEmission> simple = simple_emission(emission);
    return simple ? std::optional(spectrum_of(*simple)) : std::nullopt;
}

Spectrum spectrum_of(const Reflectance& reflectance) {
    return std::visit(Overload{[](double grey) { return scaled(flat_spectrum, grey); },
                               [](const Rgb& rgb) { return reflectance_from_rgb(glm::clamp(rgb, 0.0, 1.0)); },
                               [](const SpectrumFile& file) { return piecewise_linear(file.spectrum); },
                               [](const LibrarySpectrum& library) { return piecewise_linear(library.spectrum); },
                               [](const Drawn& drawn) { return piecewise_linear(drawn.spectrum); }},
                      reflectance);
}

std::optional<SimpleEmission> simple_emission(const EmissionSpectrum& emission) {
    return std::visit(Overload{[](const Rgb&) { return std::optional<SimpleEmission>(); },
                               [](const Mix&) { return std::optional<SimpleEmission>(); },
                               [](const auto& simple) { return std::optional<SimpleEmission>(simple); }},
                      emission);
}

EmissionSpectrum emission(const SimpleEmission& simple) {
    return std::visit([](const auto& one) { return EmissionSpectrum(one); }, simple);
}

std::vector<std::string> faults_of(const EmissionSpectrum& emission) {
    std::vector<std::string> faults;
    std::visit(FaultsOfLight{faults}, emission);
    return faults;
}

std::vector<std::string> faults_of(const Reflectance& reflectance) {
    std::vector<std::string> faults;
    const auto in_range = [&](double value) {
        if (!(value >= 0 && value <= 1)) faults.push_back(out_of_range("reflectance", value, "0..1"));
    };
    const auto curve = [&](const Spectrum& spectrum) { check_samples(faults, spectrum, 1, "reflectance", "0..1"); };
    std::visit(Overload{[&](double grey) { in_range(grey); },
                        [&](const Rgb& rgb) {
                            for (int k = 0; k < 3; ++k) in_range(rgb[k]);
                        },
                        [&](const SpectrumFile& file) { curve(file.spectrum); },
                        [&](const LibrarySpectrum& library) { curve(library.spectrum); },
                        [&](const Drawn& drawn) { curve(drawn.spectrum); }},
               reflectance);
    return faults;
}

} // namespace lueur
