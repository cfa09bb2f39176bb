// The directions of a hemisphere's rays and the form factor of each.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/transport/form_factor_methods.h"

namespace lueur {

struct HemisphereRay {
    glm::dvec3 direction; // unit, about z
    double delta;         // form factor; all of a hemisphere sum to 1
};

class HemisphereRays {
public:
    // About resolution^2 rays. theta_phi: the lecture's cells, half as many rings as the resolution, each ring cut into
    // twice as many; `offset` is of the equal ones, the points of an additive recurrence.
    HemisphereRays(int resolution, HemisphereCells cells, glm::dvec2 offset)
        : rings_(std::max(1, resolution / 2))
        , sectors_(std::max(1, 2 * resolution))
        , cells_(cells)
        , offset_(offset)
        , count_(cells == HemisphereCells::theta_phi
                     ? static_cast<std::uint32_t>(rings_) * static_cast<std::uint32_t>(sectors_)
                     : static_cast<std::uint32_t>(resolution) * static_cast<std::uint32_t>(resolution)) {}

    std::uint32_t count() const { return count_; }

    HemisphereRay ray(std::uint32_t n) const {
        const double two_pi = 2 * std::numbers::pi;
        switch (cells_) {
        case HemisphereCells::theta_phi: {
            const auto ring = static_cast<int>(n) / sectors_, sector = static_cast<int>(n) % sectors_;
            const double step = std::numbers::pi / 2 / rings_, theta = (ring + 0.5) * step,
                         phi = (sector + 0.5) * two_pi / sectors_;
            // The cell's own, (sin^2 theta_2 - sin^2 theta_1) dphi / 2 pi: cos sin dtheta dphi / pi at its middle, as
            // the lecture has it, sums to step / sin(step) > 1.
            const double low = std::sin(ring * step), high = std::sin((ring + 1) * step);
            return {direction(theta, phi), (high * high - low * low) / sectors_};
        }
        case HemisphereCells::equal: {
            const glm::dvec2 u = spread_point(n, offset_);
            return {direction(std::asin(std::sqrt(u.x)), two_pi * u.y), 1.0 / count_};
        }
        }
        return {};
    }

private:
    static glm::dvec3 direction(double theta, double phi) {
        return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    }

    int rings_, sectors_;
    HemisphereCells cells_;
    glm::dvec2 offset_;
    std::uint32_t count_;
};

} // namespace lueur
