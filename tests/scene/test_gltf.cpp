// glTF: node transforms, winding, sides, emission, textures, cameras. The files are written here.
#include <cmath>
#include <cstring>

#include "scene_fixture.h"

namespace lueur {
namespace {

using testing::HasSubstr;

std::string base64(const std::string& bytes) { // RFC 4648
    static const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) result += i + k > bytes.size() ? '=' : letters[group >> (18 - 6 * k) & 63u];
    }
    return result;
}

template <typename Number>
std::string bytes_of(const std::vector<Number>& numbers) {
    std::string bytes(numbers.size() * sizeof(Number), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
}

std::string square_buffer() {
    return bytes_of<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) +
           bytes_of<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}) + bytes_of<float>({0, 0, 1, 0, 1, 1, 0, 1}) +
           bytes_of<std::uint16_t>({0, 1, 2, 0, 2, 3});
}

// One unit square in the plane z = 0 that looks to +z, as mesh 0 (material 0); uv (0,0) at its lower left is the
// picture's top left.
std::string gltf(const std::string& nodes, const std::string& materials, const std::string& more = "",
                 const std::string& extensions = "") {
    const std::string buffer = square_buffer();
    return fmt::format(R"({{"asset":{{"version":"2.0"}},{}"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{}],
"meshes":[{{"name":"square","primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}},"indices":3,"material":0}}]}}],
"materials":[{}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
{{"bufferView":1,"componentType":5126,"count":4,"type":"VEC3"}},{{"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"}},
{{"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"}}],
"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":48}},
{{"buffer":0,"byteOffset":96,"byteLength":32}},{{"buffer":0,"byteOffset":128,"byteLength":12}}],
"buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{}"}}]{}}})",
                       extensions, nodes, materials, buffer.size(), base64(buffer), more);
}

const std::string plain_node = R"({"name":"thing","mesh":0})";
std::string paint(const std::string& more = "") { // red, not metal
    return R"({"name":"paint","pbrMetallicRoughness":{"baseColorFactor":[0.75,0.5,0.25,1],"metallicFactor":0})" + more +
           "}";
}

// The same file as .glb: a chunk of JSON and one of the buffer.
std::string glb(std::string json) {
    const std::size_t uri = json.find(",\"uri\"");
    json.erase(uri, json.find('}', uri) - uri);
    while (json.size() % 4) json += ' ';
    const std::string buffer = square_buffer();
    const auto word = [](std::size_t number) { return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(number)}); };
    return "glTF" + word(2) + word(28 + json.size() + buffer.size()) + word(json.size()) + "JSON" + json +
           word(buffer.size()) + std::string("BIN\0", 4) + buffer;
}

TEST_F(SceneTest, GltfPlain) {
    write("m.gltf", gltf(plain_node, paint()));
    const auto [scene, warnings] = load("m.gltf");
    ASSERT_EQ(warnings.size(), 1u) << lines(warnings);
    EXPECT_THAT(warnings[0], HasSubstr("nothing emits"));
    EXPECT_EQ(scene.objects.at(0).name, "thing");
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.name, "paint");
    EXPECT_FALSE(material.two_sided);
    EXPECT_EQ(material.reflectance, Reflectance(Rgb(0.75, 0.5, 0.25)));
    ASSERT_EQ(scene.geometry->surfaces.size(), 1u);
    EXPECT_TRUE(scene.geometry->surfaces[0].planar);
    EXPECT_NEAR(normal_of(*scene.geometry, 0).z, 1, 1e-6);
    for (const Vertex& vertex : scene.geometry->vertices)
        EXPECT_EQ(vertex.uv, glm::vec2(vertex.position)); // as in the file
    write("m.glb", glb(gltf(plain_node, paint())));
    EXPECT_EQ(*load("m.glb").scene.geometry, *scene.geometry);
}

// Parent: moved by (10, 0, 0). Child: turned by 90 degrees about x (z -> -y, y -> z), then scaled by 2, 3, 1 inside.
TEST_F(SceneTest, GltfNodeTransforms) {
    write("m.gltf", gltf(R"({"name":"parent","translation":[10,0,0],"children":[1]},
{"name":"child","mesh":0,"rotation":[0.70710678,0,0,0.70710678],"scale":[2,3,1]})",
                         paint()));
    const Geometry geometry = *load("m.gltf").scene.geometry;
    EXPECT_NEAR(surface_area(geometry, ObjectIndex{0}), 6, 1e-5);
    EXPECT_NEAR(normal_of(geometry, 0).y, -1, 1e-6);
    glm::vec3 low(1e9f), high(-1e9f);
    for (const Vertex& vertex : geometry.vertices) {
        low = glm::min(low, vertex.position);
        high = glm::max(high, vertex.position);
    }
    EXPECT_NEAR(glm::distance(low, glm::vec3(10, 0, 0)), 0, 1e-5);
    EXPECT_NEAR(glm::distance(high, glm::vec3(12, 0, 3)), 0, 1e-5);
}

TEST_F(SceneTest, GltfMirroredNodesKeepTheirFront) { // x -> -x: the square still looks to +z; z -> -z: it looks to -z
    write("x.gltf", gltf(R"({"mesh":0,"scale":[-1,1,1]})", paint()));
    EXPECT_NEAR(normal_of(*load("x.gltf").scene.geometry, 0).z, 1, 1e-6);
    write("z.gltf", gltf(R"({"mesh":0,"scale":[1,1,-1]})", paint()));
    EXPECT_NEAR(normal_of(*load("z.gltf").scene.geometry, 0).z, -1, 1e-6);
    write("m.gltf", gltf(R"({"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]})", paint()));
    const Geometry geometry = *load("m.gltf").scene.geometry;
    EXPECT_NEAR(normal_of(geometry, 0).z, 1, 1e-6);
    EXPECT_TRUE(geometry.surfaces.at(0).planar); // its normals turned with it
}

TEST_F(SceneTest, GltfInstancesAreObjectsWithNamesOfTheirOwn) {
    write(
        "m.gltf",
        gltf(
            R"({"name":"room","children":[1,2]},{"name":"lamp","mesh":0},{"name":"lamp","mesh":0,"translation":[0,0,1]})",
            paint()));
    const Scene scene = load("m.gltf").scene;
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_NE(scene.objects[0].name, scene.objects[1].name);
    EXPECT_EQ(scene.objects[0].material, scene.objects[1].material);
    EXPECT_EQ(scene.geometry->surfaces.size(), 2u);
}

TEST_F(SceneTest, GltfSidesAndEmission) {
    write("one.gltf", gltf(plain_node, paint(R"(,"emissiveFactor":[1,0.5,0.25])")));
    const Scene one = load("one.gltf").scene;
    ASSERT_EQ(one.luminaires.size(), 1u);
    EXPECT_EQ(one.luminaires[0],
              (Luminaire{"thing", {ObjectIndex{0}}, Rgb(1, 0.5, 0.25), PowerUnit::radiance, 1, 1, EmitSide::front}));
    write(
        "two.gltf",
        gltf(
            plain_node,
            paint(
                R"(,"doubleSided":true,"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":40}})"),
            "", R"("extensionsUsed":["KHR_materials_emissive_strength"],)"));
    const Scene two = load("two.gltf").scene;
    EXPECT_TRUE(two.materials.at(0).two_sided);
    ASSERT_EQ(two.luminaires.size(), 1u);
    EXPECT_EQ(two.luminaires[0].spectrum, EmissionSpectrum(Rgb(40)));
    EXPECT_EQ(two.luminaires[0].side, EmitSide::both);
}

const std::string textured =
    R"({"name":"paint","pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,1],"metallicFactor":0,"baseColorTexture":{"index":0}}})";
std::string images(const std::string& uri) {
    return R"(,"textures":[{"source":0}],"images":[{"uri":")" + uri + "\"}]";
}

TEST_F(SceneTest, GltfTexturesInsideAndBeside) {
    write_picture("p.png", 2, {true, false, true, false}); // the left half is white
    for (const bool inside : {true, false}) {
        write("m.gltf", gltf(plain_node, textured,
                             images(inside ? "data:image/png;base64," + base64(read(folder / "p.png")) : "p.png")));
        const Scene scene = load("m.gltf").scene;
        const Material& material = scene.materials.at(0);
        ASSERT_TRUE(material.texture) << inside;
        EXPECT_EQ(material.texture->path, inside ? "m.gltf*0" : "p.png");
        const Rgb reflectance = std::get<Rgb>(material.reflectance); // mean times base colour
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(material.texture->mean[k], 0.5, 1e-6);
            EXPECT_NEAR(reflectance[k], material.texture->mean[k] * std::pow(0.5, k), 1e-12);
        }
        ASSERT_TRUE(save_scene(scene, folder / "saved.toml"));
        const Scene again = load("saved.toml").scene;
        EXPECT_EQ(again.materials, scene.materials);
        ASSERT_TRUE(again.materials.at(0).texture);
        EXPECT_EQ(*again.materials[0].texture->image, *material.texture->image);
        ASSERT_TRUE(save_scene(again, folder / "again.toml"));
        EXPECT_EQ(read(folder / "saved.toml"), read(folder / "again.toml"));
    }
}

TEST_F(SceneTest, GltfMissingTextureIsToldAndKeepsTheBaseColour) {
    write("m.gltf", gltf(plain_node, textured, images("no.png")));
    const auto [scene, warnings] = load("m.gltf");
    EXPECT_THAT(lines(warnings), HasSubstr("texture of material \"paint\" left out"));
    EXPECT_EQ(scene.materials.at(0).reflectance, Reflectance(Rgb(1, 0.5, 0.25)));
}

TEST_F(SceneTest, GltfWhatIsNotModelledIsTold) {
    write(
        "m.gltf",
        gltf(
            plain_node,
            R"({"name":"gold","alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,0.5],"metallicFactor":1}})"));
    const std::string warnings = lines(load("m.gltf").warnings);
    EXPECT_THAT(warnings, HasSubstr("material \"gold\" is a metal"));
    EXPECT_THAT(warnings, HasSubstr("material \"gold\" is transparent"));
}

TEST_F(SceneTest, GltfCameraIsTaken) {
    write(
        "m.gltf",
        gltf(
            R"({"name":"room","children":[1,2]},{"name":"thing","mesh":0},{"name":"eye","camera":0,"translation":[1,2,3]})",
            paint(),
            R"(,"cameras":[{"name":"lens","type":"perspective","perspective":{"yfov":0.8,"aspectRatio":1.5,"znear":0.1}}])"));
    const Camera camera = load("m.gltf").scene.camera;
    EXPECT_NEAR(glm::distance(camera.position, glm::dvec3(1, 2, 3)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(glm::normalize(camera.target - camera.position), glm::dvec3(0, 0, -1)), 0, 1e-6);
    EXPECT_NEAR(camera.vertical_fov_degrees, 0.8 * 180 / M_PI, 1e-3);
}

TEST_F(SceneTest, GltfKeepsItsOwnUnitsInAMillimetreScene) {
    write("m.gltf", gltf(plain_node, paint()));
    write("s.toml", "units = \"millimetre\"\nup = \"z\"\n[[geometry]]\nfile = \"m.gltf\"\n[[luminaire]]\nname = "
                    "\"l\"\nobjects = [\"thing\"]\npower = { lumen = 1 }\n");
    EXPECT_EQ(*load("s.toml").scene.geometry, *load("m.gltf").scene.geometry);
    write("t.toml", "units = \"metre\"\n[[geometry]]\nfile = \"m.gltf\"\nunits = \"inch\"\n");
    EXPECT_THAT(lines(errors_of("t.toml")), HasSubstr("t.toml:4:9: units is for .obj only"));
}

TEST_F(SceneTest, BadGltfFilesAreTold) {
    write("cut.gltf", "{\n  \"asset\": {,\n");
    EXPECT_THAT(lines(errors_of("cut.gltf")), HasSubstr("cut.gltf:2:13: is not JSON here"));
    write("list.gltf", "[1, 2]");
    EXPECT_THAT(lines(errors_of("list.gltf")), HasSubstr("list.gltf: is not a JSON object"));
    write("old.glb", std::string("glTF\1\0\0\0\x14\0\0\0\0\0\0\0\0\0\0\0", 20));
    EXPECT_THAT(lines(errors_of("old.glb")), HasSubstr("version 1; version 2 is allowed"));
    write("cut.glb", glb(gltf(plain_node, paint())).substr(0, 300));
    EXPECT_THAT(lines(errors_of("cut.glb")), HasSubstr("is cut off"));
    write(
        "buffer.gltf",
        R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"no.bin"}],"scenes":[{"nodes":[]}],"scene":0})");
    EXPECT_THAT(lines(errors_of("buffer.gltf")), HasSubstr("buffer.gltf: "));
    write("bright.gltf",
          gltf(plain_node,
               R"({"name":"paint","pbrMetallicRoughness":{"baseColorFactor":[1.5,0,0,1],"metallicFactor":0}})"));
    EXPECT_THAT(lines(errors_of("bright.gltf")), HasSubstr("material \"paint\": base colour 1.5 is out of range"));
}

} // namespace
} // namespace lueur
