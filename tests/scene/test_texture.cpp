// The mean of a texture over what a material covers; textures in scenes.
#include <cmath>

#include "core/scene/texture.h"
#include "scene_fixture.h"

namespace lueur {
namespace {

TextureImage picture(int width, int height, const auto& value) {
    TextureImage image{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.rgb.push_back(glm::vec3(value(x, y)));
    return image;
}

std::vector<Vertex> square_with_uv(glm::vec2 low, glm::vec2 high) {
    return {{{0, 0, 0}, glm::vec3(0), low},
            {{1, 0, 0}, glm::vec3(0), {high.x, low.y}},
            {{1, 1, 0}, glm::vec3(0), high},
            {{0, 1, 0}, glm::vec3(0), {low.x, high.y}}};
}
const std::vector<glm::uvec3> two_triangles{{0, 1, 2}, {0, 2, 3}};

TEST(MeanTexel, OfTheWholePartOrManyRepeats) {
    const TextureImage image =
        picture(64, 32, [](int x, int) { return x < 16 ? 1.f : 0.f; }); // the left quarter is white
    EXPECT_NEAR(mean_texel(image, square_with_uv({0, 0}, {1, 1}), two_triangles).r, 0.25, 0.005);
    EXPECT_NEAR(mean_texel(image, square_with_uv({0, 0}, {0.5, 1}), two_triangles).r, 0.5, 0.01);
    EXPECT_NEAR(mean_texel(image, square_with_uv({0.5, 0}, {1, 1}), two_triangles).r, 0, 1e-12);
    EXPECT_NEAR(mean_texel(image, square_with_uv({-2, 5}, {3, 9}), two_triangles).r, 0.25, 0.005);
    EXPECT_NEAR(mean_texel(image, square_with_uv({-0.75, 0}, {0.25, 1}), two_triangles).r, 0.25,
                0.005); // repeats across 0
    EXPECT_NEAR(mean_texel(image, square_with_uv({0, 0}, {500, 500}), two_triangles).r, 0.25, 0.02);
}

TEST(MeanTexel, OfLessThanATexelIsThatTexel) {
    const TextureImage image = picture(4, 4, [](int x, int y) { return x == 2 && y == 1 ? 0.75f : 0.f; });
    EXPECT_NEAR(mean_texel(image, square_with_uv({0.55, 0.3}, {0.7, 0.45}), two_triangles).g, 0.75, 1e-6);
    EXPECT_NEAR(mean_texel(image, square_with_uv({0.6, 0.4}, {0.6, 0.4}), two_triangles).g, 0.75,
                1e-6); // no uv area at all
}

TEST(MeanTexel,
     OfAFewTexelsIsExact) { // the triangle (0,0) (2,0) (0,2) covers 1, 1/2, 1/2 and 0 of four texels of 1, 2, 4, 8
    const TextureImage image = picture(2, 2, [](int x, int y) { return 0.1f * static_cast<float>(1 << (x + 2 * y)); });
    EXPECT_NEAR(mean_texel(image, square_with_uv({0, 0}, {1, 1}), std::vector<glm::uvec3>{{0, 1, 3}}).r,
                (0.1 * 1 + 0.2 * 0.5 + 0.4 * 0.5) / 2, 1e-6);
    EXPECT_NEAR(mean_texel(image, square_with_uv({-1, -1}, {1, 1}), two_triangles).r, 0.375, 1e-6);
}

TEST(MeanTexel, TrianglesWeighAsTheirAreaInTheScene) { // 3 m2 see white, 1 m2 sees black
    const TextureImage image = picture(32, 32, [](int x, int) { return x < 16 ? 1.f : 0.f; });
    std::vector<Vertex> vertices = square_with_uv({0.1, 0.1}, {0.4, 0.4});
    for (Vertex& vertex : vertices) vertex.position.x *= 3;
    for (Vertex vertex : square_with_uv({0.6, 0.1}, {0.9, 0.9})) vertices.push_back(vertex);
    EXPECT_NEAR(mean_texel(image, vertices, std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}).b,
                0.75, 1e-6);
}

TEST(MeanTexel, ASmoothPictureOverATriangle) { // of f = x over the triangle (0,0) (1,0) (0,1) the mean is 1/3
    const TextureImage image = picture(512, 512, [](int x, int) { return (static_cast<float>(x) + 0.5f) / 512; });
    EXPECT_NEAR(mean_texel(image, square_with_uv({0, 0}, {1, 1}), std::vector<glm::uvec3>{{0, 1, 3}}).r, 1.0 / 3, 1e-3);
}

TEST(MeanTexel, WithoutTrianglesItIsTheWholePicture) {
    const TextureImage image = picture(2, 2, [](int x, int y) { return x + y == 0 ? 1.f : 0.f; });
    EXPECT_NEAR(mean_texel(image, {}, {}).r, 0.25, 1e-12);
}

class TextureScene : public SceneTest {
protected:
    void SetUp() override {
        SceneTest::SetUp();
        write_picture("p.png", 4,
                      {true, false, false, false, true, false, false, false, true, false, false, false, true, false,
                       false, false});
        std::string text = small_scene;
        text.replace(text.find("reflectance = 0.5"), 17,
                     "reflectance = 0.5\n[[material]]\nname = \"hung\"\ntexture = \"p.png\"");
        text.replace(text.find("material = \"grey\""), 17,
                     "material = \"hung\"\nuv = [[0, 0], [0, 1], [1, 1], [1, 0]]");
        write("s.toml", text);
    }
};

TEST_F(TextureScene, ItsMeanIsTheReflectance) {
    const auto [scene, warnings] = load("s.toml");
    EXPECT_TRUE(warnings.empty()) << lines(warnings);
    const Material& hung = scene.materials.at(1);
    ASSERT_TRUE(hung.texture);
    EXPECT_EQ(hung.texture->path, "p.png");
    EXPECT_NEAR(std::get<Rgb>(hung.reflectance).r, 0.25, 1e-6);
    EXPECT_EQ(std::get<Rgb>(hung.reflectance), hung.texture->mean);
}

TEST_F(TextureScene, AnotherCanBeSetLive) {
    Scene scene = load("s.toml").scene;
    write_picture("q.png", 2, {true, true, true, false});
    const auto texture = load_texture(scene, "q.png");
    ASSERT_TRUE(texture) << texture.error();
    EXPECT_EQ(texture->path, "q.png");
    set_texture(scene, MaterialIndex{1}, *texture);
    EXPECT_NEAR(std::get<Rgb>(scene.materials[1].reflectance).g, 0.75, 1e-6);
    EXPECT_EQ(load_texture(scene, folder / "q.png")->path, "q.png"); // an absolute path is written as the scene would
    EXPECT_THAT(load_texture(scene, "no.png").error(), testing::HasSubstr("is not there"));
    EXPECT_THAT(load_texture(scene, ".").error(), testing::HasSubstr("is a folder"));
    write("broken.png", "not a picture");
    EXPECT_FALSE(load_texture(scene, "broken.png"));
}

TEST_F(TextureScene, WithoutTextureCoordinatesItIsTold) {
    std::string text = read(folder / "s.toml");
    text.erase(text.find("uv = "), std::string("uv = [[0, 0], [0, 1], [1, 1], [1, 0]]").size());
    write("n.toml", text);
    EXPECT_THAT(lines(load("n.toml").warnings),
                testing::HasSubstr("material \"hung\" has a texture, but what it covers has no texture coordinates"));
}

} // namespace
} // namespace lueur
