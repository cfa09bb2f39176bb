// OBJ and MTL, opened as they are and from a scene file.
#include "core/scene/luminaire.h"
#include "scene_fixture.h"

namespace lueur {
namespace {

using testing::HasSubstr;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(SceneTest, ObjMaterialsGiveReflectanceAndEmission) {
    write("m.mtl", "# paints\nnewmtl red paint\n Kd 0.8 0.1 +0.05\nnewmtl lamp\nKd 0.5\nKe 3 2 1\n");
    write("m.obj",
          "mtllib m.mtl\n" + square + "o wall\nusemtl red paint\nf 1 2 3 4\no light\nusemtl lamp\nf 4 3 2 1\n");
    const auto [scene, warnings] = load("m.obj");
    EXPECT_TRUE(warnings.empty()) << lines(warnings);
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[0].name, "wall");
    EXPECT_EQ(scene.materials[0], (Material{"red paint", Rgb(0.8, 0.1, 0.05), {}, true}));
    EXPECT_EQ(scene.materials[1], (Material{"lamp", Rgb(0.5), {}, true}));
    ASSERT_EQ(scene.luminaires.size(), 1u);
    Luminaire expected{"light", {ObjectIndex{1}}, Rgb(3, 2, 1), PowerUnit::radiance, 1, 1, EmitSide::front};
    EXPECT_EQ(scene.luminaires[0], expected);
}

TEST_F(SceneTest, ObjIndicesFromTheEndAndTextureCoordinatesUpwards) {
    write("m.obj", square + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 2\nf -4/-3/-1 -3/-2/-1 -2/-1/-1\n");
    const Geometry geometry = *load("m.obj").scene.geometry;
    ASSERT_EQ(geometry.vertices.size(), 3u);
    EXPECT_EQ(geometry.vertices[0].uv, glm::vec2(0, 1)); // ours counts v downwards
    EXPECT_EQ(geometry.vertices[2].uv, glm::vec2(1, 0));
    EXPECT_EQ(geometry.vertices[1].position, glm::vec3(1, 0, 0));
}

TEST_F(SceneTest, ObjTakesTheUnitsAndAxesThatTheSceneFileSays) {
    write("m.obj", "v 0 0 0\nv 1000 0 0\nv 1000 0 2000\nv 0 0 2000\nf 1 2 3 4\n");
    const std::string rest = "[[luminaire]]\nname = \"l\"\nobjects = [\"m\"]\npower = { lumen = 1 }\n";
    write("a.toml", "units = \"millimetre\"\nup = \"z\"\n[[geometry]]\nfile = \"m.obj\"\n" + rest);
    write("b.toml", "units = \"metre\"\n[[geometry]]\nfile = \"m.obj\"\nunits = \"millimetre\"\nup = \"z\"\n" + rest);
    const Scene a = load("a.toml").scene, b = load("b.toml").scene;
    EXPECT_EQ(*a.geometry, *b.geometry);
    EXPECT_NEAR(surface_area(*a.geometry, ObjectIndex{0}), 2, 1e-6);
    EXPECT_EQ(a.geometry->vertices[0].position, glm::vec3(0, 0, 0));
    for (const Vertex& vertex : a.geometry->vertices) EXPECT_EQ(vertex.position.z, 0); // it stands upright
    const glm::dvec3 n = normal_of(*a.geometry, 0);
    EXPECT_NEAR(n.z, 1, 1e-9); // -y of the file
}

TEST_F(SceneTest, ObjWithoutMaterialsIsGreyAndTwoSided) {
    write("m.obj", square + "f 1 2 3 4\n");
    const auto [scene, warnings] = load("m.obj");
    EXPECT_EQ(scene.materials.at(0), (Material{"default", 0.5, {}, true}));
    EXPECT_EQ(scene.objects.at(0).name, "m");
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_THAT(warnings[0], HasSubstr("nothing emits; the picture will be black"));
}

TEST_F(SceneTest, ObjWithoutItsMtlOrTextureIsToldAndKeepsItsColour) {
    write("m.mtl", "newmtl a\nKd 0.25 0.5 0.75\nmap_Kd no.png\n");
    write("m.obj", "mtllib m.mtl other.mtl\n" + square + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n");
    const auto [scene, warnings] = load("m.obj");
    const std::string all = lines(warnings);
    EXPECT_THAT(all, HasSubstr("m.obj:1:14: material file \"other.mtl\" is not there"));
    EXPECT_THAT(all, HasSubstr("m.obj:6:1: texture of material \"a\" left out"));
    EXPECT_THAT(all, HasSubstr("m.obj:8:1: material \"b\" is in none"));
    EXPECT_EQ(scene.materials.at(0).reflectance, Reflectance(Rgb(0.25, 0.5, 0.75)));
    EXPECT_FALSE(scene.materials.at(0).texture);
    EXPECT_EQ(scene.materials.at(1).reflectance, Reflectance(0.5));
}

TEST_F(SceneTest, ObjPolygonsAreCutRight) { // an L: 3 m2, all facing +z
    write("m.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n");
    const Geometry geometry = *load("m.obj").scene.geometry;
    EXPECT_EQ(geometry.triangles.size(), 4u);
    EXPECT_EQ(geometry.surfaces.size(), 1u);
    EXPECT_NEAR(surface_area(geometry, ObjectIndex{0}), 3, 1e-6);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(normal_of(geometry, i).z, 1, 1e-9);
}

TEST_F(SceneTest, ObjGroupsWithSeveralMaterialsBecomeSeveralObjects) {
    write("m.mtl", "newmtl a\nKd 0.1\nnewmtl b\nKd 0.2\n");
    write("m.obj",
          "mtllib m.mtl\n" + square + "g room\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\ng room.a\nusemtl a\nf 1 2 4\n");
    const Scene scene = load("m.obj").scene;
    ASSERT_EQ(scene.objects.size(), 3u);
    EXPECT_EQ(scene.objects[0].name, "room.a");
    EXPECT_EQ(scene.objects[1].name, "room.b");
    EXPECT_EQ(scene.objects[2].name, "room.a 2"); // names are unique
}

TEST_F(SceneTest, ObjLinesContinueAndCommentsEnd) {
    write("m.obj",
          "\xef\xbb\xbf# byte order mark\r\nv 0 0 \\\r\n0\r\nv 1 0 0 # right\r\nv 1 1 0 1.0\r\n\r\nf 1 \\\n2 3");
    EXPECT_NEAR(surface_area(*load("m.obj").scene.geometry, ObjectIndex{0}), 0.5, 1e-7);
}

TEST_F(SceneTest, ObjNamesThatAreNotUtf8CanBeSaved) {
    write("m.obj", square + "o M\xfc"
                            "ller\nf 1 2 3 4\n");
    const Scene scene = load("m.obj").scene;
    EXPECT_EQ(scene.objects.at(0).name, "Müller");
    ASSERT_TRUE(save_scene(scene, folder / "m.toml"));
    EXPECT_EQ(load("m.toml").scene.objects, scene.objects);
}

TEST_F(SceneTest, ObjPointsAndLinesAreToldAndLeftOut) {
    write("m.obj", square + "f 1 2 3\nl 1 2\np 4\n");
    EXPECT_THAT(lines(load("m.obj").warnings), HasSubstr("2 lines and points left out"));
    write("cloud.obj", square);
    EXPECT_THAT(lines(errors_of("cloud.obj")), HasSubstr("cloud.obj: is a point cloud"));
}

TEST_F(SceneTest, DegenerateFacesAreToldAndNothingLeftIsAnError) {
    write("m.obj", square + "f 1 2 3\nf 1 2 2\nf 1 1 1\n");
    EXPECT_THAT(lines(load("m.obj").warnings), HasSubstr("object \"m\": 2 degenerate triangles left out"));
    write("none.obj", square + "f 1 2 2\n");
    EXPECT_THAT(lines(errors_of("none.obj")), HasSubstr("no triangle with an area is left"));
}

struct BadObj {
    std::string text, phrase;
};

TEST_F(SceneTest, BadObjFilesAreToldWithTheirPlace) {
    for (const BadObj& bad : std::vector<BadObj>{
             {"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "bad.obj:2:3: nan is not a finite number"},
             {"v 0 0 0\nv 1 -inf 0\nv 0 1 0\nf 1 2 3\n", "bad.obj:2:5: -inf is not a finite number"},
             {"v 0 0 0\nv 1 1e999 0\nv 0 1 0\nf 1 2 3\n", "bad.obj:2:5: 1e999 is not a finite number"},
             {"v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n", "bad.obj:2:5: \"zero\" is not a number"},
             {"v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n", "bad.obj:2:1: v has 2 numbers; 3 are needed"},
             {square + "f 1 2 9\n", "bad.obj:5:7: the face names vertex 9; 1..4 or -4..-1 is allowed"},
             {square + "f 1 2 0\n", "bad.obj:5:7: the face names vertex 0"},
             {square + "f 1 2 -5\n", "bad.obj:5:7: the face names vertex -5"},
             {square + "f 1/1 2/1 3/1\n", "bad.obj:5:3: the face names texture coordinate 1; the file has none"},
             {square + "vn 0 0 1\nf 1//1 2//2 3//1\n", "bad.obj:6:8: the face names normal 2"},
             {square + "f 1 2 x\n", "bad.obj:5:7: \"x\" is not a corner"},
             {square + "f 1 2\n", "bad.obj:5:1: a face of 2 corners"},
             {"mtllib bad.mtl\n" + square + "usemtl a\nf 1 2 3\n",
              "bad.mtl:2:4: Kd 1.5 is out of range; 0..1 is allowed"},
             {"mtllib bad.mtl\n" + square + "usemtl a\nf 1 2 3\n",
              "bad.mtl:4:8: Kd -0.5 is out of range; 0..1 is allowed"},
             {"mtllib bad.mtl\n" + square + "usemtl a\nf 1 2 3\n", "bad.mtl:5:4: Ke -1 is out of range; 0 or more"},
             {"mtllib bad.mtl\n" + square + "usemtl a\nf 1 2 3\n", "bad.mtl:6:4: Kd spectral is not supported"}}) {
        write("bad.mtl", "newmtl a\nKd 1.5 0 0\nnewmtl b\nKd 0.5 -0.5 nan\nKe -1\nKd spectral x.rfl\n");
        write("bad.obj", bad.text);
        bool told = false;
        for (const std::string& error : errors_of("bad.obj"))
            told = told || error.find(bad.phrase) != std::string::npos;
        EXPECT_TRUE(told) << bad.phrase << "\n" << lines(errors_of("bad.obj"));
    }
}

TEST_F(SceneTest, AMillionWrongLinesAreCutShort) {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "v nan 0 0\n";
    write("bad.obj", text + "f 1 2 3\n");
    const auto errors = errors_of("bad.obj");
    ASSERT_EQ(errors.size(), 51u);
    EXPECT_THAT(errors.back(), HasSubstr("and 950 more errors"));
}

// What a scene file says of imported things goes before what they say themselves.
TEST_F(SceneTest, TheSceneFileOverridesImportedMaterialsAndLuminaires) {
    write("m.mtl", "newmtl a\nKd 0.1\nnewmtl glow\nKd 0.5\nKe 1 1 1\n");
    write("m.obj",
          "mtllib m.mtl\n" + square + "o wall\nusemtl a\nf 1 2 3 4\no lamp\nusemtl glow\nf 1 2 3\no spot\nf 1 3 4\n");
    write("s.toml", R"(units = "metre"
[[geometry]]
file = "m.obj"
[[object]]
name = "wall"
material = "new"
[[material]]
name = "glow"
two_sided = false
[[material]]
name = "new"
reflectance = 0.9
[[luminaire]]
name = "mine"
objects = ["lamp"]
power = { lumen = 100 }
)");
    const Scene scene = load("s.toml").scene;
    ASSERT_EQ(scene.luminaires.size(), 2u); // the lamp is mine; the spot stays as the file has it
    EXPECT_EQ(scene.luminaires[0].name, "mine");
    EXPECT_EQ(scene.luminaires[1].name, "spot");
    const auto lit = luminaire_of_objects(scene);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Material& material = scene.materials[at(scene.objects[i].material)];
        if (scene.objects[i].name == "wall") {
            EXPECT_EQ(material.reflectance, Reflectance(0.9));
            EXPECT_FALSE(lit[i]);
        } else {
            EXPECT_EQ(material, (Material{"glow", Rgb(0.5), {}, false})); // only the key given changed
            EXPECT_TRUE(lit[i]);
        }
    }
}

} // namespace
} // namespace lueur
