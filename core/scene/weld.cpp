#include "core/scene/weld.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scene/index_table.h"

namespace lueur {

namespace {

using Cell = std::array<std::int64_t, 3>;

std::uint64_t hash_of(const Cell& cell) {
    std::uint64_t hash = 0;
    for (const std::int64_t index : cell)
        hash = (hash ^ static_cast<std::uint64_t>(index)) * 0xff51afd7ed558ccdull + (hash >> 29);
    return hash;
}

} // namespace

std::vector<std::uint32_t> weld_positions(const std::vector<Vertex>& vertices, double distance) {
    constexpr std::uint32_t none = IndexTable::none;
    // Cells twice as wide as the distance: what is near lies in the cell or in the nearer neighbour along each axis, 8
    // cells in all.
    const double cell_size = std::max(2 * distance, 1e-30);
    IndexTable first_in_cell(vertices.size()); // of those that are welded to nobody; the others of a cell hang on it
    std::vector<std::uint32_t> next_in_cell(vertices.size(), none), weld(vertices.size());
    std::vector<Cell> cell_of(vertices.size());
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        weld[i] = i;
        const glm::dvec3 position(vertices[i].position);
        const glm::dvec3 scaled = position / cell_size;
        if (!(std::abs(scaled.x) < 9e18 && std::abs(scaled.y) < 9e18 && std::abs(scaled.z) < 9e18))
            continue; // of no triangle that is kept
        Cell& home = cell_of[i];
        Cell side{};
        for (int axis = 0; axis < 3; ++axis) {
            const double floor = std::floor(scaled[axis]);
            home[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(floor);
            side[static_cast<std::size_t>(axis)] = scaled[axis] - floor < 0.5 ? -1 : 1;
        }
        bool found = false;
        for (int neighbour = 0; neighbour < 8 && !found; ++neighbour) { // 0: home
            Cell cell = home;
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (neighbour >> axis & 1) cell[axis] += side[axis];
            std::uint32_t j =
                first_in_cell.find(hash_of(cell), [&](std::uint32_t other) { return cell_of[other] == cell; });
            for (; j != none && !found; j = next_in_cell[j]) {
                const glm::dvec3 difference = glm::dvec3(vertices[j].position) - position;
                if (glm::dot(difference, difference) > distance * distance) continue;
                weld[i] = j;
                found = true;
            }
        }
        if (found) continue;
        const std::uint32_t head =
            first_in_cell.find_or_insert(hash_of(home), i, [&](std::uint32_t other) { return cell_of[other] == home; });
        if (head != i) {
            next_in_cell[i] = next_in_cell[head];
            next_in_cell[head] = i;
        }
    }
    return weld;
}

} // namespace lueur
