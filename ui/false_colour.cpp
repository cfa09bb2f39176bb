#include "ui/false_colour.h"

namespace lueur {

glm::vec3 false_colour(float t) {
    constexpr glm::vec3 c0(0.2777f, 0.0054f, 0.3341f), c1(0.1051f, 1.4046f, 1.3846f), c2(-0.3309f, 0.2148f, 0.0951f),
        c3(-4.6342f, -5.7991f, -19.3324f), c4(6.2283f, 14.1799f, 56.6906f), c5(4.7764f, -13.7451f, -65.3530f),
        c6(-5.4355f, 4.6459f, 26.3124f);
    t = glm::clamp(t, 0.0f, 1.0f);
    return glm::clamp(c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (c5 + t * c6))))), 0.0f, 1.0f);
}

} // namespace lueur
