// Irradiance at points of a solved scene.
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <vector>

#include "core/solve/solution.h"

namespace lueur {

struct MeasurePoint {
    glm::dvec3 position, normal; // m, unit
};

struct Irradiance {
    std::vector<double> channels; // W m^-2 nm^-1, or the scene's emission unit in rgb
    double illuminance_lx = 0;
    double irradiance_w_m2 = 0;
    double standard_error_percent = 0; // of the illuminance: from independent ray sets; of the field its estimate
};

enum class MeasureAt {
    gather,    // direct light and a hemisphere of rays from the point itself, which read the field
    field,     // the field as the window shows it, interpolated
    reference, // paths traced from the point; unbiased
};

struct MeasureParams {
    MeasureAt at = MeasureAt::gather;
    int rays = 1024; // hemisphere rays (gather) or paths (reference) a point
    std::uint32_t seed = 1;
    bool standard_errors = true; // false: those of the field, which cost a look at all of it, are left 0
};

// `field`: a point further than 1 mm * scene scale from any surface, or facing away from it, gives NaN.
// Cancelled: an empty vector.
std::vector<Irradiance> measure_points(const Solution& solution, std::span<const MeasurePoint> points,
                                       const MeasureParams& params, const std::atomic<bool>& cancel,
                                       const std::function<void(double)>& progress = {});

} // namespace lueur
