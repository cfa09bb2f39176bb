// Behind a few occluders: the visible part of `to` is found exactly from each point of a quadrature over `from`.
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "core/transport/form_factor_exact.h"

namespace lueur {

namespace {

using Corners = std::vector<glm::dvec3>;

// Cuts `polygon` by a plane through the origin: what lies in front (dot > 0), and the rest.
void cut(const Corners& polygon, glm::dvec3 normal, Corners& front, Corners& rest) {
    front.clear();
    rest.clear();
    const std::size_t n = polygon.size();
    double height = glm::dot(normal, polygon[0]);
    for (std::size_t k = 0; k < n; ++k) {
        const glm::dvec3 p = polygon[k], next = polygon[(k + 1) % n];
        const double next_height = glm::dot(normal, next);
        if (height >= 0) front.push_back(p);
        if (height <= 0) rest.push_back(p);
        if ((height > 0 && next_height < 0) || (height < 0 && next_height > 0)) {
            const glm::dvec3 between = p + (height / (height - next_height)) * (next - p);
            front.push_back(between);
            rest.push_back(between);
        }
        height = next_height;
    }
}

class VisiblePart {
public:
    VisiblePart(glm::dvec3 normal, const PlanarPolygon& to, std::vector<PlanarPolygon> occluders)
        : normal_(normal)
        , to_(to)
        , occluders_(std::move(occluders)) {}

    double form_factor_from(glm::dvec3 point) {
        parts_.clear();
        Corners& whole = parts_.emplace_back();
        for (const glm::dvec3& p : to_.corners) whole.push_back(p - point);
        for (const PlanarPolygon& occluder : occluders_) {
            remaining_.clear();
            for (const Corners& part : parts_) subtract(part, occluder, point);
            std::swap(parts_, remaining_);
            if (parts_.empty()) return 0;
        }
        double sum = 0;
        for (const Corners& part : parts_) sum += lambert_sum(glm::dvec3(0), normal_, part).value;
        return std::max(0.0, sum);
    }

private:
    // The shadow is the cone over the occluder: what of the part lies outside one of its planes stays, plane by plane.
    void subtract(const Corners& part, const PlanarPolygon& occluder, glm::dvec3 point) {
        const std::size_t n = occluder.corners.size();
        const double side = glm::dot(occluder.normal, occluder.corners[0] - point);
        if (side == 0) { // seen edge-on
            remaining_.push_back(part);
            return;
        }
        const std::size_t before = remaining_.size();
        inside_ = part;
        for (std::size_t k = 0; k < n && inside_.size() >= 3; ++k) {
            const glm::dvec3 a = occluder.corners[k] - point;
            const glm::dvec3 inward =
                (side > 0 ? 1.0 : -1.0) * glm::cross(a, occluder.corners[(k + 1) % n] - occluder.corners[k]);
            cut(inside_, inward, front_, outside_);
            if (outside_.size() >= 3) remaining_.push_back(outside_);
            std::swap(inside_, front_);
        }
        if (inside_.size() < 3) { // the shadow misses it: whole, as it was
            remaining_.resize(before);
            remaining_.push_back(part);
        }
    }

    glm::dvec3 normal_;
    const PlanarPolygon& to_;
    std::vector<PlanarPolygon> occluders_;
    std::vector<Corners> parts_, remaining_;
    Corners inside_, front_, outside_;
};

struct Cell { // a triangle of the quadrature
    glm::dvec3 a, b, c;
    double value; // of the integral over it
    double error;
    bool operator<(const Cell& other) const { return error < other.error; }
};

} // namespace

ExactFormFactor occluded_form_factor(const PlanarPolygon& from, const PlanarPolygon& to,
                                     std::span<const PlanarPolygon> occluders, double tolerance, std::uint64_t most) {
    const PlanarPolygon i = in_front_of(from, to), j = in_front_of(to, from);
    if (!(i.area > 0) || !(j.area > 0)) return {};
    // What of an occluder can stand between: in front of both planes.
    std::vector<PlanarPolygon> between;
    for (const PlanarPolygon& occluder : occluders)
        if (PlanarPolygon part = in_front_of(in_front_of(occluder, to), from); part.area > 0)
            between.push_back(std::move(part));
    if (between.empty()) return exact_form_factor(from, to);
    VisiblePart visible(i.normal, j, std::move(between));

    ExactFormFactor result;
    // Radon's rule of seven points, exact to the fifth degree (Stroud 1971, T2:5-1).
    const auto integral = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
        static const double root = std::sqrt(15.0), near = (6 - root) / 21, far = (6 + root) / 21,
                            near_weight = (155 - root) / 1200, far_weight = (155 + root) / 1200;
        const auto at = [&](double v, double w) {
            ++result.evaluations;
            return visible.form_factor_from(a + v * (b - a) + w * (c - a));
        };
        const double sum = 0.225 * at(1.0 / 3, 1.0 / 3) +
                           near_weight * (at(near, near) + at(1 - 2 * near, near) + at(near, 1 - 2 * near)) +
                           far_weight * (at(far, far) + at(1 - 2 * far, far) + at(far, 1 - 2 * far));
        return sum * 0.5 * glm::length(glm::cross(b - a, c - a));
    };
    std::priority_queue<Cell> cells;
    double value = 0, error = 0;
    const auto split = [&](const Cell& cell) {
        const glm::dvec3 ab = 0.5 * (cell.a + cell.b), bc = 0.5 * (cell.b + cell.c), ca = 0.5 * (cell.c + cell.a);
        Cell children[4] = {{cell.a, ab, ca, 0, 0}, {ab, cell.b, bc, 0, 0}, {ca, bc, cell.c, 0, 0}, {ab, bc, ca, 0, 0}};
        double sum = 0;
        for (Cell& child : children) sum += child.value = integral(child.a, child.b, child.c);
        for (Cell& child : children) {
            // An integrand that is smooth here has a far smaller error than the difference; one with a kink has not.
            child.error = std::abs(sum - cell.value) / 4;
            value += child.value;
            error += child.error;
            cells.push(child);
        }
    };
    const auto& p = i.corners;
    for (std::size_t k = 1; k + 1 < p.size(); ++k) {
        const double whole = integral(p[0], p[k], p[k + 1]);
        split({p[0], p[k], p[k + 1], whole, 0});
    }
    // Each triangle is divided twice before the error is believed: a small shadow falls between the first points.
    std::vector<Cell> first;
    for (; !cells.empty(); cells.pop()) first.push_back(cells.top());
    value = error = 0;
    for (const Cell& cell : first) split(cell);
    while (error > tolerance * std::abs(value) && result.evaluations + 28 <= most && !cells.empty()) {
        const Cell worst = cells.top();
        if (!(worst.error > 0)) break;
        cells.pop();
        value -= worst.value;
        error -= worst.error;
        split(worst);
    }
    value = error = 0; // summed anew: nothing of the differences is left
    for (; !cells.empty(); cells.pop()) {
        value += cells.top().value;
        error += cells.top().error;
    }
    result.value = std::clamp(value / from.area, 0.0, 1.0);
    result.bound = error / from.area;
    return result;
}

} // namespace lueur
