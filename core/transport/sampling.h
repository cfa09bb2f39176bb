// Quasi-random points and where they go: on a hemisphere, on a triangle.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

namespace lueur {

// The additive recurrence of the plastic number (Roberts 2018, "R2"): n points of any prefix are well spread in the
// unit square.
inline glm::vec2 r2_point(std::uint32_t n, glm::vec2 offset) {
    const double x = double(offset.x) + 0.7548776662466927 * (n + 0.5),
                 y = double(offset.y) + 0.5698402909980532 * (n + 0.5);
    return {static_cast<float>(x - static_cast<double>(static_cast<std::int64_t>(x))),
            static_cast<float>(y - static_cast<double>(static_cast<std::int64_t>(y)))}; // they are positive
}

// A well mixed hash (Jarzynski & Olano 2020, pcg).
inline std::uint32_t hash(std::uint32_t x) {
    const std::uint32_t state = x * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}
inline std::uint32_t hash(std::uint32_t a, std::uint32_t b) {
    return hash(a ^ (hash(b) + 0x9e3779b9u));
}
inline float unit_float(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
} // [0, 1)
inline glm::vec2 random_offset(std::uint32_t seed, std::uint32_t index) {
    const std::uint32_t a = hash(seed, index);
    return {unit_float(a), unit_float(hash(a))};
}

// Frame around a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
struct Frame {
    glm::vec3 x, y, z;
    explicit Frame(glm::vec3 normal)
        : z(normal) {
        const float sign = std::copysign(1.0f, z.z);
        const float a = -1.0f / (sign + z.z), b = z.x * z.y * a;
        x = {1 + sign * z.x * z.x * a, sign * b, -sign * z.x};
        y = {b, sign + z.y * z.y * a, -z.y};
    }
    glm::vec3 world(glm::vec3 v) const { return v.x * x + v.y * y + v.z * z; }
};

// Cosine-distributed direction about z: density cos(theta) / pi (Malley's method on Shirley & Chiu's concentric disk,
// 1997).
inline glm::vec3 cosine_direction(glm::vec2 u) {
    const float a = 2 * u.x - 1, b = 2 * u.y - 1;
    const bool along_x = std::abs(a) > std::abs(b);
    const float radius = along_x ? a : b, other = along_x ? b : a;
    if (radius == 0) return {0, 0, 1};
    // Series of sine and cosine on -pi/4..pi/4, to 3e-7 and 3e-8: no call, no branch.
    const float t = 0.78539816339744831f * (other / radius), t2 = t * t;
    const float sine = t * (1 + t2 * (-1 / 6.0f + t2 * (1 / 120.0f - t2 / 5040)));
    const float cosine = 1 + t2 * (-0.5f + t2 * (1 / 24.0f + t2 * (-1 / 720.0f + t2 / 40320)));
    const float x = radius * (along_x ? cosine : sine), y = radius * (along_x ? sine : cosine);
    return {x, y, std::sqrt(std::max(1e-8f, 1 - radius * radius))};
}

// Uniform barycentric weights of a triangle's 2nd and 3rd vertex, continuous in u (Heitz 2019, "A Low-Distortion Map
// Between Triangle and Square").
inline glm::vec2 triangle_point(glm::vec2 u) {
    if (u.y > u.x) {
        u.x *= 0.5f;
        u.y -= u.x;
    } else {
        u.y *= 0.5f;
        u.x -= u.y;
    }
    return u;
}

} // namespace lueur
