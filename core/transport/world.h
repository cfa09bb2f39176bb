// The scene as rays see it: the only code that sees Embree.
//
// Built on the triangles of the scene; what is hit is told as a coarse element of the mesh. Immutable after make_world;
// all queries may run from any number of threads.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <glm/glm.hpp>

#include "core/transport/mesh.h"

namespace lueur {

struct Ray {
    glm::vec3 origin;
    glm::vec3 direction; // need not be unit; t is in its lengths
    float t_min = 0, t_max = 1e30f;
};

// t_max of a ray whose direction reaches just to a point of a surface: rounding must not let that surface hide it.
inline constexpr float shadow_ray_end = 1 - 1e-4f;

struct Hit {
    std::uint32_t element =
        no_index; // coarse element whose lit side was hit; no_index: nothing, or the black back of a one-sided surface
    bool back_face = false; // met the back of a one-sided surface
    float t = 1e30f;
    float b1 = 0, b2 = 0;             // barycentric weights of the element's 2nd and 3rd vertex
    std::uint32_t surface = no_index; // set also for back faces
    bool any() const { return surface != no_index; }
};

class World {
public:
    explicit World(const Mesh& mesh);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    Hit closest(const Ray& ray) const;
    // Of rays from one place, one hit a direction: a third faster than one by one.
    void closest(glm::vec3 origin, std::span<const glm::vec3> directions, std::span<Hit> hits) const;
    bool occluded(const Ray& ray) const; // anything between t_min and t_max

    // Shadow rays from one place go through the scene together: about twice as fast as one by one. Bit k: something is
    // between `origin` and target k (but for the last 1e-4 of the way). At most `packet` targets.
    static constexpr std::size_t packet = 8;
    std::uint32_t hidden(glm::vec3 origin, std::span<const glm::vec3> targets) const;

    float epsilon() const; // m; how far rays start from their surface

private:
    Hit hit_of(std::uint32_t triangle, glm::vec3 direction, float t, float b1, float b2) const;

    struct Embree;
    std::unique_ptr<Embree> embree_;
};

} // namespace lueur
