#include "core/transport/polygon_form_factor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lueur {

double polygon_form_factor(glm::dvec3 point, glm::dvec3 normal, std::span<const glm::dvec3> polygon) {
    std::array<glm::dvec3, 32> v;
    std::array<double, 32> height;
    const std::size_t n = std::min<std::size_t>(polygon.size(), 30);
    bool above = true;
    for (std::size_t k = 0; k < n; ++k) {
        v[k] = polygon[k] - point;
        height[k] = glm::dot(v[k], normal);
        above = above && height[k] >= 0;
    }
    std::size_t count = n;
    std::array<glm::dvec3, 32> cut;
    if (!above) { // Sutherland & Hodgman 1974 against the horizon
        count = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t next = (k + 1) % n;
            if (height[k] >= 0) cut[count++] = v[k];
            if ((height[k] >= 0) != (height[next] >= 0))
                cut[count++] = v[k] + (height[k] / (height[k] - height[next])) * (v[next] - v[k]);
        }
        if (count < 3) return 0;
    } else {
        std::copy_n(v.begin(), n, cut.begin());
    }
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const glm::dvec3 c = glm::cross(cut[k], cut[(k + 1) % count]);
        const double sine = glm::length(c);
        if (sine <= 0) continue; // the point lies on the line of this edge, which then subtends nothing towards n
        sum += std::atan2(sine, glm::dot(cut[k], cut[(k + 1) % count])) * glm::dot(c, normal) / sine;
    }
    // Seen from the front a counter-clockwise polygon runs clockwise around the direction towards it.
    return std::max(0.0, -sum / (2 * std::numbers::pi));
}

} // namespace lueur
