// Damaged files: whatever bytes change, loading ends with a scene or with errors that name the file.
#include <random>

#include "scene_fixture.h"
#include "tests/support/mutated.h"

namespace lueur {
namespace {

const std::string likely = "0123456789-.e[]{}\"=,\n nif/\\#";

class Mutations : public SceneTest {
protected:
    void survive(const std::string& name, const std::string& text) const {
        std::mt19937 random(20240501);
        int loaded = 0, refused = 0;
        for (int round = 0; round < 500; ++round) {
            const auto file = write(name, test::mutated(text, likely, random));
            const auto result = load_scene(file);
            if (result) {
                ++loaded;
                for (const glm::uvec3& t : result->scene.geometry->triangles)
                    ASSERT_LT(std::max({t.x, t.y, t.z}), result->scene.geometry->vertices.size());
                const std::string saved = scene_to_toml(result->scene, folder);
                write("saved.toml", saved);
                EXPECT_TRUE(load_scene(folder / "saved.toml")) << saved;
            } else {
                ++refused;
                ASSERT_FALSE(result.error().empty());
                for (const std::string& error : result.error())
                    EXPECT_TRUE(error.starts_with(folder.string())) << error;
            }
        }
        EXPECT_GT(loaded, 5);
        EXPECT_GT(refused, 20);
    }
};

TEST_F(Mutations, OfATomlScene) {
    survive("m.toml", small_scene + "side = \"both\"\n[camera]\nposition = [0, 1, 4]\ntarget = [0, 1, "
                                    "0]\n[display]\ngamma = 2.2\n[solve]\nwavelengths = \"rgb\"\n");
}

TEST_F(Mutations, OfAnObj) {
    write("m.mtl", "newmtl a\nKd 0.5 0.5 0.5\nKe 1 1 1\n");
    survive("m.obj", "mtllib m.mtl\no box\nv -0.5 -0.5 0.5\nv -0.5 -0.5 -0.5\nv -0.5 0.5 -0.5\nv -0.5 0.5 0.5\nv 0.5 "
                     "-0.5 0.5\nv 0.5 -0.5 -0.5\nv 0.5 0.5 -0.5\nv 0.5 0.5 0.5\n"
                     "vt 0 0\nvt 1 0\nvn 0 0 1\nusemtl a\nf 4 3 2 1\nf 2 6 5 1\nf 3/1 7/2 6/1 2/2\nf 8//1 7//1 3//1 "
                     "4//1\nf 5/1/1 8/2/1 4/1/1\nf -1 -2 -3\n");
}

TEST_F(Mutations, OfAnMtl) {
    write("s.obj", "mtllib s.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    const std::string text = "newmtl a\nKd 0.5 0.5 0.5\nKe 1 1 1\nmap_Kd -s 1 1 1 a b.png\nd 0.5\nnewmtl b\nKd 0.25\n";
    std::mt19937 random(99);
    for (int round = 0; round < 500; ++round) {
        write("s.mtl", test::mutated(text, likely, random));
        const auto result = load_scene(folder / "s.obj");
        if (result) continue;
        for (const std::string& error : result.error()) EXPECT_TRUE(error.starts_with(folder.string())) << error;
    }
}

} // namespace
} // namespace lueur
