// The coarse element under a point of one of the scene's triangles, found at once.
//
// Going down a large triangle's tree is a chain of loads that each wait for the last: ten levels took two thirds of the
// time of the ray itself. A grid over the triangle guesses two elements; their weights there, an affine map of the
// triangle's, say whether one of them is right. Where none is, at an element's corner, the tree is asked.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/transport/mesh.h"

namespace lueur {

class TriangleGrid {
public:
    explicit TriangleGrid(std::shared_ptr<const TriangleTree> tree);
    // As coarse_element_at: b1, b2 become the element's.
    std::uint32_t element_at(std::uint32_t triangle, float& b1, float& b2) const;

private:
    struct Weights { // of the 2nd and 3rd vertex: c + x b1 + y b2
        float c1, x1, y1, c2, x2, y2;
        glm::vec2 at(float b1, float b2) const { return {c1 + x1 * b1 + y1 * b2, c2 + x2 * b1 + y2 * b2}; }
    };
    using Cell = std::array<std::uint32_t, 2>; // elements, counted from the triangle's first: at its centre, and next
    struct Grid {
        std::uint32_t cells = 0;         // along an edge; 0: the tree is as fast
        std::uint32_t first_cell = 0;    // of cells_
        std::uint32_t first_element = 0; // elements of a triangle are numbered one after the other
        std::uint32_t first_weights = 0;
    };
    static Weights weights_of(const std::array<glm::vec2, 3>& corners);
    void fill(std::uint32_t triangle, const Grid& grid);
    // Into the cells that it is the first or the second in, by depth so far.
    void enter(std::uint32_t element, const std::array<glm::vec2, 3>& corners, const Grid& grid,
               std::vector<std::array<float, 2>>& depths);

    std::shared_ptr<const TriangleTree> tree_;
    std::vector<Grid> grids_;
    std::vector<Cell> cells_;
    std::vector<Weights> weights_;
};

} // namespace lueur
