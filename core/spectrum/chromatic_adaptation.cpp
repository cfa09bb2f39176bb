#include "core/spectrum/chromatic_adaptation.h"

namespace lueur {

glm::dmat3 bradford_adaptation(const Xyz& from, const Xyz& to) {
    // Cone responses from XYZ; rows as printed in ICC.1:2010, annex E.
    const glm::dmat3 cone = glm::transpose(glm::dmat3{
        {0.8951, 0.2664, -0.1614},
        {-0.7502, 1.7135, 0.0367},
        {0.0389, -0.0685, 1.0296},
    });
    const glm::dvec3 gain = (cone * to) / (cone * from);
    const glm::dmat3 scale{{gain.x, 0, 0}, {0, gain.y, 0}, {0, 0, gain.z}};
    return glm::inverse(cone) * scale * cone;
}

} // namespace lueur
