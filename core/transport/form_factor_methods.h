// The methods of form_factor.h one by one, on a pair that is cut to what faces each other. Of use to form_factor.cpp
// and tests only.
#pragma once

#include "core/transport/form_factor.h"

namespace lueur {

inline constexpr std::size_t most_exact_occluders = 32; // behind more, analytic takes rays

struct PolygonPair {
    PlanarPolygon from, to; // what of each lies in front of the plane of the other; area 0: nothing
    double share = 0;       // of the whole area of `from`
    Occluders occluders;    // what can stand between
    bool faces() const { return from.area > 0 && to.area > 0; }
    bool may_be_occluded() const { return occluders.world || !occluders.polygons.empty(); }
};
PolygonPair facing_pair(const PlanarPolygon& from, const PlanarPolygon& to, const Occluders& occluders);

bool is_visible(const PolygonPair& pair, glm::dvec3 on_from, glm::dvec3 on_to);

struct MethodEstimate { // of F from the facing part of `from`
    double value = 0;
    double error = -1; // standard error or bound; below 0: none
    std::uint64_t cost = 0;
};
// The settings are complete: no 0.
MethodEstimate analytic(const PolygonPair& pair, const FormFactorSettings& settings);
MethodEstimate point_to_disk(const PolygonPair& pair, const FormFactorSettings& settings);
MethodEstimate area_sampled(const PolygonPair& pair, const FormFactorSettings& settings);
MethodEstimate monte_carlo(const PolygonPair& pair, const FormFactorSettings& settings);
MethodEstimate hemicube(const PolygonPair& pair, const FormFactorSettings& settings);
MethodEstimate hemisphere(const PolygonPair& pair, const FormFactorSettings& settings);

FormFactorSettings complete(FormFactorMethod method, FormFactorSettings settings);

// Why the method is outside its region for this pair, with the measured limits of the README's table; empty: it is
// inside. Complete settings.
std::string region_warning(const PolygonPair& pair, FormFactorMethod method, const FormFactorSettings& settings);

// Whether `to` is too small for the pixels of an item buffer at the middle of `from`.
bool is_below_pixels(const PlanarPolygon& from, const PlanarPolygon& to, FormFactorMethod method, int resolution);

// Numbers in [0, 1) for one seed and index, the same everywhere (splitmix64: Steele, Lea & Flood 2014).
class RandomStream {
public:
    RandomStream(std::uint64_t seed, std::uint64_t index)
        : state_(seed * 0x9e3779b97f4a7c15ull ^ (index + 1) * 0xd1b54a32d192ed03ull) {
        next();
    }
    double next() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15ull;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    glm::dvec2 next2() {
        const double x = next();
        return {x, next()};
    }

private:
    std::uint64_t state_;
};

// Point n of Roberts' additive recurrence in the unit square (2018).
inline glm::dvec2 spread_point(std::uint64_t n, glm::dvec2 offset) {
    const glm::dvec2 p = offset + glm::dvec2(0.7548776662466927, 0.5698402909980532) * (static_cast<double>(n) + 0.5);
    return p - glm::floor(p);
}

// Axes around a unit normal (Duff et al. 2017), turned about it by an angle.
struct Axes {
    glm::dvec3 x, y, z;
    Axes(glm::dvec3 normal, double turn)
        : z(normal) {
        const double sign = std::copysign(1.0, z.z), a = -1 / (sign + z.z), b = z.x * z.y * a;
        const glm::dvec3 u(1 + sign * z.x * z.x * a, sign * b, -sign * z.x), v(b, sign + z.y * z.y * a, -z.y);
        x = std::cos(turn) * u + std::sin(turn) * v;
        y = std::cos(turn) * v - std::sin(turn) * u;
    }
};

} // namespace lueur
