// Holds the repository to the rules of the house (layout_rules.h), and shows that the rules catch what they are for.
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "tests/layout/layout_rules.h"
#include "tests/support/source_folder.h"

namespace lueur {
namespace {

namespace fs = std::filesystem;

const fs::path root = test::source_folder();

std::vector<fs::path> files_under(const fs::path& folder) {
    std::vector<fs::path> files;
    if (!fs::exists(folder)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

bool is_source(const fs::path& file) {
    const std::string extension = file.extension().string();
    return extension == ".h" || extension == ".cpp" || extension == ".inc" || extension == ".glsl";
}

TEST(Repository, EveryIncludeFollowsTheOrder) {
    std::vector<std::string> faults;
    std::size_t includes = 0;
    for (const char* room : {"core", "editor", "ui"}) {
        for (const fs::path& file : files_under(root / room)) {
            if (!is_source(file)) continue;
            const std::string name = fs::relative(file, root).generic_string();
            for (const Include& include : includes_of(text_of(file))) {
                ++includes;
                if (const auto fault = include_fault(name, include))
                    faults.push_back(fmt::format("{}:{}: {}", name, include.line, *fault));
            }
        }
    }
    EXPECT_GT(includes, 100u) << "the walk found the sources";
    EXPECT_TRUE(faults.empty()) << fmt::format("{}", fmt::join(faults, "\n"));
}

TEST(Repository, TheRootHoldsNothingElse) {
    std::vector<std::string> faults;
    for (const auto& entry : fs::directory_iterator(root))
        if (const auto fault = root_entry_fault(entry.path().filename().string(), entry.is_directory()))
            faults.push_back(*fault);
    EXPECT_TRUE(faults.empty()) << fmt::format("{}", fmt::join(faults, "\n"));
}

TEST(Repository, AssetsAreSmall) {
    std::vector<std::string> faults;
    for (const fs::path& file : files_under(root / "assets"))
        if (const auto fault = asset_fault(fs::relative(file, root).generic_string(), fs::file_size(file)))
            faults.push_back(*fault);
    EXPECT_TRUE(faults.empty()) << fmt::format("{}", fmt::join(faults, "\n"));
}

bool may_include(std::string_view file, std::string_view path) {
    return !include_fault(file, {std::string(path), true, 1});
}
bool may_include_system(std::string_view file, std::string_view path) {
    return !include_fault(file, {std::string(path), false, 1});
}

TEST(LayoutRules, ARoomSeesItselfAndWhatStandsToItsLeft) {
    const std::vector<std::string> order{"core/spectrum", "core/display", "core/scene", "core/transport",
                                         "core/solve",    "core/view",    "editor",     "ui"};
    for (std::size_t from = 0; from < order.size(); ++from)
        for (std::size_t to = 0; to < order.size(); ++to)
            EXPECT_EQ(may_include(order[from] + "/a.cpp", order[to] + "/b.h"), to <= from)
                << order[from] << " -> " << order[to];
    EXPECT_FALSE(may_include("editor/commands/a.cpp", "ui/window.h"));
    EXPECT_TRUE(may_include("editor/commands/a.cpp", "editor/edit.h"));
}

TEST(LayoutRules, IncludesAreWrittenFromTheRoot) {
    EXPECT_FALSE(may_include("core/scene/scene.cpp", "scene.h"));
    EXPECT_FALSE(may_include("core/scene/scene.cpp", "../spectrum/spectrum.h"));
    EXPECT_FALSE(may_include("core/scene/scene.cpp", "tests/scene/helper.h"));
    EXPECT_FALSE(may_include_system("core/scene/scene.cpp", "core/scene/scene.h"));
    EXPECT_FALSE(may_include("core/other/a.cpp", "core/scene/scene.h")) << "a room nobody knows";
    EXPECT_TRUE(may_include_system("core/scene/scene.cpp", "vector"));
    EXPECT_TRUE(may_include_system("core/scene/scene.cpp", "glm/glm.hpp"));
}

TEST(LayoutRules, ForeignLibrariesHaveOnePlace) {
    struct Case {
        const char* header;
        const char* allowed;
        const char* forbidden;
    };
    for (const Case& c : {Case{"embree3/rtcore.h", "core/transport/world.cpp", "core/transport/mesh.cpp"},
                          Case{"OpenImageIO/imageio.h", "core/display/image_file.cpp", "core/display/display.cpp"},
                          Case{"assimp/scene.h", "core/scene/gltf_file.cpp", "core/scene/scene_file.cpp"},
                          Case{"toml++/toml.h", "core/scene/scene_file.cpp", "editor/document.cpp"},
                          Case{"GLFW/glfw3.h", "ui/window.cpp", "editor/worker.cpp"},
                          Case{"GL/gl.h", "ui/viewport.cpp", "core/view/picture.cpp"},
                          Case{"epoxy/gl.h", "ui/viewport.cpp", "editor/worker.cpp"},
                          Case{"imgui.h", "ui/panels/a.cpp", "editor/edit.cpp"},
                          Case{"imgui/imgui.h", "ui/panels/a.cpp", "core/display/display.cpp"}}) {
        EXPECT_TRUE(may_include_system(c.allowed, c.header)) << c.header;
        EXPECT_TRUE(may_include(c.allowed, c.header)) << c.header << " in quotes";
        EXPECT_FALSE(may_include_system(c.forbidden, c.header)) << c.header;
        EXPECT_FALSE(may_include(c.forbidden, c.header)) << c.header << " in quotes";
    }
}

TEST(LayoutRules, IncludesAreFoundHoweverTheyAreWritten) {
    const auto found = includes_of("// #include \"no.h\"\n#include \"core/a.h\"\n  #  include <b.h> // why\r\nint "
                                   "x;\n#include\"c.h\"\n#define include\n#include MACRO");
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0].path, "core/a.h");
    EXPECT_TRUE(found[0].quoted);
    EXPECT_EQ(found[0].line, 2);
    EXPECT_EQ(found[1].path, "b.h");
    EXPECT_FALSE(found[1].quoted);
    EXPECT_EQ(found[1].line, 3);
    EXPECT_EQ(found[2].path, "c.h");
    EXPECT_TRUE(includes_of("").empty());
}

TEST(LayoutRules, TheRootsEntriesAreKnown) {
    for (const char* folder : {"core", "editor", "ui", "assets", "tests", ".git", ".ci", "build", "build-asan"})
        EXPECT_FALSE(root_entry_fault(folder, true)) << folder;
    for (const char* file : {"CMakeLists.txt", "README.md", "LICENSE", ".clang-format"})
        EXPECT_FALSE(root_entry_fault(file, false)) << file;
    for (const char* file : {"notes.txt", "core", "build.sh", "picture.png"})
        EXPECT_TRUE(root_entry_fault(file, false)) << file;
    for (const char* folder : {"docs", "LICENSE", "third_party"}) EXPECT_TRUE(root_entry_fault(folder, true)) << folder;
}

TEST(LayoutRules, AnAssetHasAtMostFourMebibytes) {
    EXPECT_FALSE(asset_fault("assets/a.png", 4 * 1024 * 1024));
    EXPECT_TRUE(asset_fault("assets/a.png", 4 * 1024 * 1024 + 1));
}

} // namespace
} // namespace lueur
