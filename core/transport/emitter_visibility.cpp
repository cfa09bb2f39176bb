#include "core/transport/emitter_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace lueur {

namespace {

constexpr int lattice = 16;      // steps along an edge of a triangle: cells after the last cut
constexpr int fewest_cells = 32; // of an emitter, before the first cut
constexpr float turn = 0.5f;     // of the lattice, in steps of its finest cells from end to end
constexpr double mixed_cell_deviation =
    0.25; // of the share of a cell that is cut by a shadow's edge, known by 3 corners

// A point of a triangle's lattice: (x, y) / lattice are the weights of its 2nd and 3rd corner.
using Place = glm::ivec2;

// With legs of `size` lattice steps; size < 0: one that stands on its head.
struct LatticeCell {
    Place corner;
    int size;
    std::array<Place, 3> corners() const { return {corner, corner + Place(size, 0), corner + Place(0, size)}; }
};

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

    // Cells with legs of `size` steps, and those that a shadow's edge runs through cut again and again: level by level,
    // so that the shadow rays of each go through the scene together.
    void look(int size) {
        LatticeCell *now = cells_.data(), *next = next_.data();
        std::size_t count = 0;
        for (int y = 0; y < lattice; y += size)
            for (int x = 0; x + y < lattice; x += size) {
                now[count++] = {{x, y}, size};
                if (x + y + 2 * size <= lattice) now[count++] = {{x + size, y + size}, -size};
            }
        while (count > 0) {
            for (std::size_t k = 0; k < count; ++k)
                for (const Place corner : now[k].corners()) want(corner);
            trace();
            std::size_t cut = 0;
            for (std::size_t k = 0; k < count; ++k) {
                const LatticeCell cell = now[k];
                const auto [a, b, c] = cell.corners();
                const int lit = is_seen(a) + is_seen(b) + is_seen(c);
                const bool mixed = lit % 3 != 0;
                if (mixed && std::abs(cell.size) > finest_) {
                    const int half = cell.size / 2;
                    next[cut++] = {cell.corner, half};
                    next[cut++] = {cell.corner + Place(half, 0), half};
                    next[cut++] = {cell.corner + Place(0, half), half};
                    next[cut++] = {cell.corner + Place(half, half), -half};
                    continue;
                }
                const double weight =
                    kernel_at((glm::vec2(a) + glm::vec2(b) + glm::vec2(c)) / 3.0f) * cell.size * cell.size;
                all += weight;
                visible += weight * lit / 3;
                if (mixed) variance += mixed_cell_deviation * mixed_cell_deviation * weight * weight;
            }
            std::swap(now, next);
            count = cut;
        }
    }

    double visible = 0, all = 0, variance = 0;
    std::uint64_t rays = 0;

private:
    enum Known : std::uint8_t { hidden, seen, wanted, unknown };

    // Turned a little: of an edge that runs as the lattice does (all of a lamp in a housing do) one point after the
    // other falls into the shadow, not a row at once.
    glm::vec3 looked_at(Place place) const {
        const glm::vec2 from_middle = glm::vec2(place) / float(lattice) - 1 / 3.0f;
        glm::vec2 at = glm::vec2(place) + turn * float(finest_) * glm::vec2(-from_middle.y, from_middle.x);
        at = glm::abs(at); // what was turned out is folded in
        if (const float beyond = at.x + at.y - lattice; beyond > 0) at -= beyond;
        return inside_emitter(triangle_, {1 - (at.x + at.y) / lattice, at.x / lattice, at.y / lattice});
    }
    double kernel_at(glm::vec2 place) const {
        const glm::vec2 b = place / float(lattice);
        const auto& p = triangle_.corners;
        const glm::vec3 at = p[0] + b.x * (p[1] - p[0]) + b.y * (p[2] - p[0]);
        return double(emitter_kernel(origin_, normal_, {at, triangle_.normal}));
    }
    std::uint8_t& known(Place place) { return known_[static_cast<std::size_t>(place.y * (lattice + 1) + place.x)]; }
    bool is_seen(Place place) { return known(place) == seen; }

    // Below the receiver's horizon nothing is seen, and no ray is needed.
    void want(Place place) {
        if (known(place) != unknown) return;
        const glm::vec3 target = looked_at(place);
        known(place) = hidden;
        if (glm::dot(target - origin_, normal_) <= 0) return;
        known(place) = wanted;
        targets_[waiting_] = target, places_[waiting_] = place;
        if (++waiting_ == World::packet) trace();
    }
    void trace() {
        if (waiting_ == 0) return;
        const std::uint32_t between = world_.hidden(origin_, std::span(targets_).first(waiting_));
        for (std::size_t k = 0; k < waiting_; ++k) known(places_[k]) = between >> k & 1 ? hidden : seen;
        rays += waiting_;
        waiting_ = 0;
    }

    const World& world_;
    const EmitterTriangle& triangle_;
    const glm::vec3 origin_, normal_;
    const int finest_; // lattice steps of the smallest cells
    std::array<std::uint8_t, (lattice + 1) * (lattice + 1)> known_;
    std::array<LatticeCell, lattice * lattice> cells_, next_; // of a level, and of the one after it
    std::array<glm::vec3, World::packet> targets_;            // rays that wait to be traced
    std::array<Place, World::packet> places_;
    std::size_t waiting_ = 0;
};

} // namespace

VisibleShare visible_share(const World& world, const Emitter& emitter, glm::vec3 origin, glm::vec3 normal,
                           VisibilityDetail detail, std::uint64_t& rays) {
    int cells = 1; // along an edge of each triangle
    while (cells < lattice && static_cast<int>(emitter.triangles.size()) * cells * cells < fewest_cells) cells *= 2;
    const int size = lattice / cells;
    const int cuts = detail == VisibilityDetail::two_cuts ? 2 : detail == VisibilityDetail::one_cut ? 1 : 0;
    const int finest = std::max(1, size >> cuts);
    double visible = 0, all = 0, variance = 0;
    for (const EmitterTriangle& t : emitter.triangles) {
        if (glm::dot(origin - t.corners[0], t.normal) <= 0) continue; // behind it
        TriangleVisibility triangle(world, t, origin, normal, finest);
        triangle.look(size);
        visible += t.area * triangle.visible;
        all += t.area * triangle.all;
        variance += double(t.area) * t.area * triangle.variance;
        rays += triangle.rays;
    }
    if (!(all > 0)) return {};
    return {visible / all, std::sqrt(variance) / all};
}

} // namespace lueur
