// Every fault of a scene file is told with its place and what is allowed; all of them in one go.
#include "scene_fixture.h"

namespace lueur {
namespace {

using testing::HasSubstr;

struct BadFile {
    const char* what;
    std::string text;
    std::string place; // ":LINE:COLUMN:" or ":" for the file as a whole
    std::string phrase;
};

void PrintTo(const BadFile& bad, std::ostream* stream) {
    *stream << bad.what;
}

// small_scene with `from` replaced.
std::string changed(const std::string& from, const std::string& to) {
    std::string text = small_scene;
    const std::size_t found = text.find(from);
    EXPECT_NE(found, std::string::npos) << from;
    return text.replace(found, from.size(), to);
}

class BadToml : public SceneTest, public testing::WithParamInterface<BadFile> {};

TEST_P(BadToml, IsToldWithItsPlace) {
    const BadFile& bad = GetParam();
    write("paint.csv", "wavelength_nm,good,over\n400,0.5,0.5\n700,0.5,1.5\n");
    write("lamp.csv", "wavelength_nm,negative\n400,1\n700,-1\n");
    std::filesystem::create_directories(folder / "a_folder");
    const auto file = write("bad.toml", bad.text);
    const std::vector<std::string> errors = errors_of("bad.toml");
    ASSERT_EQ(errors.size(), 1u) << bad.what << ": " << lines(errors);
    EXPECT_TRUE(errors[0].starts_with(file.string() + bad.place)) << bad.what << ": " << errors[0];
    EXPECT_THAT(errors[0], HasSubstr(bad.phrase)) << bad.what;
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadToml,
    testing::Values(
        BadFile{"syntax", "units = \"metre\"\nup = y\n", ":2:6:", "TOML"}, BadFile{"empty", "", ": ", "is empty"},
        BadFile{"blank", " \n\n", ": ", "is empty"},
        BadFile{"nothing in it", "units = \"metre\"\n", ": ", "at least one [[geometry]] or [[polygon]]"},
        BadFile{"no units", changed("units = \"metre\"\n", ""), ":1:1:", "metre, centimetre, millimetre, foot, inch"},
        BadFile{"unit unknown", changed("\"metre\"", "\"meter\""), ":2:9:", "did you mean \"metre\""},
        BadFile{"up unknown", changed("units = \"metre\"", "units = \"metre\"\nup = \"x\""), ":3:6:", "allowed: y, z"},
        BadFile{"unknown key at the top", changed("name = \"small\"", "nome = \"small\""),
                ":1:1:", "did you mean \"name\""},
        BadFile{"unknown key in a material", changed("reflectance = 0.5", "reflectance = 0.5\nrougness = 1"),
                ":17:1:", "has no key \"rougness\""},
        BadFile{"key of a luminaire misspelt", changed("power =", "dimer = 0.5\npower ="),
                ":21:1:", "did you mean \"dimmer\""},
        BadFile{"name is a number", changed("name = \"small\"", "name = 5"), ":1:8:", "name is an integer"},
        BadFile{"polygon is a table", "units = \"metre\"\n[polygon]\nname = \"x\"\n", ":2:1:", "[[polygon]]"},
        BadFile{"polygon has no name", changed("name = \"floor\"\n", ""), ":4:1:", "[[polygon]] has no name"},
        BadFile{"polygon's name is empty", changed("\"floor\"", "\"\""), ":5:8:", "name is empty"},
        BadFile{"material unknown", changed("material = \"grey\"", "material = \"gray\""),
                ":6:12:", "did you mean \"grey\""},
        BadFile{"two vertices", changed("[[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]]", "[[0, 0, 0], [0, 0, 1]]"),
                ":7:12:", "at least 3 points"},
        BadFile{"no area", changed("[[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]]", "[[0, 0, 0], [0, 0, 1], [0, 0, 2]]"),
                ":7:12:", "has no area"},
        BadFile{"crosses itself",
                changed("[[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]]", "[[0,0,0],[0,0,3],[1,0,3],[1,0,1],[-1,0,1]]"),
                ":7:12:", "crosses itself"},
        BadFile{"a vertex of two numbers", changed("[0, 0, 1]", "[0, 0]"), ":7:24:", "an array of 3 numbers"},
        BadFile{"a vertex is not a number", changed("[0, 0, 1]", "[0, 0, nan]"), ":7:31:", "not finite"},
        BadFile{"a vertex is infinite", changed("[0, 0, 1]", "[0, 0, -inf]"), ":7:31:", "not finite"},
        BadFile{"a vertex is a text", changed("[0, 0, 1]", "[0, 0, \"1\"]"), ":7:31:", "is a text"},
        BadFile{"uv count", changed("[1, 0, 0]]", "[1, 0, 0]]\nuv = [[0, 0]]"), ":8:6:", "here 4"},
        BadFile{"material twice", small_scene + "[[material]]\nname = \"grey\"\nreflectance = 1\n", ":23:8:", "twice"},
        BadFile{"material without reflectance", changed("reflectance = 0.5\n", ""), ":15:8:", "has no reflectance"},
        BadFile{"reflectance above 1", changed("reflectance = 0.5", "reflectance = 1.01"),
                ":16:15:", "0..1 is allowed"},
        BadFile{"reflectance below 0", changed("reflectance = 0.5", "reflectance = [0.5, -0.1, 0.5]"),
                ":16:21:", "0..1 is allowed"},
        BadFile{"reflectance of 2 numbers", changed("reflectance = 0.5", "reflectance = [0.5, 0.1]"),
                ":16:15:", "an array of 3 numbers"},
        BadFile{"reflectance is true", changed("reflectance = 0.5", "reflectance = true"), ":16:15:", "[r, g, b]"},
        BadFile{"reflectance file missing", changed("reflectance = 0.5", "reflectance = { file = \"no.csv\" }"),
                ":16:24:", "is not there"},
        BadFile{"reflectance in the file above 1",
                changed("reflectance = 0.5", "reflectance = { file = \"paint.csv\", column = \"over\" }"),
                ":16:15:", "1.5 at 700 nm"},
        BadFile{"spectrum key unknown",
                changed("reflectance = 0.5", "reflectance = { file = \"paint.csv\", colum = \"good\" }"),
                ":16:37:", "did you mean \"column\""},
        BadFile{"texture missing", changed("reflectance = 0.5", "texture = \"no.png\""), ":16:11:", "is not there"},
        BadFile{"texture is a folder", changed("reflectance = 0.5", "texture = \"a_folder\""),
                ":16:11:", "is a folder"},
        BadFile{"texture is no picture", changed("reflectance = 0.5", "texture = \"paint.csv\""),
                ":16:11:", "cannot be read"},
        BadFile{"texture inside a file that is not there", changed("reflectance = 0.5", "texture = \"x.glb*0\""),
                ":16:11:", "inside no geometry file"},
        BadFile{"no texture, no reflectance", changed("reflectance = 0.5", "texture = \"none\""),
                ":16:11:", "reflectance is needed"},
        BadFile{"two_sided is 1", changed("reflectance = 0.5", "reflectance = 0.5\ntwo_sided = 1"),
                ":17:13:", "true or false"},
        BadFile{"geometry missing", small_scene + "[[geometry]]\nfile = \"no.glb\"\n", ":23:8:", "is not there"},
        BadFile{"geometry is a folder", small_scene + "[[geometry]]\nfile = \"a_folder\"\n", ":23:8:", "is a folder"},
        BadFile{"geometry without file", small_scene + "[[geometry]]\n", ":22:1:", "has no file"},
        BadFile{"object unknown", small_scene + "[[object]]\nname = \"desk\"\nmaterial = \"grey\"\n",
                ":23:8:", "is in no geometry file"},
        BadFile{"object is a polygon", small_scene + "[[object]]\nname = \"floor\"\nmaterial = \"grey\"\n",
                ":23:8:", "is a [[polygon]]"},
        BadFile{"luminaire without power", changed("power = { lumen = 3000 }\n", ""), ":18:1:", "has no power"},
        BadFile{"luminaire names nobody", changed("[\"lamp\"]", "[]"), ":20:11:", "at least one"},
        BadFile{"luminaire names an unknown object", changed("[\"lamp\"]", "[\"lmap\"]"),
                ":20:12:", "did you mean \"lamp\""},
        BadFile{"object lit twice in one", changed("[\"lamp\"]", "[\"lamp\", \"lamp\"]"), ":20:20:", "already"},
        BadFile{"object lit twice",
                small_scene + "[[luminaire]]\nname = \"b\"\nobjects = [\"lamp\"]\npower = { watt = 1 }\n",
                ":24:12:", "luminaire \"light\" already"},
        BadFile{"luminaire twice",
                small_scene + "[[luminaire]]\nname = \"light\"\nobjects = [\"floor\"]\npower = { watt = 1 }\n",
                ":23:8:", "twice"},
        BadFile{"power negative", changed("3000", "-1"), ":21:19:", "lumen = -1 is out of range"},
        BadFile{"power of two units", changed("3000", "3000, watt = 5"), ":21:9:", "{ watt = 40 }"},
        BadFile{"power of an unknown unit", changed("lumen", "lumens"), ":21:11:", "did you mean \"lumen\""},
        BadFile{"power is a number", changed("{ lumen = 3000 }", "3000"), ":21:9:", "{ lumen = 3000 }"},
        BadFile{"dimmer negative", changed("power", "dimmer = -0.5\npower"), ":21:10:", "out of range"},
        BadFile{"side unknown", changed("power", "side = \"top\"\npower"), ":21:8:", "front, back, both"},
        BadFile{"spectrum unknown", changed("power", "spectrum = \"flatt\"\npower"), ":21:12:", "blackbody"},
        BadFile{"blackbody too cold", changed("power", "spectrum = { blackbody = 20 }\npower"),
                ":21:26:", "1000..25000 K"},
        BadFile{"emission negative", changed("power", "spectrum = { file = \"lamp.csv\" }\npower"),
                ":21:12:", "-1 at 700 nm"},
        BadFile{"emission colour negative", changed("power", "spectrum = [1, -1, 1]\npower"),
                ":21:16:", "out of range"},
        BadFile{"camera without target", small_scene + "[camera]\nposition = [0, 1, 3]\n",
                ":22:1:", "[camera] has no target"},
        BadFile{"camera in its target", small_scene + "[camera]\nposition = [0, 1, 3]\ntarget = [0, 1, 3]\n",
                ":24:10:", "where the camera stands"},
        BadFile{"camera looks up", small_scene + "[camera]\nposition = [0, 1, 3]\ntarget = [0, 2, 3]\n",
                ":24:10:", "along its up direction"},
        BadFile{"field of view",
                small_scene + "[camera]\nposition = [0, 1, 3]\ntarget = [0, 0, 0]\nvertical_fov_degrees = 180\n",
                ":25:24:", "1..170"},
        BadFile{"max_display 0", small_scene + "[display]\nmax_display = 0\n", ":23:15:", "1e-30..1e30"},
        BadFile{"gamma 0", small_scene + "[display]\ngamma = 0\n", ":23:9:", "0.1..10"},
        BadFile{"gamma of two channels", small_scene + "[display]\ngamma = [2, 2]\n", ":23:9:", "3"},
        BadFile{"gamma of a channel 0", small_scene + "[display]\ngamma = [2, 2, 0]\n", ":23:16:", "0.1..10"},
        BadFile{"primaries unknown", small_scene + "[display]\nprimaries = \"sRBG\"\n", ":23:13:", "display_p3"},
        BadFile{"white outside of the primaries",
                small_scene + "[display]\nprimaries = [0.6, 0.3, 0.3, 0.6, 0.1, 0.1, 0.7, 0.7]\n",
                ":23:13:", "inside the triangle"},
        BadFile{"scale upside down", small_scene + "[display]\nilluminance_low = 5\nilluminance_high = 2\n",
                ":23:19:", "not below"},
        BadFile{"contour at 0", small_scene + "[display]\nluminance_levels = [1, 0]\n", ":23:24:", "1e-6..1e12"},
        BadFile{"operator unknown", small_scene + "[display]\noperator = \"hdr\"\n", ":23:12:", "filmic"},
        BadFile{"clip unknown", small_scene + "[display]\nclip = \"clam\"\n", ":23:8:", "did you mean \"clamp\""},
        BadFile{"curve unknown", small_scene + "[display]\ncurve = \"linear\"\n", ":23:9:", "srgb, gamma"},
        BadFile{"display is a number", changed("units =", "display = 5\nunits ="), ":2:11:", "write [display]"},
        BadFile{"solver unknown", small_scene + "[solve]\nsolver = \"magic\"\n", ":23:10:", "gathering, shooting"},
        BadFile{"form factors unknown", small_scene + "[solve]\nform_factors = \"hemicub\"\n",
                ":23:16:", "did you mean \"hemicube\"?"},
        BadFile{"form factor samples below 0", small_scene + "[solve]\nform_factor_samples = -1\n",
                ":23:23:", "0..1048576"},
        BadFile{"oracle unknown", small_scene + "[solve]\noracle = \"delphi\"\n",
                ":23:10:", "form_factor, flux, error"},
        BadFile{"link tolerance below 0", small_scene + "[solve]\nlink_tolerance = -0.5\n",
                ":23:18:", "0..1e12 is allowed"},
        BadFile{"no memory", small_scene + "[solve]\nmatrix_memory = 0\n", ":23:17:", "1..1048576"},
        BadFile{"wavelengths unknown", small_scene + "[solve]\nwavelengths = \"uniform:99\"\n", ":23:15:", "uniform"},
        BadFile{"target error 0", small_scene + "[solve]\ntarget_error = 0\n", ":23:16:", "more than 0"},
        BadFile{"rays 0", small_scene + "[solve]\nmax_rays = 0\n", ":23:12:", "1..1048576"},
        BadFile{"seed a decimal", small_scene + "[solve]\nseed = 1.5\n", ":23:8:", "an integer"}),
    [](const auto& one) { return fmt::format("Case{}", one.index); });

TEST_F(SceneTest, AllErrorsComeInOneGo) {
    write("bad.toml", R"(units = "mile"
[[polygon]]
name = "a"
material = "b"
vertices = [[0, 0, 0], [1, 0, 0], [0, nan, 0]]
[[material]]
name = "b"
reflectance = 2
texture = "no.png"
[[luminaire]]
name = "c"
objects = ["d"]
power = { lumen = -5 }
[solve]
speed = "fast"
)");
    const std::string all = lines(errors_of("bad.toml"));
    for (const char* place : {"bad.toml:1:9:", "bad.toml:5:39:", "bad.toml:8:15:", "bad.toml:9:11:", "bad.toml:12:12:",
                              "bad.toml:13:19:", "bad.toml:15:1:"})
        EXPECT_THAT(all, HasSubstr(place));
}

TEST_F(SceneTest, GeometryThatFailsDoesNotMakeItsNamesUnknown) {
    write("bad.toml", "units = \"metre\"\n[[geometry]]\nfile = \"no.glb\"\n[[luminaire]]\nname = \"a\"\nobjects = "
                      "[\"desk\"]\npower = { watt = 1 }\n"
                      "[[material]]\nname = \"of the glb\"\ntwo_sided = true\n");
    const auto errors = errors_of("bad.toml");
    ASSERT_EQ(errors.size(), 1u) << lines(errors);
    EXPECT_THAT(errors[0], HasSubstr("bad.toml:3:8: geometry file \"no.glb\" is not there"));
}

TEST_F(SceneTest, FaultsOfASpectrumFileAreToldInItsOwnLines) {
    write("bad.csv", "wavelength_nm,a\n400,0.5\n500,x\n");
    write("bad.toml", "units = \"metre\"\n[[polygon]]\nname = \"a\"\nmaterial = \"b\"\nvertices = "
                      "[[0,0,0],[1,0,0],[0,1,0]]\n[[material]]\nname = \"b\"\n"
                      "reflectance = { file = \"bad.csv\" }\n");
    const std::string all = lines(errors_of("bad.toml"));
    EXPECT_THAT(all, HasSubstr("bad.toml:8:24:"));
    EXPECT_THAT(all, HasSubstr("bad.csv:3:5:"));
}

TEST_F(SceneTest, PathsThatAreNoSceneAreTold) {
    EXPECT_THAT(lines(errors_of("nowhere.toml")),
                HasSubstr("nowhere.toml: is not there; a .toml, .obj, .gltf or .glb"));
    std::filesystem::create_directories(folder / "folder.toml");
    EXPECT_THAT(lines(errors_of("folder.toml")), HasSubstr("folder.toml: is a folder"));
    write("scene.txt", small_scene);
    EXPECT_THAT(lines(errors_of("scene.txt")), HasSubstr("is not a scene; .toml, .obj, .gltf or .glb is allowed"));
    for (const char* name : {"empty.obj", "empty.gltf", "empty.glb"}) {
        write(name, "");
        EXPECT_THAT(lines(errors_of(name)), HasSubstr("is empty")) << name;
    }
}

} // namespace
} // namespace lueur
