// What hierarchical radiosity shows: without cracks between levels, and how near the truth for how many links.
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/solve/solution_state.h"
#include "core/view/picture.h"
#include "tests/support/scenes.h"

using namespace lueur;

namespace {

Scene hierarchical(Scene scene, RefinementOracle oracle, double tolerance, double target) {
    scene.solve.solver = SolverKind::hierarchical;
    scene.solve.oracle = oracle;
    scene.solve.link_tolerance = tolerance;
    scene.solve.target_error = target;
    return scene;
}

// A wall 4 m wide with a small bright lamp close in front of one corner: cut finely there, coarsely elsewhere.
Scene wall_of_mixed_levels() {
    test::SceneBuilder b;
    const MaterialIndex white = b.material("white", 0.7), black = b.material("black", 0.0);
    b.polygon("wall", white, {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}});
    const ObjectIndex lamp =
        b.polygon("lamp", black, {{0.4f, 0.4f, 0.3f}, {0.4f, 0.6f, 0.3f}, {0.6f, 0.6f, 0.3f}, {0.6f, 0.4f, 0.3f}});
    b.light("lamp", {lamp}, PowerUnit::lumen, 500);
    Scene scene = b.build();
    scene.camera.position = {2, 1.5, 4};
    scene.camera.target = {2, 1.5, 0};
    scene.camera.vertical_fov_degrees = 40;
    return scene;
}

} // namespace

TEST(HierarchicalPicture, NoCrackBetweenLevels) {
    Scene scene = hierarchical(wall_of_mixed_levels(), RefinementOracle::flux, 2e-4, 0.05);
    scene.solve.element_size = 1;
    const Solution solution = test::solved(scene);
    ASSERT_TRUE(solution.status().settled) << solution.status().message;
    const Hierarchy& h = *solution.state().hierarchy;
    std::map<int, int> levels;
    for (const ElementNode& n : h.tree().nodes)
        if (n.is_leaf()) ++levels[n.level];
    ASSERT_GE(levels.size(), 3u) << "the wall should be of mixed levels";

    // No vertex of the mesh lies inside an edge of another element of its surface.
    const Mesh& mesh = *solution.mesh();
    for (const glm::uvec3& e : mesh.elements)
        for (int k = 0; k < 3; ++k) {
            const MeshVertex &a = mesh.vertices[e[k]], &b = mesh.vertices[e[(k + 1) % 3]];
            const glm::vec3 along = b.position - a.position;
            const float length2 = glm::dot(along, along);
            for (const MeshVertex& v : mesh.vertices) {
                if (v.surface != a.surface || v.back != a.back) continue;
                const float t = glm::dot(v.position - a.position, along) / length2;
                const glm::vec3 off = v.position - a.position - t * along;
                ASSERT_FALSE(t > 1e-3f && t < 1 - 1e-3f && glm::dot(off, off) < 1e-10f * length2)
                    << "T-vertex at " << v.position.x << " " << v.position.y;
            }
        }

    // Every pixel is covered, and the light to both sides of every edge is the same on the screen.
    const FieldView view{solution.scene(), solution.mesh(), solution.world(), solution.field()};
    const RadianceImage image = render_picture(view, scene.camera, {160, 120, 1}, PictureQuantity::colour, test::never);
    float brightest = 0;
    for (const glm::vec3& xyz : image.xyz) brightest = std::max(brightest, xyz.y);
    for (const glm::vec3& xyz : image.xyz) ASSERT_TRUE(std::isfinite(xyz.y) && xyz.y >= 0);
    const auto shown = [&](glm::vec3 p) {
        const auto point = field_along_ray(view, Ray{p + glm::vec3(0, 0, 0.1f), glm::vec3(0, 0, -1)});
        EXPECT_TRUE(point.has_value());
        return point ? 255 * std::pow(std::min(point->radiance.y / double(brightest), 1.0), 1 / 2.2) : 0;
    };
    double worst = 0;
    for (const glm::uvec3& e : mesh.elements) {
        if (mesh.vertices[e.x].normal.z < 0.5f) continue; // the lamp
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 a = mesh.vertices[e[k]].position, b = mesh.vertices[e[(k + 1) % 3]].position;
            const glm::vec3 side = glm::normalize(glm::cross(b - a, glm::vec3(0, 0, 1)));
            for (const float t : {0.1f, 0.5f, 0.9f}) {
                const glm::vec3 p = a + t * (b - a), q = p + 2e-5f * side, r = p - 2e-5f * side;
                const auto inside = [](glm::vec3 x) { return x.x > 0 && x.x < 4 && x.y > 0 && x.y < 3; };
                if (inside(q) && inside(r)) worst = std::max(worst, std::abs(shown(q) - shown(r)));
            }
        }
    }
    EXPECT_LE(worst, 1.0);
    const double aspect = 160.0 / 120;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) {
            const Ray ray = camera_ray(scene.camera, aspect, (x + 0.5) / 160, (y + 0.5) / 120);
            const glm::vec3 p = ray.origin - ray.origin.z / ray.direction.z * ray.direction;
            if (p.x <= 0 || p.x >= 4 || p.y <= 0 || p.y >= 3) continue;
            ASSERT_TRUE(field_along_ray(view, ray).has_value()) << x << " " << y;
        }
}
