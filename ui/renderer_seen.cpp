// Which elements a camera may see. Setting up triangles is most of a software renderer's frame, so what turns its back,
// lies outside of the picture or (while things move) is smaller than half a pixel is left out before.
#include <algorithm>
#include <array>

#include <glm/gtc/matrix_access.hpp>

#include "ui/renderer.h"

namespace lueur {

void Renderer::choose_seen(const glm::mat4& clip_from_world, glm::vec3 eye, float smallest) {
    std::array<glm::vec4, 5> sides; // left, right, bottom, top, near; positive inside (Gribb & Hartmann 2001)
    for (int k = 0; k < 5; ++k) {
        const glm::vec4 row = glm::row(clip_from_world, k / 2);
        sides[static_cast<std::size_t>(k)] = glm::row(clip_from_world, 3) + (k % 2 == 0 ? row : -row);
    }
    for (glm::vec4& side : sides) side /= glm::length(glm::vec3(side));

    std::vector<glm::uvec3> elements;
    std::vector<std::uint32_t> patches;
    elements.reserve(ordered_elements_.size());
    patches.reserve(ordered_elements_.size());
    const glm::vec4 from(eye, 1);
    for (auto& batch : batches_) {
        batch.first_seen = elements.size();
        const std::size_t end = batch.first + batch.count;
        for (std::size_t e = batch.first; e < end;) {
            const std::size_t block = e / elements_a_block, last = std::min(end, (block + 1) * elements_a_block);
            const glm::vec4 centre(glm::vec3(spheres_[block]), 1);
            const bool outside = std::ranges::any_of(
                sides, [&](const glm::vec4& side) { return glm::dot(side, centre) < -spheres_[block].w; });
            const float nearest = std::max(0.0f, glm::distance(eye, glm::vec3(spheres_[block])) - spheres_[block].w);
            const float length = smallest * nearest; // that is seen under the smallest angle
            for (; e < last; ++e) {
                if (outside || glm::dot(planes_[e], from) <= 0) continue;
                const glm::vec3 twice_area(planes_[e]);
                if (glm::dot(twice_area, twice_area) < length * length * length * length) continue;
                elements.push_back(ordered_elements_[e]);
                patches.push_back(ordered_patches_[e]);
            }
        }
        batch.seen = elements.size() - batch.first_seen;
    }
    glBindVertexArray(vertex_array_);
    fill(GL_ELEMENT_ARRAY_BUFFER, elements_, elements, GL_STREAM_DRAW);
    glBindVertexArray(0);
    fill(GL_TEXTURE_BUFFER, coarse_, patches, GL_STREAM_DRAW);
}

} // namespace lueur
