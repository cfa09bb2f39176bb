// The hemicube: five faces of pixels around an element, each with the item seen through it and its form factor (Cohen &
// Greenberg 1985).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace lueur {

// The form factors of all pixels, exact: Lambert's formula of a rectangle by its four corners, not the kernel at the
// pixel's middle, whose sum is 1.0055 at 10 x 10 pixels. Top: resolution^2 pixels; a side: resolution pixels across,
// half as many up (for an odd number the highest are half as high).
struct HemicubeDeltas {
    int resolution;
    std::vector<double> top, side; // row by row from below
};
HemicubeDeltas make_hemicube_deltas(int resolution);

inline constexpr int most_hemicube_resolution = 4096;

class Hemicube {
public:
    explicit Hemicube(int resolution);

    // Empty, around an element; `turn` turns the faces about the normal.
    void place(glm::dvec3 eye, glm::dvec3 normal, double turn);
    // A convex polygon seen from either side, nearer things hide further ones. Of two at one place the first is kept.
    // Scan conversion by the planes through the eye and each edge (Pineda 1988): nothing has to be clipped.
    void draw(std::span<const glm::dvec3> corners, glm::dvec3 normal, std::uint32_t item);

    static constexpr std::uint32_t nothing = 0xffffffffu;
    std::size_t size() const { return items_.size(); } // pixels
    std::uint32_t item(std::size_t pixel) const { return items_[pixel]; }
    double delta(std::size_t pixel) const;         // form factor of the pixel; all sum to 1
    glm::dvec3 direction(std::size_t pixel) const; // through its middle; not unit
    // How much nearer than what is there a drawn polygon must be, as a factor; 1: at all.
    double margin = 1;

private:
    struct Face {
        glm::dvec3 forward, right, up;
        int rows;
        std::size_t first; // pixel
    };
    double row_height(const Face& face, int row) const;

    int resolution_;
    std::shared_ptr<const HemicubeDeltas> deltas_;
    glm::dvec3 eye_{0};
    Face faces_[5];
    std::vector<std::uint32_t> items_;
    std::vector<double> nearness_; // 1 / distance along the face's normal; 0: nothing
};

} // namespace lueur
