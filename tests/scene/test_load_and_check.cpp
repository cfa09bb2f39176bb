// Defaults, warnings, framing, and check().
#include "core/scene/frame.h"
#include "scene_fixture.h"

namespace lueur {
namespace {

using testing::HasSubstr;

TEST_F(SceneTest, SmallSceneLoads) {
    write("small.toml", small_scene);
    const auto [scene, warnings] = load("small.toml");
    EXPECT_TRUE(warnings.empty()) << lines(warnings);
    EXPECT_EQ(scene.name, "small");
    EXPECT_EQ(scene.unit, LengthUnit::metre);
    EXPECT_EQ(scene.up, UpAxis::y);
    EXPECT_EQ(scene.display, DisplaySettings{});
    EXPECT_EQ(scene.solve, SolveSettings{});
    EXPECT_EQ(scene.geometry->surfaces.size(), 2u);
    EXPECT_NEAR(normal_of(*scene.geometry, 0).y, 1, 1e-9);
    EXPECT_NEAR(normal_of(*scene.geometry, 2).y, -1, 1e-9);
    EXPECT_TRUE(check(scene).empty());
    EXPECT_EQ(scene.folder, folder);
}

TEST_F(SceneTest, PolygonsOfOneNameAreOneObject) {
    std::string text = small_scene;
    text.replace(text.find("name = \"floor\""), 14, "name = \"lamp\"");
    write("s.toml", text);
    const Scene scene = load("s.toml").scene;
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_NEAR(surface_area(*scene.geometry, ObjectIndex{0}), 3, 1e-6);
    const std::string other = "[[polygon]]\nname = \"lamp\"\nmaterial = \"white\"\nvertices = "
                              "[[0,0,5],[1,0,5],[0,1,5]]\n[[material]]\nname = \"white\"\nreflectance = 0.8\n";
    write("t.toml", text + other);
    EXPECT_THAT(lines(errors_of("t.toml")), HasSubstr("polygons of one name have one material"));
}

TEST_F(SceneTest, NoLightIsTold) {
    std::string text = small_scene.substr(0, small_scene.find("[[luminaire]]"));
    write("dark.toml", text);
    EXPECT_THAT(lines(load("dark.toml").warnings), HasSubstr("dark.toml: nothing emits; the picture will be black"));
    write("dimmed.toml", small_scene + "dimmer = 0\n");
    EXPECT_THAT(lines(load("dimmed.toml").warnings), HasSubstr("nothing emits"));
}

TEST_F(SceneTest, AllWhiteIsTold) {
    std::string text = small_scene;
    text.replace(text.find("reflectance = 0.5"), 17, "reflectance = 1");
    write("white.toml", text);
    EXPECT_THAT(lines(load("white.toml").warnings), HasSubstr("every surface reflects all light"));
}

TEST_F(SceneTest, WithoutACameraTheWholeSceneIsSeen) {
    write("s.toml", small_scene);
    const Scene scene = load("s.toml").scene;
    const Camera& camera = scene.camera;
    const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
    for (const Vertex& vertex : scene.geometry->vertices) {
        const glm::dvec3 to = glm::normalize(glm::dvec3(vertex.position) - camera.position);
        EXPECT_GT(glm::dot(to, forward), std::cos(camera.vertical_fov_degrees / 2 * M_PI / 180));
    }
}

TEST_F(SceneTest, ARoomIsSeenFromInside) {
    write("room.obj", "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 5\nv 4 0 5\nv 4 3 5\nv 0 3 5\n"
                      "f 1 2 3 4\nf 6 5 8 7\nf 5 1 4 8\nf 2 6 7 3\nf 1 5 6 2\nf 4 3 7 8\n");
    const Camera camera = load("room.obj").scene.camera;
    for (int k = 0; k < 3; ++k) {
        EXPECT_GT(camera.position[k], 0.1);
        EXPECT_LT(camera.position[k], glm::dvec3(4, 3, 5)[k] - 0.1);
    }
}

// Every value that a panel may set out of range is found.
TEST_F(SceneTest, CheckFindsWhatIsOutOfRange) {
    write("s.toml", small_scene);
    const Scene good = load("s.toml").scene;
    const double nan = std::nan("");
    const std::vector<std::pair<void (*)(Scene&, double), std::vector<double>>> faults{
        {[](Scene& s, double v) { s.materials[0].reflectance = v; }, {-0.1, 1.1, nan}},
        {[](Scene& s, double v) { s.materials[0].reflectance = Rgb(0.5, v, 0.5); }, {-0.1, 1.1, nan}},
        {[](Scene& s, double v) {
             s.materials[0].reflectance = SpectrumFile{"x", "", Spectrum{{400, 700}, {0.5, v}}};
         },
         {-0.1, 1.1, nan}},
        {[](Scene& s, double v) { s.luminaires[0].power = v; }, {-1, nan, INFINITY}},
        {[](Scene& s, double v) { s.luminaires[0].dimmer = v; }, {-1, nan, INFINITY}},
        {[](Scene& s, double v) { s.luminaires[0].spectrum = Blackbody{v}; }, {0, 999, 1e6, nan}},
        {[](Scene& s, double v) { s.luminaires[0].spectrum = Rgb(1, 1, v); }, {-1, nan}},
        {[](Scene& s, double v) { s.luminaires[0].objects = {ObjectIndex{static_cast<std::uint32_t>(v)}}; }, {2, 4e9}},
        {[](Scene& s, double v) { s.objects[0].material = MaterialIndex{static_cast<std::uint32_t>(v)}; }, {1, 4e9}},
        {[](Scene& s, double v) { s.camera.vertical_fov_degrees = v; }, {0, 180, nan}},
        {[](Scene& s, double v) { s.camera.position.x = v; }, {nan, INFINITY}},
        {[](Scene& s, double v) { s.camera.target = s.camera.position + glm::dvec3(0, v, 0); }, {0, 1, -5}},
        {[](Scene& s, double v) { s.display.max_display = v; }, {0, -1, nan, 1e31, 1e-31}},
        {[](Scene& s, double v) { s.display.gamma.b = v; }, {0, 11, nan, 1e-30, 1e30}},
        {[](Scene& s, double v) { s.display.primaries.white.x = v; }, {0, 0.9, nan}},
        {[](Scene& s, double v) { s.display.illuminance_scale.high = v; }, {1, 0, nan}},
        {[](Scene& s, double v) {
             s.display.luminance_scale.levels = {100, v};
         },
         {0, -1, nan}},
        {[](Scene& s, double v) { s.solve.target_error = v; }, {0, 1.5, nan}},
        {[](Scene& s, double v) { s.solve.element_size = v; }, {-1, nan}},
        {[](Scene& s, double v) { s.solve.max_rays = static_cast<int>(v); }, {0, -3}}};
    EXPECT_TRUE(check(good).empty());
    for (std::size_t i = 0; i < faults.size(); ++i)
        for (const double value : faults[i].second) {
            Scene scene = good;
            faults[i].first(scene, value);
            EXPECT_FALSE(check(scene).empty()) << "fault " << i << " at " << value;
        }
    Scene edge = good;
    edge.materials[0].reflectance = 1.0;
    edge.luminaires[0].power = 0;
    EXPECT_TRUE(check(edge).empty());
}

} // namespace
} // namespace lueur
