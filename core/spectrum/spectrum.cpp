#include "core/spectrum/spectrum.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

#include "core/spectrum/quadrature.h"

namespace lueur {

namespace {

double outside_value(const Spectrum& spectrum, double nm, Outside outside) {
    switch (outside) {
    case Outside::zero:
        return 0;
    case Outside::constant:
        return nm < spectrum.nm.front() ? spectrum.value.front() : spectrum.value.back();
    }
    return 0;
}

} // namespace

std::expected<Spectrum, std::string> make_spectrum(std::vector<double> nm, std::vector<double> value,
                                                   Interpolation interpolation) {
    if (nm.size() != value.size())
        return std::unexpected(
            fmt::format("{} wavelengths but {} values; allowed: one value a wavelength", nm.size(), value.size()));
    if (nm.size() < 2) return std::unexpected(fmt::format("{} samples; allowed: two or more", nm.size()));
    for (std::size_t i = 0; i < nm.size(); ++i) {
        if (!std::isfinite(nm[i]) || nm[i] <= 0)
            return std::unexpected(
                fmt::format("sample {}: wavelength {}; allowed: a finite number of nm above 0", i + 1, nm[i]));
        if (!std::isfinite(value[i]))
            return std::unexpected(
                fmt::format("sample {}: value {} at {} nm; allowed: a finite number", i + 1, value[i], nm[i]));
        if (i > 0 && nm[i] <= nm[i - 1])
            return std::unexpected(
                fmt::format("sample {}: wavelength {} {} {}; allowed: wavelengths that increase from sample to sample",
                            i + 1, nm[i], nm[i] == nm[i - 1] ? "repeats" : "follows", nm[i - 1]));
    }
    return Spectrum{std::move(nm), std::move(value), interpolation};
}

double first_nm(const Spectrum& spectrum) {
    const auto& nm = spectrum.nm;
    if (nm.empty()) return 0;
    if (spectrum.interpolation == Interpolation::linear || nm.size() == 1) return nm.front();
    return nm.front() - (nm[1] - nm[0]) / 2;
}

double last_nm(const Spectrum& spectrum) {
    const auto& nm = spectrum.nm;
    if (nm.empty()) return 0;
    if (spectrum.interpolation == Interpolation::linear || nm.size() == 1) return nm.back();
    return nm.back() + (nm.back() - nm[nm.size() - 2]) / 2;
}

std::vector<double> grid(const Spectrum& spectrum) {
    switch (spectrum.interpolation) {
    case Interpolation::linear:
        return spectrum.nm;
    case Interpolation::bin: {
        if (spectrum.nm.empty()) return {};
        std::vector<double> edges{first_nm(spectrum)};
        for (std::size_t i = 1; i < spectrum.nm.size(); ++i)
            edges.push_back(std::midpoint(spectrum.nm[i - 1], spectrum.nm[i]));
        edges.push_back(last_nm(spectrum));
        return edges;
    }
    }
    return {};
}

double value_at(const Spectrum& spectrum, double nm, Outside outside) {
    if (spectrum.nm.empty()) return 0;
    if (nm < first_nm(spectrum) || nm > last_nm(spectrum)) return outside_value(spectrum, nm, outside);
    const auto above = std::upper_bound(spectrum.nm.begin(), spectrum.nm.end(), nm);
    if (above == spectrum.nm.end()) return spectrum.value.back();
    if (above == spectrum.nm.begin()) return spectrum.value.front(); // the lower half of the first bin
    const auto i = static_cast<std::size_t>(above - spectrum.nm.begin());
    switch (spectrum.interpolation) {
    case Interpolation::linear:
        return std::lerp(spectrum.value[i - 1], spectrum.value[i],
                         (nm - spectrum.nm[i - 1]) / (spectrum.nm[i] - spectrum.nm[i - 1]));
    case Interpolation::bin:
        return spectrum.value[nm < std::midpoint(spectrum.nm[i - 1], spectrum.nm[i]) ? i - 1 : i];
    }
    return 0;
}

double integral(const Spectrum& spectrum, double from_nm, double to_nm, Outside outside) {
    if (to_nm < from_nm) return -integral(spectrum, to_nm, from_nm, outside);
    if (spectrum.nm.empty()) return 0;
    return integrate<double>(breakpoints(from_nm, to_nm, {grid(spectrum)}),
                             [&](double nm) { return value_at(spectrum, nm, outside); });
}

} // namespace lueur
