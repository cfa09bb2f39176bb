#include "core/transport/world.h"

#include <algorithm>

#include <optional>

#include <embree3/rtcore.h>

#include "core/transport/triangle_grid.h"

namespace lueur {

struct World::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::shared_ptr<const TriangleTree> tree; // Embree's triangles are the scene's
    std::optional<TriangleGrid> grid;
    std::vector<std::uint32_t> surface; // of each triangle
    std::vector<glm::vec3> normal;      // of each triangle; not unit; towards the lit side
    std::vector<std::uint32_t> twin;    // of each coarse element: its other side
    float epsilon = 1e-4f;

    ~Embree() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
};

World::World(const Mesh& mesh)
    : embree_(std::make_unique<Embree>()) {
    Embree& e = *embree_;
    e.device = rtcNewDevice(nullptr);
    e.scene = rtcNewScene(e.device);
    rtcSetSceneFlags(e.scene, RTC_SCENE_FLAG_ROBUST); // no ray slips between two triangles of a wall
    rtcSetSceneBuildQuality(e.scene, RTC_BUILD_QUALITY_MEDIUM);

    e.tree = mesh.triangles;
    if (e.tree && e.tree->count > 0) { // one triangle stands for both sides
        RTCGeometry geometry = rtcNewGeometry(e.device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.coarse_vertex_count));
        glm::vec3 low(1e30f), high(-1e30f);
        for (std::uint32_t v = 0; v < mesh.coarse_vertex_count; ++v) {
            const glm::vec3 p = mesh.vertices[v].position;
            for (int k = 0; k < 3; ++k) positions[3 * v + k] = p[k];
            low = glm::min(low, p), high = glm::max(high, p);
        }
        auto* triangles = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), e.tree->count));
        for (std::uint32_t t = 0; t < e.tree->count; ++t) {
            const glm::uvec3 v = e.tree->nodes[t].vertices;
            for (int k = 0; k < 3; ++k) triangles[3 * t + k] = v[k];
            const glm::vec3 a = mesh.vertices[v.x].position;
            e.normal.push_back(glm::cross(mesh.vertices[v.y].position - a, mesh.vertices[v.z].position - a));
        }
        e.grid.emplace(e.tree);
        e.twin = mesh.coarse_twin;
        e.surface.resize(e.tree->count);
        for (std::uint32_t n = 0; n < mesh.coarse_triangle.size(); ++n)
            e.surface[mesh.coarse_triangle[n]] = mesh.coarse_surface[n];
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(e.scene, geometry);
        rtcReleaseGeometry(geometry);
        // Large against float rounding of positions, small against any thing in the scene.
        const float extent = std::max(glm::length(high - low), std::max(glm::length(high), glm::length(low)));
        e.epsilon = 2e-6f * extent + 1e-9f;
    }
    rtcCommitScene(e.scene);
}

World::~World() = default;

float World::epsilon() const {
    return embree_->epsilon;
}

Hit World::closest(const Ray& ray) const {
    RTCRayHit query; // only what Embree reads is set: clearing the rest took a tenth of the time of a ray
    query.ray.org_x = ray.origin.x, query.ray.org_y = ray.origin.y, query.ray.org_z = ray.origin.z;
    query.ray.dir_x = ray.direction.x, query.ray.dir_y = ray.direction.y, query.ray.dir_z = ray.direction.z;
    query.ray.tnear = ray.t_min;
    query.ray.tfar = ray.t_max;
    query.ray.time = 0;
    query.ray.mask = ~0u;
    query.ray.flags = 0;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(embree_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return hit_of(query.hit.primID, ray.direction, query.ray.tfar, query.hit.u, query.hit.v);
}

Hit World::hit_of(std::uint32_t triangle, glm::vec3 direction, float t, float b1, float b2) const {
    Hit hit;
    hit.t = t;
    hit.surface = embree_->surface[triangle];
    hit.b1 = b1, hit.b2 = b2;
    const std::uint32_t element = embree_->grid->element_at(triangle, hit.b1, hit.b2);
    if (glm::dot(embree_->normal[triangle], direction) <= 0) {
        hit.element = element;
    } else if (embree_->twin[element] != no_index) {
        hit.element = embree_->twin[element];
        std::swap(hit.b1, hit.b2);
    } else {
        hit.back_face = true;
    }
    return hit;
}

void World::closest(glm::vec3 origin, std::span<const glm::vec3> directions, std::span<Hit> hits) const {
    alignas(32) int valid[packet];
    alignas(32) RTCRayHit8 query;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    // First all of them, then the elements that they met: those are chains of loads, of which many run side by side.
    for (std::size_t first = 0; first < directions.size(); first += packet) {
        const std::size_t count = std::min(packet, directions.size() - first);
        for (std::size_t k = 0; k < packet; ++k) {
            const glm::vec3 direction = directions[first + std::min(k, count - 1)];
            valid[k] = k < count ? -1 : 0;
            query.ray.org_x[k] = origin.x, query.ray.org_y[k] = origin.y, query.ray.org_z[k] = origin.z;
            query.ray.dir_x[k] = direction.x, query.ray.dir_y[k] = direction.y, query.ray.dir_z[k] = direction.z;
            query.ray.tnear[k] = 0, query.ray.tfar[k] = 1e30f;
            query.ray.time[k] = 0, query.ray.mask[k] = ~0u, query.ray.flags[k] = 0;
            query.hit.geomID[k] = query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect8(valid, embree_->scene, &context, &query);
        for (std::size_t k = 0; k < count; ++k) {
            Hit& hit = hits[first + k];
            hit.surface = query.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID ? no_index : query.hit.primID[k];
            hit.t = query.ray.tfar[k], hit.b1 = query.hit.u[k], hit.b2 = query.hit.v[k];
        }
    }
    for (std::size_t k = 0; k < directions.size(); ++k)
        hits[k] = hits[k].surface == no_index
                      ? Hit{}
                      : hit_of(hits[k].surface, directions[k], hits[k].t, hits[k].b1, hits[k].b2);
}

bool World::occluded(const Ray& ray) const {
    RTCRay query;
    query.org_x = ray.origin.x, query.org_y = ray.origin.y, query.org_z = ray.origin.z;
    query.dir_x = ray.direction.x, query.dir_y = ray.direction.y, query.dir_z = ray.direction.z;
    query.tnear = ray.t_min;
    query.tfar = ray.t_max;
    query.time = 0;
    query.mask = ~0u;
    query.flags = 0;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(embree_->scene, &context, &query);
    return query.tfar < 0;
}

std::uint32_t World::hidden(glm::vec3 origin, std::span<const glm::vec3> targets) const {
    alignas(32) int valid[packet] = {};
    alignas(32) RTCRay8 query;
    for (std::size_t k = 0; k < packet; ++k) {
        const glm::vec3 direction = targets[std::min(k, targets.size() - 1)] - origin;
        valid[k] = k < targets.size() ? -1 : 0;
        query.org_x[k] = origin.x, query.org_y[k] = origin.y, query.org_z[k] = origin.z;
        query.dir_x[k] = direction.x, query.dir_y[k] = direction.y, query.dir_z[k] = direction.z;
        query.tnear[k] = 0, query.tfar[k] = shadow_ray_end;
        query.time[k] = 0, query.mask[k] = ~0u, query.flags[k] = 0;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded8(valid, embree_->scene, &context, &query);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < targets.size(); ++k) bits |= std::uint32_t(query.tfar[k] < 0) << k;
    return bits;
}

} // namespace lueur
