#include "core/spectrum/spectrum.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/spectrum/quadrature.h"

namespace lueur {

std::expected<Spectrum, std::string> make_spectrum(std::vector<double> nm, std::vector<double> value) {
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
    return Spectrum{std::move(nm), std::move(value)};
}

double value_at(const Spectrum& spectrum, double nm, Outside outside) {
    if (spectrum.nm.empty()) return 0;
    if (nm < spectrum.nm.front()) return outside == Outside::zero ? 0 : spectrum.value.front();
    if (nm > spectrum.nm.back()) return outside == Outside::zero ? 0 : spectrum.value.back();
    const auto above = std::upper_bound(spectrum.nm.begin(), spectrum.nm.end(), nm);
    if (above == spectrum.nm.end()) return spectrum.value.back();
    const auto i = static_cast<std::size_t>(above - spectrum.nm.begin()); // >= 1, since nm >= front
    return std::lerp(spectrum.value[i - 1], spectrum.value[i],
                     (nm - spectrum.nm[i - 1]) / (spectrum.nm[i] - spectrum.nm[i - 1]));
}

double integral(const Spectrum& spectrum, double from_nm, double to_nm, Outside outside) {
    if (to_nm < from_nm) return -integral(spectrum, to_nm, from_nm, outside);
    if (spectrum.nm.empty()) return 0;
    if (outside == Outside::zero) { // the jump to zero at the ends of the grid must not fall inside an interval
        from_nm = std::max(from_nm, spectrum.nm.front());
        to_nm = std::min(to_nm, spectrum.nm.back());
    }
    return integrate<double>(breakpoints(from_nm, to_nm, {spectrum.nm}),
                             [&](double nm) { return value_at(spectrum, nm, outside); });
}

} // namespace lueur
