// The solution as it is shown: XYZ at the vertices of the fine mesh.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "core/solve/channel_field.h"

namespace lueur {

// What a surface shows, one value a mesh vertex, cd m^-2 in Y.
struct Shades {
    std::vector<glm::vec3> reflected_xyz; // rho * irradiance / pi; with a texture that of the mean texel
    std::vector<glm::vec3> emitted_xyz;
    // Times a texel (linear RGB): what a textured point reflects, exactly at every wavelength. Empty in a scene without
    // textures, 0 at vertices of materials without one.
    std::vector<glm::mat3> reflected_by_texel;
};

struct Field : Shades {
    std::vector<glm::vec3> irradiance_xyz; // lx in Y
    std::vector<float> unshot;             // unshot (or residual) luminous exitance, lm m^-2
    // How wrong the illuminance may be (error_estimate.h), lx, one standard deviation: at the vertices, and what
    // interpolation adds between them. The interval in which 95 % of the true values lie is interval_factor of it to
    // both sides.
    std::vector<float> error, interpolation_error;
    // Both together in per cent of the illuminance (of 2 % of the mean where it is darker): the map.
    std::vector<float> relative_error;
    double interval_factor = 1.96;
    double scene_error = 1; // relative RMS over the surfaces, those darker than 2 % of the mean left out
    // The lecture's trichromatic approach beside it, when it was asked for; and how far apart the two are: CIEDE2000,
    // white being what a white surface reflects of the same light.
    std::optional<Shades> trichromatic;
    std::vector<float> colour_difference;
    // Irradiance in channels, for the spectrum at a point. Empty above largest_channel_field numbers.
    ChannelField irradiance;
    std::shared_ptr<const Wavelengths> wavelengths;
};

inline constexpr std::size_t largest_channel_field = 12'000'000; // numbers: 48 MB

} // namespace lueur
