// The solution as it is shown: XYZ at the vertices of the fine mesh.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace lueur {

// Values at the mesh vertices, one each.
struct Field {
    std::vector<glm::vec3> irradiance_xyz; // lx in Y
    std::vector<glm::vec3> reflected_xyz;  // reflected radiance: rho * irradiance / pi; cd m^-2 in Y
    std::vector<glm::vec3> emitted_xyz;    // emitted radiance, cd m^-2 in Y
    std::vector<float> unshot;             // unshot (or residual) luminous exitance, lm m^-2
};

} // namespace lueur
