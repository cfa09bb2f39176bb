#include "core/transport/hemicube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/transport/form_factor_methods.h"

namespace lueur {

namespace {

using std::numbers::pi;

// Of the rectangle from (0, 0) to (x, y) at height 1 (Howell B-3).
double top_corner(double x, double y) {
    const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
    return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2 * pi);
}

// Antiderivative in y and z of z / (pi (y^2 + z^2 + 1)^2): the side at distance 1.
double side_corner(double y, double z) {
    const double a = std::sqrt(1 + z * z);
    return -std::atan(y / a) / (2 * pi * a);
}

template <typename Corner>
std::vector<double> cells(int across, int up, double low, double step, const Corner& corner) {
    std::vector<double> deltas;
    for (int row = 0; row < up; ++row) {
        const double z0 = low + row * step, z1 = std::min(1.0, z0 + step);
        for (int column = 0; column < across; ++column) {
            const double y0 = -1 + column * step, y1 = y0 + step;
            deltas.push_back(corner(y1, z1) - corner(y0, z1) - corner(y1, z0) + corner(y0, z0));
        }
    }
    return deltas;
}

// Tables are made once a thread for as long as the resolution stays.
std::shared_ptr<const HemicubeDeltas> deltas_of(int resolution) {
    thread_local std::shared_ptr<const HemicubeDeltas> last;
    if (!last || last->resolution != resolution)
        last = std::make_shared<const HemicubeDeltas>(make_hemicube_deltas(resolution));
    return last;
}

} // namespace

HemicubeDeltas make_hemicube_deltas(int resolution) {
    const double step = 2.0 / resolution;
    return {resolution, cells(resolution, resolution, -1, step, top_corner),
            cells(resolution, (resolution + 1) / 2, 0, step, side_corner)};
}

Hemicube::Hemicube(int resolution)
    : resolution_(std::clamp(resolution, 1, most_hemicube_resolution))
    , deltas_(deltas_of(resolution_)) {
    items_.resize(deltas_->top.size() + 4 * deltas_->side.size(), nothing);
    nearness_.resize(items_.size(), 0);
}

void Hemicube::place(glm::dvec3 eye, glm::dvec3 normal, double turn) {
    eye_ = eye;
    const Axes axes(normal, turn);
    const glm::dvec3 around[5] = {axes.x, axes.y, -axes.x, -axes.y, axes.x};
    faces_[0] = {axes.z, axes.x, axes.y, resolution_, 0};
    for (std::size_t side = 0; side < 4; ++side)
        faces_[side + 1] = {around[side], around[side + 1], axes.z, (resolution_ + 1) / 2,
                            deltas_->top.size() + side * deltas_->side.size()};
    std::ranges::fill(items_, nothing);
    std::ranges::fill(nearness_, 0);
}

double Hemicube::row_height(const Face& face, int row) const {
    const double step = 2.0 / resolution_;
    if (&face == &faces_[0]) return -1 + (row + 0.5) * step;
    return 0.5 * (row * step + std::min(1.0, (row + 1) * step));
}

double Hemicube::delta(std::size_t pixel) const {
    const std::size_t top = deltas_->top.size();
    return pixel < top ? deltas_->top[pixel] : deltas_->side[(pixel - top) % deltas_->side.size()];
}

glm::dvec3 Hemicube::direction(std::size_t pixel) const {
    std::size_t f = 4;
    while (faces_[f].first > pixel) --f;
    const auto across = static_cast<std::size_t>(resolution_);
    const std::size_t at = pixel - faces_[f].first;
    const double x = -1 + (static_cast<double>(at % across) + 0.5) * 2 / resolution_;
    return faces_[f].forward + x * faces_[f].right +
           row_height(faces_[f], static_cast<int>(at / across)) * faces_[f].up;
}

void Hemicube::draw(std::span<const glm::dvec3> corners, glm::dvec3 normal, std::uint32_t item) {
    const std::size_t n = corners.size();
    const double away = glm::dot(normal, corners[0] - eye_);
    if (away == 0) return; // edge-on
    thread_local std::vector<glm::dvec3> seen, inward;
    seen.clear();
    inward.clear();
    bool above = false;
    for (std::size_t k = 0; k < n; ++k) {
        seen.push_back(corners[k] - eye_);
        const glm::dvec3 plane = glm::cross(seen[k], corners[(k + 1) % n] - corners[k]);
        inward.push_back(away > 0 ? plane : -plane);
        above = above || glm::dot(seen[k], faces_[0].forward) > 0;
    }
    if (!above) return;
    struct Edge {
        double at, right, up;
    };
    thread_local std::vector<Edge> edges;
    for (const Face& face : faces_) {
        bool before = false, all_before = true;
        double low = std::numeric_limits<double>::max(), high = -low, left = low, most_right = -low;
        for (const glm::dvec3& v : seen) {
            const double depth = glm::dot(v, face.forward);
            before = before || depth > 0;
            all_before = all_before && depth > 0;
            if (!(depth > 0)) continue;
            const double y = glm::dot(v, face.up) / depth, x = glm::dot(v, face.right) / depth;
            low = std::min(low, y), high = std::max(high, y), left = std::min(left, x),
            most_right = std::max(most_right, x);
        }
        if (!before) continue;
        int first = 0, last = face.rows - 1;
        if (all_before) {
            if (left > 1 || most_right < -1) continue;
            const double floor = &face == &faces_[0] ? -1 : 0;
            const double from = (low - floor) * resolution_ / 2 - 1, to = (high - floor) * resolution_ / 2 + 1;
            if (from > last || to < 0) continue;
            first = std::max(first, static_cast<int>(from));
            last = to < last ? static_cast<int>(to) : last;
        }
        edges.clear();
        for (const glm::dvec3& plane : inward)
            edges.push_back({glm::dot(plane, face.forward), glm::dot(plane, face.right), glm::dot(plane, face.up)});
        const double near_at = glm::dot(normal, face.forward) / away, near_right = glm::dot(normal, face.right) / away,
                     near_up = glm::dot(normal, face.up) / away;
        for (int row = first; row <= last; ++row) {
            const double y = row_height(face, row);
            double from = -1, to = 1;
            for (const Edge& edge : edges) {
                const double rest = edge.at + y * edge.up;
                if (edge.right > 0)
                    from = std::max(from, -rest / edge.right);
                else if (edge.right < 0)
                    to = std::min(to, -rest / edge.right);
                else if (rest < 0)
                    to = -2;
            }
            if (from > to) continue;
            // A pixel between two patches belongs to both: none slips through a common edge.
            const int begin = std::max(0, static_cast<int>(std::ceil((from + 1) * resolution_ / 2 - 0.5 - 1e-9))),
                      end = std::min(resolution_ - 1,
                                     static_cast<int>(std::floor((to + 1) * resolution_ / 2 - 0.5 + 1e-9)));
            const std::size_t base = face.first + static_cast<std::size_t>(row) * static_cast<std::size_t>(resolution_);
            for (int column = begin; column <= end; ++column) {
                const double x = -1 + (column + 0.5) * 2 / resolution_;
                const double nearness = near_at + x * near_right + y * near_up;
                const std::size_t pixel = base + static_cast<std::size_t>(column);
                if (nearness > margin * nearness_[pixel] && nearness > 0) {
                    nearness_[pixel] = nearness;
                    items_[pixel] = item;
                }
            }
        }
    }
}

} // namespace lueur
