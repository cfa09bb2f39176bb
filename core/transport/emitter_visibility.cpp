#include "core/transport/emitter_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lueur {

namespace {

constexpr int lattice = 16;      // steps along an edge of a triangle: cells after the last cut
constexpr int fewest_cells = 32; // of an emitter, before the first cut
constexpr float inside = 0.98f;  // lattices end a little before the rim, which its frame may hide
constexpr double mixed_cell_deviation =
    0.25; // of the share of a cell that is cut by a shadow's edge, known by 3 corners

// A point of a triangle's lattice: (x, y) / lattice are the weights of its 2nd and 3rd corner.
using Place = glm::ivec2;

class TriangleVisibility {
public:
    TriangleVisibility(const World& world, const EmitterTriangle& triangle, glm::vec3 origin, glm::vec3 normal,
                       int finest)
        : world_(world)
        , triangle_(triangle)
        , origin_(origin)
        , normal_(normal)
        , finest_(finest) {
        known_.fill(unknown);
    }

    // A cell with legs of `size` lattice steps; size < 0: one that stands on its head.
    void add(Place corner, int size) {
        const Place b = corner + Place(size, 0), c = corner + Place(0, size);
        const double kernel = kernel_at((glm::vec2(corner) + glm::vec2(b) + glm::vec2(c)) / 3.0f);
        const int seen = seen_at(corner) + seen_at(b) + seen_at(c);
        if (seen % 3 != 0 && std::abs(size) > finest_) {
            const int half = size / 2;
            add(corner, half);
            add(corner + Place(half, 0), half);
            add(corner + Place(0, half), half);
            add(corner + Place(half, half), -half);
            return;
        }
        const double weight = kernel * size * size;
        all += weight;
        visible += weight * seen / 3;
        if (seen % 3 != 0) variance += mixed_cell_deviation * mixed_cell_deviation * weight * weight;
    }

    double visible = 0, all = 0, variance = 0;
    std::uint64_t rays = 0;

private:
    enum Known : std::uint8_t { hidden, seen_, unknown };

    glm::vec3 at(glm::vec2 place) const {
        const glm::vec2 b = (place - lattice / 3.0f) * inside / float(lattice) + 1 / 3.0f;
        const auto& p = triangle_.corners;
        return p[0] + b.x * (p[1] - p[0]) + b.y * (p[2] - p[0]);
    }
    double kernel_at(glm::vec2 place) const {
        return double(emitter_kernel(origin_, normal_, {at(place), triangle_.normal}));
    }
    // Below the receiver's horizon nothing is seen, and no ray is needed.
    bool seen_at(Place place) {
        std::uint8_t& known = known_[static_cast<std::size_t>(place.y * (lattice + 1) + place.x)];
        if (known == unknown) {
            const glm::vec3 target = at(glm::vec2(place));
            known = hidden;
            if (glm::dot(target - origin_, normal_) > 0 && (++rays, sees(world_, origin_, target))) known = seen_;
        }
        return known == seen_;
    }

    const World& world_;
    const EmitterTriangle& triangle_;
    const glm::vec3 origin_, normal_;
    const int finest_; // lattice steps of the smallest cells
    std::array<std::uint8_t, (lattice + 1) * (lattice + 1)> known_;
};

} // namespace

VisibleShare visible_share(const World& world, const Emitter& emitter, glm::vec3 origin, glm::vec3 normal,
                           VisibilityDetail detail, std::uint64_t& rays) {
    int cells = 1; // along an edge of each triangle
    while (cells < lattice && static_cast<int>(emitter.triangles.size()) * cells * cells < fewest_cells) cells *= 2;
    const int size = lattice / cells;
    const int finest = std::max(1, size >> static_cast<int>(detail));
    double visible = 0, all = 0, variance = 0;
    for (const EmitterTriangle& t : emitter.triangles) {
        if (glm::dot(origin - t.corners[0], t.normal) <= 0) continue; // behind it
        TriangleVisibility triangle(world, t, origin, normal, finest);
        for (int y = 0; y < lattice; y += size)
            for (int x = 0; x + y < lattice; x += size) {
                triangle.add({x, y}, size);
                if (x + y + 2 * size <= lattice) triangle.add({x + size, y + size}, -size);
            }
        visible += t.area * triangle.visible;
        all += t.area * triangle.all;
        variance += double(t.area) * t.area * triangle.variance;
        rays += triangle.rays;
    }
    if (!(all > 0)) return {};
    return {visible / all, std::sqrt(variance) / all};
}

} // namespace lueur
