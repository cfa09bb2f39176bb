#include "core/view/spectral_picture.h"

#include <numbers>

#include <tbb/parallel_for.h>

#include "core/scene/luminaire.h"
#include "core/scene/spectral_content.h"

namespace lueur {

namespace {

// What radiance in channels is made of, of every material and luminaire.
struct Channels {
    std::vector<std::vector<double>> rho, exitance;
    std::vector<std::array<std::vector<double>, 3>> by_texel;
    std::vector<std::optional<LuminaireIndex>> luminaire_of_object;

    Channels(const Scene& scene, const Wavelengths& wavelengths)
        : luminaire_of_object(luminaire_of_objects(scene)) {
        for (const Material& material : scene.materials) {
            rho.push_back(reflectance_channels(material, wavelengths));
            by_texel.push_back(texel_channels(material, wavelengths));
        }
        for (const Luminaire& luminaire : scene.luminaires)
            exitance.push_back(exitance_channels(scene, luminaire, wavelengths));
    }

    std::vector<double> radiance(const Scene& scene, const Field& field, const FieldPoint& point) const {
        const ObjectIndex object = scene.geometry->surfaces[point.surface].object;
        const std::size_t material = at(scene.objects[at(object)].material);
        std::vector<double> channels = irradiance_channels(field, point);
        for (std::size_t k = 0; k < channels.size(); ++k) {
            double reflectance = rho[material][k];
            if (point.texel) {
                reflectance = 0;
                for (int c = 0; c < 3; ++c)
                    reflectance += double((*point.texel)[c]) * by_texel[material][static_cast<std::size_t>(c)][k];
            }
            channels[k] *= reflectance / std::numbers::pi;
        }
        const auto luminaire = luminaire_of_object[at(object)];
        if (luminaire && point.emitted.y > 0)
            for (std::size_t k = 0; k < channels.size(); ++k)
                channels[k] += exitance[at(*luminaire)][k] / std::numbers::pi;
        return channels;
    }
};

// The mean over each plane's 10 nm of what one unit in each channel is: spectra are linear in the channels.
std::vector<std::vector<double>> planes_of_channels(const Wavelengths& wavelengths, const std::vector<double>& nm) {
    std::vector<std::vector<double>> planes(nm.size());
    for (int k = 0; k < wavelengths.size(); ++k) {
        std::vector<double> unit(static_cast<std::size_t>(wavelengths.size()), 0.0);
        unit[static_cast<std::size_t>(k)] = 1;
        const Spectrum spectrum = spectrum_from_channels(wavelengths, unit);
        for (std::size_t plane = 0; plane < nm.size(); ++plane) {
            const double from = std::max(nm[plane] - spectral_picture_step_nm / 2, spectral_picture_first_nm),
                         to = std::min(nm[plane] + spectral_picture_step_nm / 2, spectral_picture_last_nm);
            planes[plane].push_back(integral(spectrum, from, to, Outside::zero) / (to - from));
        }
    }
    return planes;
}

} // namespace

SpectralImage render_spectral_picture(const FieldView& view, const Camera& camera, const PictureParams& params,
                                      const std::atomic<bool>& cancel, const std::function<void(double)>& progress) {
    SpectralImage image{params.width, params.height, {}, {}};
    if (!view.field || !view.field->wavelengths || view.field->irradiance.count == 0 ||
        view.field->wavelengths->spec.rule == WavelengthRule::rgb)
        return {};
    for (double nm = spectral_picture_first_nm; nm <= spectral_picture_last_nm; nm += spectral_picture_step_nm)
        image.nm.push_back(nm);
    const std::size_t pixels = std::size_t(params.width) * static_cast<std::size_t>(params.height);
    image.planes.assign(image.nm.size(), std::vector<float>(pixels, 0.0f));
    const Channels channels(*view.scene, *view.field->wavelengths);
    const auto planes = planes_of_channels(*view.field->wavelengths, image.nm);
    const double aspect = double(params.width) / params.height;
    const int n = std::max(1, params.samples_per_axis);
    constexpr int rows_at_once = 16;
    for (int first = 0; first < params.height; first += rows_at_once) {
        if (cancel.load(std::memory_order_relaxed)) return {};
        const int end = std::min(first + rows_at_once, params.height);
        tbb::parallel_for(first, end, [&](int y) {
            for (int x = 0; x < params.width; ++x) {
                std::vector<double> sum(static_cast<std::size_t>(view.field->wavelengths->size()), 0.0);
                for (int s = 0; s < n * n; ++s) {
                    const double u = (x + (s % n + 0.5) / n) / params.width,
                                 v = (y + (s / n + 0.5) / n) / params.height;
                    const auto point = field_along_ray(view, camera_ray(camera, aspect, u, v));
                    if (!point) continue;
                    const std::vector<double> radiance = channels.radiance(*view.scene, *view.field, *point);
                    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += radiance[k] / (n * n);
                }
                const std::size_t pixel =
                    std::size_t(y) * static_cast<std::size_t>(params.width) + static_cast<std::size_t>(x);
                for (std::size_t plane = 0; plane < planes.size(); ++plane) {
                    double value = 0;
                    for (std::size_t k = 0; k < sum.size(); ++k) value += planes[plane][k] * sum[k];
                    image.planes[plane][pixel] = static_cast<float>(std::max(value, 0.0));
                }
            }
        });
        if (progress) progress(double(end) / params.height);
    }
    return image;
}

} // namespace lueur
