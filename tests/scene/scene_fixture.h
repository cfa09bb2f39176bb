// A folder of its own for each test, files in it, and scenes loaded from it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/scene_file.h"
#include "tests/support/temporary_folder.h"

namespace lueur {

class SceneTest : public test::FolderTest {
protected:
    // The scene, or an empty one and a failure.
    LoadedScene load(const std::string& name) const {
        auto loaded = load_scene(folder / name);
        if (loaded) return std::move(*loaded);
        for (const std::string& error : loaded.error()) ADD_FAILURE() << error;
        return {};
    }
    std::vector<std::string> errors_of(const std::string& name) const {
        const auto loaded = load_scene(folder / name);
        return loaded ? std::vector<std::string>{} : loaded.error();
    }

    // A picture of black and white squares, row by row from the top left: exact in every encoding.
    void write_picture(const std::string& name, int width, const std::vector<bool>& white) const {
        DisplayImage image{width, static_cast<int>(white.size()) / width, {}};
        for (const bool one : white)
            image.rgb.push_back(one ? std::array<std::uint8_t, 3>{255, 255, 255}
                                    : std::array<std::uint8_t, 3>{0, 0, 0});
        const auto written = write_display_image(folder / name, image, {});
        ASSERT_TRUE(written) << written.error();
    }
};

inline std::string lines(const std::vector<std::string>& messages) {
    return fmt::format("{}", fmt::join(messages, "\n"));
}

inline double surface_area(const Geometry& geometry, ObjectIndex object) {
    double area = 0;
    for (std::size_t i = 0; i < geometry.triangles.size(); ++i) {
        if (geometry.surfaces[at(geometry.triangle_surface[i])].object != object) continue;
        const glm::uvec3& t = geometry.triangles[i];
        area += glm::length(glm::cross(glm::dvec3(geometry.vertices[t.y].position - geometry.vertices[t.x].position),
                                       glm::dvec3(geometry.vertices[t.z].position - geometry.vertices[t.x].position))) /
                2;
    }
    return area;
}

inline glm::dvec3 normal_of(const Geometry& geometry, std::size_t triangle) {
    const glm::uvec3& t = geometry.triangles[triangle];
    return glm::normalize(glm::cross(glm::dvec3(geometry.vertices[t.y].position - geometry.vertices[t.x].position),
                                     glm::dvec3(geometry.vertices[t.z].position - geometry.vertices[t.x].position)));
}

// One square of 1 m2 that looks up, and a lamp of 2 m2 that looks down.
inline const std::string small_scene = R"(name = "small"
units = "metre"

[[polygon]]
name = "floor"
material = "grey"
vertices = [[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]]

[[polygon]]
name = "lamp"
material = "grey"
vertices = [[0, 2, 0], [2, 2, 0], [2, 2, 1], [0, 2, 1]]

[[material]]
name = "grey"
reflectance = 0.5

[[luminaire]]
name = "light"
objects = ["lamp"]
power = { lumen = 3000 }
)";

} // namespace lueur
