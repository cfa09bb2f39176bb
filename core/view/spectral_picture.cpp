#include "core/view/spectral_picture.h"

#include <algorithm>

#include "core/view/pixel_loop.h"
#include "core/view/radiance_channels.h"

namespace lueur {

namespace {

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
    const RadianceChannels radiance(*view.scene, *view.field->wavelengths);
    const auto planes = planes_of_channels(*view.field->wavelengths, image.nm);
    const int samples = params.samples_per_axis * params.samples_per_axis;
    if (!for_each_pixel(params, cancel, progress, [&](int x, int y) {
            std::vector<double> sum(static_cast<std::size_t>(view.field->wavelengths->size()), 0.0);
            for_each_sample(view, camera, params, x, y, [&](const FieldPoint& point) {
                const std::vector<double> channels = radiance.at(*view.scene, *view.field, point);
                for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += channels[k] / samples;
            });
            const std::size_t pixel =
                std::size_t(y) * static_cast<std::size_t>(params.width) + static_cast<std::size_t>(x);
            for (std::size_t plane = 0; plane < planes.size(); ++plane) {
                double value = 0;
                for (std::size_t k = 0; k < sum.size(); ++k) value += planes[plane][k] * sum[k];
                image.planes[plane][pixel] = static_cast<float>(std::max(value, 0.0));
            }
        }))
        return {};
    return image;
}

} // namespace lueur
