#include "core/transport/triangle_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lueur {

namespace {

constexpr std::uint32_t fewest_elements = 5; // of a triangle with a grid
constexpr float cells_an_element = 6;

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
    cells_.assign(cells, 0);
    weights_.resize(elements);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, tree_->count, 16),
                      [&](const tbb::blocked_range<std::uint32_t>& range) {
                          for (std::uint32_t t = range.begin(); t < range.end(); ++t)
                              if (grids_[t].cells > 0) fill(t, grids_[t]);
                      });
}

void TriangleGrid::fill(std::uint32_t triangle, const Grid& grid) {
    // Rows of weights, as c + x b1 + y b2, on the way down: what a step does to weights (mesh.cpp) it does to each of
    // their coefficients.
    struct Place {
        std::uint32_t node;
        std::array<glm::dvec3, 3> weights;
    };
    std::vector<Place> path{{triangle, {glm::dvec3(1, -1, -1), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}}};
    while (!path.empty()) {
        const auto [n, w] = path.back();
        path.pop_back();
        const TriangleTree::Node& node = tree_->nodes[n];
        if (node.children == no_index) {
            weights_[grid.first_weights + node.element - grid.first_element] = {
                float(w[1].x), float(w[1].y), float(w[1].z), float(w[2].x), float(w[2].y), float(w[2].z)};
            continue;
        }
        const std::size_t k = node.split_edge;
        const glm::dvec3 a = w[k], b = w[(k + 1) % 3], c = w[(k + 2) % 3];
        path.push_back({node.children, {a - b, 2.0 * b, c}});
        path.push_back({node.children + 1, {2.0 * a, b - a, c}});
    }
    for (std::uint32_t y = 0; y < grid.cells; ++y)
        for (std::uint32_t x = 0; x + y < grid.cells; ++x) {
            float b1 = (float(x) + 0.5f) / float(grid.cells), b2 = (float(y) + 0.5f) / float(grid.cells);
            cells_[grid.first_cell + y * grid.cells + x] =
                coarse_element_at(*tree_, triangle, b1, b2) - grid.first_element;
        }
}

std::uint32_t TriangleGrid::element_at(std::uint32_t triangle, float& b1, float& b2) const {
    const Grid& grid = grids_[triangle];
    if (grid.cells > 0) {
        const int last = static_cast<int>(grid.cells) - 1;
        const int x = std::clamp(static_cast<int>(b1 * float(grid.cells)), 0, last);
        const int y = std::clamp(static_cast<int>(b2 * float(grid.cells)), 0, last - x);
        const std::uint32_t element =
            cells_[grid.first_cell + static_cast<std::uint32_t>(y) * grid.cells + static_cast<std::uint32_t>(x)];
        const Weights& w = weights_[grid.first_weights + element];
        const float w1 = w.c1 + w.x1 * b1 + w.y1 * b2, w2 = w.c2 + w.x2 * b1 + w.y2 * b2;
        if (w1 >= 0 && w2 >= 0 && w1 + w2 <= 1) {
            b1 = w1, b2 = w2;
            return grid.first_element + element;
        }
    }
    return coarse_element_at(*tree_, triangle, b1, b2);
}

} // namespace lueur
