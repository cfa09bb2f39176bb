// Saving and loading again: the same scene, and after the first save the same bytes.
#include <random>

#include "core/display/display_fields.h"
#include "core/display/display_words.h"
#include "core/scene/units.h"
#include "scene_fixture.h"

namespace lueur {
namespace {

const std::string full_scene = R"(name = "Ümlaut \"and\" quotes \\"
units = "inch"
up = "z"

[[geometry]]
file = "models/box.obj"
units = "centimetre"
up = "y"

[[polygon]]
name = "floor"
material = "paint"
vertices = [[0, 0, 0.1], [39.37, 0, 0.1], [39.37, 100.1, 0.1], [0, 1e2, 0.1]]
uv = [[0, 1], [1, 1], [1, 0], [0, 0]]

[[polygon]]
name = "floor"
material = "paint"
vertices = [[0, 0, 7], [1, 0, 7], [0, 1, 7]]

[[material]]
name = "paint"
reflectance = { file = "spectra/paint.csv", column = "red" }
two_sided = true

[[material]]
name = "picture"
texture = "pictures/p.png"

[[material]]
name = "tinted picture"
texture = "pictures/p.png"
reflectance = [0.1, 0.2, 0.30000000000000004]

[[material]]
name = "unused"
reflectance = 1

[[luminaire]]
name = "lamp"
objects = ["floor"]
spectrum = { file = "spectra/paint.csv" }
power = { watt = 12.5 }
dimmer = 0.3333333333333333
side = "both"

[camera]
position = [1.1, -2.2, 3.3]
target = [0.1, 1e-7, 123456789]
up = [0, 1, 0.5]
vertical_fov_degrees = 39.3077
mirrored = true

[display]
max_display_rule = "lecture"
max_display = 1e11
percentile = 95.5
locked = false
operator = "filmic"
adaptation_auto = false
adaptation = 3.25
display_contrast = 200
filmic_white = 6.5
primaries = [0.61, 0.35, 0.29, 0.59, 0.15, 0.063, 0.28, 0.29]
white_luminance = 250
mark_clipped = true
mark_out_of_gamut = true
luminance_auto = false
luminance_low = 0.5
luminance_high = 500
luminance_log = false
luminance_isolines = false
illuminance_auto = false
illuminance_low = 5
illuminance_high = 5000
illuminance_levels = [100, 300.5, 500]
clip = "keep_chromaticity"
curve = "gamma"
gamma = [1.8, 2, 2.35]

[solve]
solver = "gauss_seidel"
form_factors = "point_to_disk"
form_factor_samples = 100
oracle = "flux"
link_tolerance = 0.25
matrix_memory = 2048
wavelengths = "rgb"
target_error = 0.001
element_size = 3.7
max_rays = 64
seed = 4294967295
)";

class RoundTrip : public SceneTest {
protected:
    void SetUp() override {
        SceneTest::SetUp();
        write("spectra/paint.csv", "wavelength_nm,red,blue\n400,0.1,0.9\n700,0.8,0.1\n");
        write_folder("pictures");
        write_picture("pictures/p.png", 2, {true, false, false, false});
        write("models/box.mtl", "newmtl grey\nKd 0.2 0.3 0.4\nnewmtl glow\nKd 0.5 0.5 0.5\nKe 1 2 3\nnewmtl hung\nKd "
                                "0.5 1 1\nmap_Kd ../pictures/p.png\n");
        write("models/box.obj",
              "mtllib box.mtl\nv 0 0 0\nv 100 0 0\nv 100 100 0\nv 0 100 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
              "o body\nusemtl grey\nf 1 2 3\nusemtl glow\nf 1 3 4\no canvas\nusemtl hung\nf 1/1 2/2 3/3\n");
    }
    void write_folder(const std::string& name) const { std::filesystem::create_directories(folder / name); }

    // Everything but the identity of the geometry.
    static void expect_same(Scene a, const Scene& b) {
        EXPECT_EQ(*a.geometry, *b.geometry);
        a.geometry = b.geometry;
        a.folder = b.folder;
        EXPECT_EQ(a, b);
    }
    void expect_stable(const Scene& scene, const std::string& first_name = "saved.toml") const {
        const auto first = folder / first_name, second = first.parent_path() / "again.toml";
        ASSERT_TRUE(save_scene(scene, first));
        const Scene loaded = load(first_name).scene;
        ASSERT_TRUE(save_scene(loaded, second));
        EXPECT_EQ(read(first), read(second));
    }
};

TEST_F(RoundTrip, AFullSceneIsEqualAndByteStable) {
    write("full.toml", full_scene);
    const Scene scene = load("full.toml").scene;
    EXPECT_EQ(scene.name, "Ümlaut \"and\" quotes \\");
    EXPECT_EQ(scene.objects.size(), 4u);    // body.grey, body.glow, canvas, floor
    EXPECT_EQ(scene.luminaires.size(), 2u); // lamp, and what Ke makes of body.glow
    // No setting of the display is at its default: what the writer forgets, the next comparison finds.
    visit_display_fields(scene.display, [usual = words_from_display({}),
                                         words = words_from_display(scene.display)](const char* key, const auto&...) {
        if (std::string(key) != "illuminance_log" && std::string(key) != "illuminance_isolines" &&
            std::string(key) != "luminance_levels") {
            EXPECT_NE(words.at(key), usual.at(key)) << key;
        }
    });
    ASSERT_TRUE(save_scene(scene, folder / "saved.toml"));
    const Scene again = load("saved.toml").scene;
    expect_same(scene, again);
    expect_stable(again);
}

TEST_F(RoundTrip, PathsFollowTheFileIntoAnotherFolder) {
    write("full.toml", full_scene);
    write_folder("elsewhere/deep");
    const Scene scene = load("full.toml").scene;
    expect_stable(scene, "elsewhere/deep/saved.toml");
    const Scene moved = load("elsewhere/deep/saved.toml").scene;
    EXPECT_EQ(*moved.geometry, *scene.geometry);
    EXPECT_EQ(std::get<SpectrumFile>(moved.materials[0].reflectance).path, "../../spectra/paint.csv");
    EXPECT_EQ(moved.materials[1].texture->path, "../../pictures/p.png");
}

TEST_F(RoundTrip, AnObjOpenedAsItIsSavesAsTomlThatNamesIt) {
    const Scene scene = load("models/box.obj").scene;
    ASSERT_EQ(scene.luminaires.size(), 1u);
    ASSERT_TRUE(save_scene(scene, folder / "box.toml"));
    const Scene again = load("box.toml").scene;
    ASSERT_EQ(again.luminaires.size(), 1u); // not doubled
    EXPECT_EQ(again.luminaires, scene.luminaires);
    EXPECT_EQ(again.objects, scene.objects);
    EXPECT_EQ(*again.geometry, *scene.geometry);
    expect_stable(scene);
}

TEST_F(RoundTrip, EditsOfImportedThingsAreKept) {
    Scene scene = load("models/box.obj").scene;
    const auto material = [&](const std::string& name) {
        for (std::size_t i = 0; i < scene.materials.size(); ++i)
            if (scene.materials[i].name == name) return MaterialIndex{static_cast<std::uint32_t>(i)};
        ADD_FAILURE() << name;
        return MaterialIndex{};
    };
    scene.materials[at(material("grey"))].reflectance = 0.9;
    scene.materials[at(material("hung"))].texture.reset(); // the picture is taken down
    scene.materials[at(material("hung"))].reflectance = Rgb(0.25, 0.5, 0.75);
    scene.materials.push_back({"own", 0.125, {}, false});
    scene.objects[0].material = MaterialIndex{static_cast<std::uint32_t>(scene.materials.size() - 1)};
    scene.luminaires.clear(); // and the lamp
    ASSERT_TRUE(save_scene(scene, folder / "models/edited.toml"));
    const Scene again = load("models/edited.toml").scene;
    EXPECT_EQ(again.materials, scene.materials);
    EXPECT_EQ(again.objects, scene.objects);
    EXPECT_TRUE(again.luminaires.empty());
    expect_stable(scene, "models/saved.toml");
}

TEST_F(RoundTrip, APolygonRepaintedInTheEditorIsKept) {
    write("full.toml", full_scene);
    Scene scene = load("full.toml").scene;
    for (Object& object : scene.objects)
        if (object.name == "floor") object.material = MaterialIndex{3};
    ASSERT_TRUE(save_scene(scene, folder / "saved.toml"));
    EXPECT_EQ(load("saved.toml").scene.objects, scene.objects);
}

TEST_F(RoundTrip, AnyCameraInAnyUnitComesBackExactly) {
    write("s.toml", small_scene);
    Scene scene = load("s.toml").scene;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(-10, 10);
    for (const LengthUnit length :
         {LengthUnit::metre, LengthUnit::centimetre, LengthUnit::millimetre, LengthUnit::foot, LengthUnit::inch})
        for (const UpAxis up : {UpAxis::y, UpAxis::z})
            for (int round = 0; round < 20; ++round) {
                scene.unit = length;
                scene.up = up;
                scene.camera.position = {unit(random), unit(random), unit(random)};
                scene.camera.target = {unit(random), unit(random), unit(random)};
                const glm::dvec3 back = world_from_file(file_from_world(scene.camera.position, length, up), length, up);
                for (int k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(back[k], scene.camera.position[k]);
                expect_stable(scene);
            }
}

TEST_F(RoundTrip, SavingFailsWithoutAHalfFile) {
    write("s.toml", small_scene);
    const Scene scene = load("s.toml").scene;
    EXPECT_THAT(save_scene(scene, folder / "no" / "s.toml").error(), testing::HasSubstr("folder is not there"));
    EXPECT_THAT(save_scene(scene, folder / "s.obj").error(), testing::HasSubstr(".toml only"));
    write_folder("taken.toml");
    EXPECT_THAT(save_scene(scene, folder / "taken.toml").error(), testing::HasSubstr("is a folder"));
    for (const auto& entry : std::filesystem::directory_iterator(folder)) EXPECT_NE(entry.path().extension(), ".part");
}

// The same room written in metres with Y up, and in millimetres with Z up: file (x, y, z) is world (x, z, -y).
TEST_F(SceneTest, MillimetresAndZUpEqualTheirTwinInMetresAndYUp) {
    const char* common = "material = \"m\"\n[[material]]\nname = \"m\"\nreflectance = 0.5\n[[luminaire]]\nname = "
                         "\"l\"\nobjects = [\"p\"]\npower = { lumen = 1 }\n";
    write("metre.toml", fmt::format("units = \"metre\"\n[solve]\nelement_size = 0.278\n[camera]\nposition = [0.278, "
                                    "0.273, -0.8]\ntarget = [0.1, 0.2, 0.3]\n"
                                    "[[polygon]]\nname = \"p\"\nvertices = [[0.5528, 0, 0], [0, 0, 0], [0, 0.001, "
                                    "0.5592], [0.5496, 0.3, 0.5592]]\n{}",
                                    common));
    write("mm.toml", fmt::format("units = \"millimetre\"\nup = \"z\"\n[solve]\nelement_size = 278\n[camera]\nposition "
                                 "= [278, 800, 273]\ntarget = [100, -300, 200]\n"
                                 "[[polygon]]\nname = \"p\"\nvertices = [[552.8, 0, 0], [0, 0, 0], [0, -559.2, 1], "
                                 "[549.6, -559.2, 300]]\n{}",
                                 common));
    const Scene metre = load("metre.toml").scene, millimetre = load("mm.toml").scene;
    EXPECT_EQ(*metre.geometry, *millimetre.geometry); // to the last bit
    EXPECT_EQ(metre.camera, millimetre.camera);
    EXPECT_EQ(metre.solve, millimetre.solve);
    EXPECT_EQ(metre.objects, millimetre.objects);
}

TEST(Units, MetresPer) {
    EXPECT_EQ(metres_per(LengthUnit::metre), 1);
    EXPECT_EQ(metres_per(LengthUnit::centimetre), 0.01);
    EXPECT_EQ(metres_per(LengthUnit::millimetre), 0.001);
    EXPECT_EQ(metres_per(LengthUnit::foot), 0.3048);
    EXPECT_EQ(metres_per(LengthUnit::inch), 0.0254);
    EXPECT_EQ(length_from_metres(0.278, LengthUnit::millimetre), 278);
}

} // namespace
} // namespace lueur
