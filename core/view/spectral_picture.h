// A picture of a field, wavelength by wavelength.
#pragma once

#include "core/display/image_file.h"
#include "core/view/picture.h"

namespace lueur {

inline constexpr double spectral_picture_first_nm = 380, spectral_picture_last_nm = 780, spectral_picture_step_nm = 10;

// Spectral radiance in W m^-2 sr^-1 nm^-1 at 41 wavelengths, each the mean of 10 nm, so that lines keep their power.
// Progress as render_picture. Cancelled, or a field without channels (rgb wavelengths, or too large to keep them): an
// empty picture.
SpectralImage render_spectral_picture(const FieldView& view, const Camera& camera, const PictureParams& params,
                                      const std::atomic<bool>& cancel,
                                      const std::function<void(double)>& progress = {});

} // namespace lueur
