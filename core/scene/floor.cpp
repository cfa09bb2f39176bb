#include "core/scene/floor.h"

#include <algorithm>
#include <cmath>

#include "core/scene/luminaire.h"

namespace lueur {

namespace {

double luminous_reflectance(const Reflectance& reflectance, const Wavelengths& wavelengths) {
    const std::vector<double> rho = reflectance_channels(reflectance, wavelengths);
    double reflected = 0, all = 0;
    for (std::size_t k = 0; k < rho.size(); ++k) {
        reflected += wavelengths.xyz_weight[k].y * rho[k];
        all += wavelengths.xyz_weight[k].y;
    }
    return all > 0 ? reflected / all : 0;
}

double floor_area(const Geometry& geometry) {
    struct Piece {
        double area, height;
    };
    const double least_cosine = std::cos(glm::radians(15.0));
    std::vector<Piece> pieces;
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::uvec3& triangle : geometry.triangles) {
        glm::dvec3 corner[3];
        for (int k = 0; k < 3; ++k) {
            corner[k] = glm::dvec3(geometry.vertices[triangle[k]].position);
            low = glm::min(low, corner[k]), high = glm::max(high, corner[k]);
        }
        const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]); // twice the area long
        const double length = glm::length(normal);
        if (length > 0 && normal.y >= least_cosine * length)
            pieces.push_back({0.5 * length, (corner[0].y + corner[1].y + corner[2].y) / 3});
    }
    if (geometry.triangles.empty()) return 0;
    if (pieces.empty()) return (high.x - low.x) * (high.z - low.z);
    const double bottom = std::ranges::min(pieces, {}, &Piece::height).height;
    const double top = bottom + 0.1 * (high.y - low.y);
    double area = 0;
    for (const Piece& piece : pieces)
        if (piece.height <= top) area += piece.area;
    return area;
}

} // namespace

FloorFacts floor_facts(const Scene& scene) {
    FloorFacts facts;
    if (!scene.geometry) return facts;
    for (const Luminaire& luminaire : scene.luminaires) facts.luminous_flux += luminous_flux(scene, luminaire);
    facts.floor_area = floor_area(*scene.geometry);

    const Wavelengths wavelengths = make_wavelengths({WavelengthRule::uniform, 31});
    std::vector<double> reflectance;
    for (const Material& material : scene.materials)
        reflectance.push_back(luminous_reflectance(material.reflectance, wavelengths));
    const auto lamps = luminaire_of_objects(scene);
    double reflected = 0, area = 0;
    for (std::size_t s = 0; s < scene.geometry->surfaces.size(); ++s) {
        const ObjectIndex object = scene.geometry->surfaces[s].object;
        if (lamps[at(object)]) continue;
        area += scene.geometry->surface_area[s];
        reflected += scene.geometry->surface_area[s] * reflectance[at(scene.objects[at(object)].material)];
    }
    facts.mean_reflectance = area > 0 ? reflected / area : 0;
    return facts;
}

} // namespace lueur
