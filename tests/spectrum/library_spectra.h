// Lights and paints of the library, and colours by integration at 1 nm that owe nothing to the code under test.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "core/spectrum/colour_difference.h"
#include "core/spectrum/observer.h"
#include "core/spectrum/spectral_content.h"
#include "core/spectrum/spectrum_library.h"
#include "tests/support/source_folder.h"

namespace lueur {

inline const SpectrumLibrary& spectrum_library() {
    static const SpectrumLibrary library = list_spectrum_library(test::source_folder() / "assets/spectra").value();
    return library;
}

struct NamedSpectrum {
    std::string name;
    Spectrum spectrum;
};

inline std::vector<NamedSpectrum> library_lights() {
    std::vector<NamedSpectrum> lights;
    for (const LibraryEntry& entry : spectrum_library().entries)
        if (spectrum_library().groups[entry.group].kind == LibraryKind::light)
            lights.push_back({entry.name, read_library_spectrum(spectrum_library(), entry).value()});
    return lights;
}

inline Spectrum library_light(const std::string& name) {
    const LibraryEntry* entry = find_entry(spectrum_library(), LibraryKind::light, name);
    if (!entry) throw std::out_of_range(name);
    return read_library_spectrum(spectrum_library(), *entry).value();
}

inline std::vector<Spectrum> library_paints(const std::string& group) {
    std::vector<Spectrum> paints;
    for (const LibraryEntry& entry : spectrum_library().entries)
        if (const LibraryGroup& of = spectrum_library().groups[entry.group];
            of.name == group && of.kind == LibraryKind::reflectance)
            paints.push_back(read_library_spectrum(spectrum_library(), entry).value());
    return paints;
}

inline const std::vector<Spectrum>& colour_checker() {
    static const std::vector<Spectrum> paints = library_paints("ColorChecker");
    return paints;
}

// A source of 1 W in one line 1 nm wide.
inline Spectrum laser(double nm) {
    return {{nm - 1, nm, nm + 1}, {0, 1, 0}};
}

// Values at 360, 361 ... 830 nm.
inline std::vector<double> each_nanometre(const Spectrum& spectrum, Outside outside) {
    std::vector<double> values;
    for (int nm = 360; nm <= 830; ++nm) values.push_back(value_at(spectrum, nm, outside));
    return values;
}

inline std::vector<double> times(std::vector<double> a, const std::vector<double>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] *= b[i];
    return a;
}

// Km * sum at 1 nm of values at each nanometre times the observer.
inline Xyz summed_xyz(const std::vector<double>& values) {
    Xyz sum(0);
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * observer_xyz(360 + static_cast<int>(i));
    return luminous_efficacy_km * sum;
}

// One light on products of paints, by sums at 1 nm and in channels; lamps keep their luminous flux in both.
class LightOnPaints {
public:
    LightOnPaints(const Wavelengths& wavelengths, const Spectrum& light)
        : wavelengths_(wavelengths)
        , fine_(each_nanometre(light, Outside::zero))
        , channels_(emission_channels(wavelengths, light))
        , white_(summed_xyz(fine_)) {
        const double y = xyz_from_channels(wavelengths, channels_).y;
        for (double& channel : channels_) channel *= white_.y / y;
    }
    struct Paint {
        std::vector<double> fine, channels;
    };
    Paint paint(const Spectrum& reflectance) const {
        return {each_nanometre(reflectance, Outside::constant), reflectance_channels(wavelengths_, reflectance)};
    }
    double difference(const std::vector<const Paint*>& product) const {
        std::vector<double> fine = fine_, channels = channels_;
        for (const Paint* paint : product) fine = times(fine, paint->fine), channels = times(channels, paint->channels);
        const Xyz white = glm::max(white_, Xyz(1e-3 * white_.y)); // a line may have no Z
        const Xyz seen = xyz_from_channels(wavelengths_, std::span<const double>(channels));
        return delta_e_2000(lab_from_xyz(summed_xyz(fine), white), lab_from_xyz(seen, white));
    }

private:
    const Wavelengths& wavelengths_;
    std::vector<double> fine_, channels_;
    Xyz white_;
};

struct Differences {
    double mean = 0, worst = 0;
    int count = 0;
    void add(double difference) {
        mean += (difference - mean) / ++count;
        if (difference > worst) worst = difference;
    }
};

// Over single paints, or over every `stride`-th of their products of three.
inline Differences true_differences(const Wavelengths& wavelengths, const Spectrum& light,
                                    const std::vector<Spectrum>& paints, std::size_t three_bounces_stride = 0) {
    const LightOnPaints lit(wavelengths, light);
    std::vector<LightOnPaints::Paint> on;
    for (const Spectrum& paint : paints) on.push_back(lit.paint(paint));
    Differences differences;
    if (three_bounces_stride == 0) {
        for (const auto& paint : on) differences.add(lit.difference({&paint}));
        return differences;
    }
    std::size_t number = 0;
    for (std::size_t a = 0; a < on.size(); ++a)
        for (std::size_t b = a; b < on.size(); ++b)
            for (std::size_t c = b; c < on.size(); ++c)
                if (number++ % three_bounces_stride == 0) differences.add(lit.difference({&on[a], &on[b], &on[c]}));
    return differences;
}

} // namespace lueur
