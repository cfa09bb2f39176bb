#include "core/transport/form_factor_exact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/transport/gauss_legendre.h"

namespace lueur {

namespace {

constexpr double good_enough = 1e-9; // relative: no other way is tried then

template <typename T>
using Vec = glm::vec<3, T, glm::highp>;

template <typename T>
struct Segment {
    Vec<T> start, along; // along is unit
    T length;
};

template <typename T>
std::vector<Segment<T>> edges_of(const PlanarPolygon& polygon) {
    std::vector<Segment<T>> edges;
    const std::size_t n = polygon.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec<T> a(polygon.corners[k]), b(polygon.corners[(k + 1) % n]);
        const T length = glm::length(b - a);
        if (length > 0) edges.push_back({a, (b - a) / length, length});
    }
    return edges;
}

// int ln|p - q| dq along a segment, in closed form.
template <typename T>
T log_potential(Vec<T> p, const Segment<T>& q) {
    const Vec<T> d = p - q.start;
    const T x = glm::dot(d, q.along);
    const T h2 = std::max(T(0), glm::dot(d - x * q.along, d - x * q.along)), h = std::sqrt(h2);
    const auto part = [&](T y) {
        const T r2 = y * y + h2;
        return r2 > 0 ? y * (std::log(r2) / 2 - 1) + h * std::atan2(y, h) : T(0);
    };
    return part(q.length - x) + part(x);
}

template <typename T>
struct ContourSum {
    T value = 0, magnitude = 0;
    std::uint64_t evaluations = 0;
};

// Where the potential of q along p is not smooth: complex positions along p. Panels are halved until all of them are
// outside the ellipse on which Gauss-Legendre quadrature of this order reaches the precision of T (Trefethen 2008).
template <typename T>
void add_edge_pair(const Segment<T>& p, const Segment<T>& q, ContourSum<T>& sum) {
    const T cosine = glm::dot(p.along, q.along);
    if (cosine == 0) return;
    struct Singularity {
        T at, height;
    };
    std::array<Singularity, 3> singular;
    std::size_t count = 0;
    for (const Vec<T> end : {q.start, q.start + q.length * q.along}) {
        const Vec<T> d = end - p.start;
        const T at = glm::dot(d, p.along);
        singular[count++] = {at, glm::length(d - at * p.along)};
    }
    const T sine2 = glm::dot(glm::cross(p.along, q.along), glm::cross(p.along, q.along));
    if (sine2 > T(1e-18)) { // where the lines are closest
        const Vec<T> w = p.start - q.start;
        const T d = glm::dot(w, p.along), e = glm::dot(w, q.along), at = (cosine * e - d) / sine2,
                t = (e - cosine * d) / sine2;
        singular[count++] = {at, glm::length(w + at * p.along - t * q.along) / std::sqrt(sine2)};
    }
    constexpr int order = sizeof(T) > 8 ? 20 : 16;
    constexpr T ellipse = 3 + T(1) / 3; // rho + 1/rho
    const T least = T(1e-7) * p.length; // what is left then is below rounding: s ln s over 1e-7
    struct Panel {
        T from, to;
    };
    std::array<T, 5> cuts{0};
    std::size_t cut_count = 1;
    for (std::size_t k = 0; k < count; ++k) {
        if (!(singular[k].at > least && singular[k].at < p.length - least)) continue;
        std::size_t place = cut_count++; // kept in order
        for (; cuts[place - 1] > singular[k].at; --place) cuts[place] = cuts[place - 1];
        cuts[place] = singular[k].at;
    }
    cuts[cut_count++] = p.length;
    std::array<Panel, 128> stack;
    for (std::size_t cut = 0; cut + 1 < cut_count; ++cut) {
        std::size_t depth = 0;
        stack[depth++] = {cuts[cut], cuts[cut + 1]};
        while (depth > 0) {
            const Panel panel = stack[--depth];
            const T width = panel.to - panel.from;
            if (!(width > 0)) continue;
            bool smooth = true;
            for (std::size_t k = 0; k < count && smooth; ++k)
                smooth = std::hypot(singular[k].at - panel.from, singular[k].height) +
                             std::hypot(singular[k].at - panel.to, singular[k].height) >=
                         ellipse * width / 2;
            if (!smooth && width > least && depth + 2 <= stack.size()) {
                const T middle = (panel.from + panel.to) / 2;
                stack[depth++] = {panel.from, middle};
                stack[depth++] = {middle, panel.to};
                continue;
            }
            for (const GaussPoint& g : gauss_points(order)) {
                const T term = cosine * width * static_cast<T>(g.weight) *
                               log_potential(p.start + (panel.from + width * static_cast<T>(g.at)) * p.along, q);
                sum.value += term;
                sum.magnitude += std::abs(term);
            }
            sum.evaluations += order;
        }
    }
}

// A_1 F_12 = 1/(2 pi) oint oint ln r dr1 . dr2 (Sparrow 1963), the inner integral in closed form (as Narayanaswamy
// 2015). Exact for shared edges and corners.
template <typename T>
ExactFormFactor by_contours(const PlanarPolygon& from, const PlanarPolygon& to) {
    ContourSum<T> sum;
    const auto inner = edges_of<T>(to);
    for (const Segment<T>& p : edges_of<T>(from))
        for (const Segment<T>& q : inner) add_edge_pair(p, q, sum);
    constexpr T two_pi = 2 * std::numbers::pi_v<T>;
    return {static_cast<double>(sum.value / two_pi),
            static_cast<double>(8 * std::numeric_limits<T>::epsilon() * sum.magnitude / two_pi), sum.evaluations};
}

// A point and its weight, of a product rule collapsed onto each triangle of the fan.
struct CubaturePoint {
    glm::dvec3 at;
    double weight; // m^2
};
std::vector<CubaturePoint> cubature(const PlanarPolygon& polygon, int order) {
    std::vector<CubaturePoint> points;
    const auto& p = polygon.corners;
    for (std::size_t k = 1; k + 1 < p.size(); ++k) {
        const glm::dvec3 a = p[k] - p[0], b = p[k + 1] - p[0];
        const double area = glm::dot(glm::cross(a, b), polygon.normal);
        for (const GaussPoint& s : gauss_points(order))
            for (const GaussPoint& t : gauss_points(order)) {
                const auto u = static_cast<double>(s.at), v = static_cast<double>(t.at);
                points.push_back(
                    {p[0] + u * ((1 - v) * a + v * b), area * u * static_cast<double>(s.weight * t.weight)});
            }
    }
    return points;
}

// So that an integrand that is smooth to `distance` from a polygon of radius `size` is integrated to the last digit.
int smooth_order(double distance, double size) {
    const double h = distance / size, ellipse = h + std::sqrt(1 + h * h);
    return std::clamp(static_cast<int>(std::ceil(17 * std::numbers::ln10 / (2 * std::log(ellipse)))), 3,
                      most_gauss_points);
}

// A F from a polygon small for its distance: Lambert's formula at the points of a cubature.
ExactFormFactor by_lambert(const PlanarPolygon& small, const PlanarPolygon& other, double apart) {
    ExactFormFactor sum;
    double magnitude = 0;
    for (const CubaturePoint& point : cubature(small, smooth_order(apart, radius(small)))) {
        const LambertSum lambert = lambert_sum(point.at, small.normal, other.corners);
        sum.value += point.weight * lambert.value;
        magnitude += point.weight * lambert.magnitude;
        ++sum.evaluations;
    }
    sum.bound = 8 * std::numeric_limits<double>::epsilon() * magnitude;
    return sum;
}

// A F of two polygons small for their distance: the kernel itself, in which nothing cancels.
ExactFormFactor by_kernel(const PlanarPolygon& from, const PlanarPolygon& to, double apart) {
    ExactFormFactor sum;
    const int order = smooth_order(apart, std::max(radius(from), radius(to)));
    const auto points = cubature(to, order);
    for (const CubaturePoint& x : cubature(from, order))
        for (const CubaturePoint& y : points) {
            const glm::dvec3 d = y.at - x.at;
            const double r2 = glm::dot(d, d), product = -glm::dot(d, from.normal) * glm::dot(d, to.normal);
            sum.value += x.weight * y.weight * product / (std::numbers::pi * r2 * r2);
            ++sum.evaluations;
        }
    sum.bound = 16 * std::numeric_limits<double>::epsilon() * std::abs(sum.value);
    return sum;
}

} // namespace

LambertSum lambert_sum(glm::dvec3 point, glm::dvec3 normal, std::span<const glm::dvec3> corners) {
    LambertSum sum{0, 0};
    const std::size_t n = corners.size();
    glm::dvec3 v = corners[0] - point;
    for (std::size_t k = 0; k < n; ++k) {
        const glm::dvec3 next = corners[(k + 1) % n] - point;
        // By the edge and not by the next corner: far away they are almost the same.
        const glm::dvec3 c = glm::cross(v, corners[(k + 1) % n] - corners[k]);
        const double sine = glm::length(c);
        if (sine > 0) {
            const double angle = std::atan2(sine, glm::dot(v, next));
            sum.value -= angle * glm::dot(c, normal) / sine;
            sum.magnitude += angle;
        }
        v = next;
    }
    return {sum.value / (2 * std::numbers::pi), sum.magnitude / (2 * std::numbers::pi)};
}

ExactFormFactor exact_form_factor(const PlanarPolygon& from, const PlanarPolygon& to) {
    PlanarPolygon a = in_front_of(from, to), b = in_front_of(to, from);
    if (!(a.area > 0) || !(b.area > 0)) return {};
    const glm::dvec3 origin = centre(a);
    double reach = 0; // all lengths between about 0.01 and 1: no power of them leaves the range of numbers
    for (const PlanarPolygon* polygon : {&a, &b})
        for (const glm::dvec3& p : polygon->corners) reach = std::max(reach, glm::length(p - origin));
    a = scaled(a, origin, 1 / reach);
    b = scaled(b, origin, 1 / reach);
    const double apart = distance(a, b), size_a = radius(a), size_b = radius(b), small = std::min(size_a, size_b),
                 large = std::max(size_a, size_b);
    ExactFormFactor best{0, std::numeric_limits<double>::max(), 0};
    std::uint64_t evaluations = 0;
    const auto attempt = [&](const ExactFormFactor& found) { // in units of reach^2
        evaluations += found.evaluations;
        if (found.bound < best.bound) best = found;
        return best.bound <= good_enough * best.value;
    };
    const bool done =
        (apart >= 200 * large && attempt(by_kernel(a, b, apart))) ||
        (apart >= 3 * small && attempt(size_a <= size_b ? by_lambert(a, b, apart) : by_lambert(b, a, apart))) ||
        (apart >= 3 * large && attempt(by_kernel(a, b, apart))) || attempt(by_contours<double>(a, b)) ||
        attempt(by_contours<long double>(a, b));
    (void)done;
    const double area = from.area / (reach * reach);
    return {std::clamp(best.value / area, 0.0, 1.0), best.bound / area, evaluations};
}

} // namespace lueur
