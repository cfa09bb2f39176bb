// The mean of a picture over the part of it that triangles use.
#pragma once

#include <span>

#include "core/scene/scene.h"

namespace lueur {

// Mean of linear RGB, each triangle weighted by its area in the scene. The picture repeats. Triangles without area
// count nothing; without any triangle it is the mean of the whole picture. Costs about a million texel reads, shared
// out by area.
Rgb mean_texel(const TextureImage& image, std::span<const Vertex> vertices, std::span<const glm::uvec3> triangles);

// True where all corners have one uv: the file gave none.
bool has_no_uv(std::span<const Vertex> vertices, std::span<const glm::uvec3> triangles);

std::vector<glm::uvec3> triangles_of_material(const Scene& scene, MaterialIndex material);

} // namespace lueur
