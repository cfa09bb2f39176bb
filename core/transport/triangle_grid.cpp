#include "core/transport/triangle_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lueur {

namespace {

constexpr std::uint32_t fewest_elements = 5; // of a triangle with a grid
constexpr float cells_an_element = 6;
constexpr float infinity = std::numeric_limits<float>::infinity();

} // namespace

TriangleGrid::TriangleGrid(std::shared_ptr<const TriangleTree> tree)
    : tree_(std::move(tree))
    , grids_(tree_->count) {
    std::size_t cells = 0, elements = 0;
    std::vector<std::uint32_t> path;
    for (std::uint32_t t = 0; t < tree_->count; ++t) {
        if (tree_->nodes[t].children == no_index) continue;
        std::uint32_t leaves = 0, first = no_index;
        path.assign(1, t);
        while (!path.empty()) {
            const TriangleTree::Node& node = tree_->nodes[path.back()];
            path.pop_back();
            if (node.children == no_index) {
                ++leaves, first = std::min(first, node.element);
                continue;
            }
            path.push_back(node.children);
            path.push_back(node.children + 1);
        }
        if (leaves < fewest_elements) continue;
        const auto along = static_cast<std::uint32_t>(std::ceil(std::sqrt(2 * cells_an_element * float(leaves))));
        grids_[t] = {along, static_cast<std::uint32_t>(cells), first, static_cast<std::uint32_t>(elements)};
        cells += std::size_t(along) * along;
        elements += leaves;
    }
    cells_.assign(cells, {0, 0});
    weights_.resize(elements);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, tree_->count, 16),
                      [&](const tbb::blocked_range<std::uint32_t>& range) {
                          for (std::uint32_t t = range.begin(); t < range.end(); ++t)
                              if (grids_[t].cells > 0) fill(t, grids_[t]);
                      });
}

void TriangleGrid::fill(std::uint32_t triangle, const Grid& grid) {
    struct Place {
        std::uint32_t node;
        std::array<glm::vec2, 3> corners; // (b1, b2) of the triangle: sums of powers of 1/2, exact
    };
    // How deep in its elements the centre of each cell is: least weight, below 0 outside.
    std::vector<std::array<float, 2>> depths(std::size_t(grid.cells) * grid.cells, {-infinity, -infinity});
    std::vector<Place> path{{triangle, {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}}};
    while (!path.empty()) {
        const auto [n, corners] = path.back();
        path.pop_back();
        const TriangleTree::Node& node = tree_->nodes[n];
        if (node.children == no_index) {
            const std::uint32_t element = node.element - grid.first_element;
            weights_[grid.first_weights + element] = weights_of(corners);
            enter(element, corners, grid, depths);
            continue;
        }
        const std::size_t k = node.split_edge;
        const glm::vec2 a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3], middle = 0.5f * (a + b);
        path.push_back({node.children, {a, middle, c}});
        path.push_back({node.children + 1, {middle, b, c}});
    }
}

TriangleGrid::Weights TriangleGrid::weights_of(const std::array<glm::vec2, 3>& corners) {
    const glm::vec2 a = corners[0], ab = corners[1] - a, ac = corners[2] - a;
    const float area = ab.x * ac.y - ab.y * ac.x;
    Weights w{0, ac.y / area, -ac.x / area, 0, -ab.y / area, ab.x / area};
    const glm::vec2 at_a = w.at(a.x, a.y);
    w.c1 = -at_a.x, w.c2 = -at_a.y;
    return w;
}

void TriangleGrid::enter(std::uint32_t element, const std::array<glm::vec2, 3>& corners, const Grid& grid,
                         std::vector<std::array<float, 2>>& depths) {
    const Weights& weights = weights_[grid.first_weights + element];
    const auto cells = static_cast<float>(grid.cells);
    const glm::uvec2 low(cells * glm::min(corners[0], glm::min(corners[1], corners[2]))),
        high(cells * glm::max(corners[0], glm::max(corners[1], corners[2])));
    for (std::uint32_t y = low.y; y <= high.y; ++y)
        for (std::uint32_t x = low.x; x <= high.x && x + y < grid.cells; ++x) {
            const glm::vec2 w = weights.at((float(x) + 0.5f) / cells, (float(y) + 0.5f) / cells);
            const float depth = std::min({w.x, w.y, 1 - w.x - w.y});
            const std::size_t i = std::size_t(y) * grid.cells + x;
            Cell& cell = cells_[grid.first_cell + i];
            if (depth > depths[i][0]) {
                cell = {element, cell[0]};
                depths[i] = {depth, depths[i][0]};
            } else if (depth > depths[i][1]) {
                cell[1] = element, depths[i][1] = depth;
            }
        }
}

std::uint32_t TriangleGrid::element_at(std::uint32_t triangle, float& b1, float& b2) const {
    const Grid& grid = grids_[triangle];
    if (grid.cells > 0) {
        const int last = static_cast<int>(grid.cells) - 1;
        const int x = std::clamp(static_cast<int>(b1 * float(grid.cells)), 0, last);
        const int y = std::clamp(static_cast<int>(b2 * float(grid.cells)), 0, last - x);
        for (const std::uint32_t element :
             cells_[grid.first_cell + static_cast<std::uint32_t>(y) * grid.cells + static_cast<std::uint32_t>(x)]) {
            const glm::vec2 w = weights_[grid.first_weights + element].at(b1, b2);
            if (w.x >= 0 && w.y >= 0 && w.x + w.y <= 1) {
                b1 = w.x, b2 = w.y;
                return grid.first_element + element;
            }
        }
    }
    return coarse_element_at(*tree_, triangle, b1, b2);
}

} // namespace lueur
