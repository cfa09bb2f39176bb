// Scenes made in code, for tests that know the answer.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/surfaces.h"
#include "core/solve/solution.h"

namespace lueur::test {

class SceneBuilder {
public:
    MaterialIndex material(const std::string& name, Reflectance reflectance, bool two_sided = false) {
        scene_.materials.push_back({name, reflectance, std::nullopt, two_sided});
        return MaterialIndex(scene_.materials.size() - 1);
    }
    // Counter-clockwise from the front, convex.
    ObjectIndex polygon(const std::string& name, MaterialIndex material, const std::vector<glm::vec3>& corners) {
        const ObjectIndex object = object_named(name, material);
        const std::uint32_t first = static_cast<std::uint32_t>(soup_.vertices.size());
        for (const glm::vec3& c : corners) soup_.vertices.push_back({c, glm::vec3(0), glm::vec2(c.x, c.y)});
        for (std::uint32_t k = 2; k < corners.size(); ++k) {
            soup_.triangles.push_back({first, first + k - 1, first + k});
            soup_.triangle_object.push_back(object);
        }
        return object;
    }
    // Of a ball around the origin: the normals are its own.
    void smooth_triangle(const std::string& name, MaterialIndex material, const std::array<glm::vec3, 3>& corners) {
        const ObjectIndex object = object_named(name, material);
        const std::uint32_t first = static_cast<std::uint32_t>(soup_.vertices.size());
        for (const glm::vec3& c : corners) soup_.vertices.push_back({c, glm::normalize(c), glm::vec2(0)});
        soup_.triangles.push_back({first, first + 1, first + 2});
        soup_.triangle_object.push_back(object);
    }
    // Axis-aligned box; inward: a room, each face its own object "name floor", ...; else one solid object.
    // without: the number of a face that is left out, or -1.
    std::array<ObjectIndex, 6> room(const std::string& name, std::array<MaterialIndex, 6> materials, glm::vec3 low,
                                    glm::vec3 high, int without = -1) {
        std::array<ObjectIndex, 6> faces{};
        static const char* names[6] = {"floor", "ceiling", "left", "right", "front", "back"};
        for (int f = 0; f < 6; ++f)
            if (f != without) faces[f] = polygon(name + " " + names[f], materials[f], face(f, low, high, true));
        return faces;
    }
    ObjectIndex block(const std::string& name, MaterialIndex material, glm::vec3 low, glm::vec3 high) {
        ObjectIndex object{};
        for (int f = 0; f < 6; ++f) object = polygon(name, material, face(f, low, high, false));
        return object;
    }
    // A closed room of one paint with a square lamp of side 2 * half in its ceiling, as a part of it: nothing hides
    // behind the lamp, so that the flux that arrives is lumen / (1 - rho), on all surfaces together.
    LuminaireIndex lit_room(const std::string& name, MaterialIndex material, glm::vec3 low, glm::vec3 high, float half,
                            double lumen) {
        for (const int f : {0, 2, 3, 4, 5})
            polygon(name + " wall " + std::to_string(f), material, face(f, low, high, true));
        const glm::vec3 middle = 0.5f * (low + high);
        const float x[4] = {low.x, middle.x - half, middle.x + half, high.x};
        const float z[4] = {low.z, middle.z - half, middle.z + half, high.z};
        ObjectIndex lamp{};
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) {
                const bool is_lamp = i == 1 && k == 1;
                const ObjectIndex part = polygon(name + (is_lamp ? " lamp" : " ceiling"), material,
                                                 face(1, {x[i], low.y, z[k]}, {x[i + 1], high.y, z[k + 1]}, true));
                if (is_lamp) lamp = part;
            }
        return light(name + " lamp", {lamp}, PowerUnit::lumen, lumen);
    }
    LuminaireIndex light(const std::string& name, std::vector<ObjectIndex> objects, PowerUnit unit, double power,
                         EmissionSpectrum spectrum = Flat{}, EmitSide side = EmitSide::front) {
        scene_.luminaires.push_back({name, std::move(objects), std::move(spectrum), unit, power, 1.0, side});
        return LuminaireIndex(scene_.luminaires.size() - 1);
    }
    Scene build() {
        std::vector<std::string> warnings;
        scene_.geometry = std::make_shared<Geometry>(make_geometry(soup_, scene_.objects, warnings));
        return scene_;
    }
    Scene& settings() { return scene_; }

private:
    ObjectIndex object_named(const std::string& name, MaterialIndex material) {
        for (std::size_t o = 0; o < scene_.objects.size(); ++o)
            if (scene_.objects[o].name == name) return ObjectIndex(o);
        scene_.objects.push_back({name, material});
        return ObjectIndex(scene_.objects.size() - 1);
    }
    // floor y-, ceiling y+, left x-, right x+, front z-, back z+.
    static std::vector<glm::vec3> face(int f, glm::vec3 a, glm::vec3 b, bool inward) {
        std::vector<glm::vec3> v;
        switch (f) {
        case 0:
            v = {{a.x, a.y, a.z}, {a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, a.y, a.z}};
            break;
        case 1:
            v = {{a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}};
            break;
        case 2:
            v = {{a.x, a.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z}, {a.x, a.y, b.z}};
            break;
        case 3:
            v = {{b.x, a.y, a.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}};
            break;
        case 4:
            v = {{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}};
            break;
        default:
            v = {{a.x, a.y, b.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z}};
            break;
        }
        if (!inward) std::swap(v[1], v[3]);
        return v;
    }
    Scene scene_;
    TriangleSoup soup_;
};

inline std::array<MaterialIndex, 6> all(MaterialIndex m) {
    return {m, m, m, m, m, m};
}

// Unit cube whose six faces all have exitance 1 W/m2 and reflectance rho: B = 1 / (1 - rho) everywhere.
inline Scene furnace(double rho) {
    SceneBuilder b;
    const auto faces = b.room("furnace", all(b.material("wall", rho)), glm::vec3(0), glm::vec3(1));
    b.light("wall", {faces.begin(), faces.end()}, PowerUnit::exitance, 1);
    return b.build();
}

// A closed room with a red and a green wall, a block on its floor and two lamps under the ceiling.
inline Scene small_room() {
    SceneBuilder b;
    const MaterialIndex white = b.material("white", 0.75), red = b.material("red", Rgb(0.6, 0.06, 0.05)),
                        green = b.material("green", Rgb(0.1, 0.4, 0.1)), grey = b.material("grey", 0.4);
    b.room("room", {white, white, red, green, white, white}, glm::vec3(0), glm::vec3(3, 2.5f, 4));
    b.block("block", grey, {1, 0, 1.5f}, {1.8f, 0.9f, 2.3f});
    const ObjectIndex lamp =
        b.polygon("lamp", grey, {{1, 2.45f, 1}, {1.6f, 2.45f, 1}, {1.6f, 2.45f, 1.4f}, {1, 2.45f, 1.4f}});
    const ObjectIndex spot =
        b.polygon("spot", grey, {{2.4f, 2.4f, 3}, {2.5f, 2.4f, 3}, {2.5f, 2.4f, 3.1f}, {2.4f, 2.4f, 3.1f}});
    b.light("lamp", {lamp}, PowerUnit::lumen, 3000, Blackbody{2700});
    b.light("spot", {spot}, PowerUnit::lumen, 800, Blackbody{5000});
    Scene scene = b.build();
    scene.solve.target_error = 0.05; // most tests ask less of it
    return scene;
}

inline const std::atomic<bool> never{false}; // for what can be cancelled

inline void settle(Solution& solution) {
    while (solution.step(never)) {
    }
}

inline void edit(Solution& solution, const Scene& scene, SolveFrom from) { // and waits for what comes of it
    solution.update(std::make_shared<const Scene>(scene), from);
    settle(solution);
}
inline Solution solved(Scene scene) {
    Solution solution(std::make_shared<const Scene>(std::move(scene)));
    settle(solution);
    return solution;
}

// Relative RMS difference of the irradiance of two fields on the same mesh.
inline double field_difference(const Field& a, const Field& b) {
    double square = 0, norm = 0;
    for (std::size_t v = 0; v < a.irradiance_xyz.size(); ++v) {
        const glm::dvec3 d = glm::dvec3(a.irradiance_xyz[v]) - glm::dvec3(b.irradiance_xyz[v]);
        square += glm::dot(d, d);
        norm += glm::dot(glm::dvec3(b.irradiance_xyz[v]), glm::dvec3(b.irradiance_xyz[v]));
    }
    return norm > 0 ? std::sqrt(square / norm) : std::sqrt(square);
}

} // namespace lueur::test
