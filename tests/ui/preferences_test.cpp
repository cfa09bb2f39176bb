#include "ui/preferences.h"

#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace lueur {
namespace {

struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("lueur-preferences-" + std::to_string(getpid()));
    ~Folder() { std::filesystem::remove_all(path); }
};

TEST(Preferences, ComeBackAsTheyWere) {
    const Folder folder;
    Preferences before;
    before.width = 1723;
    before.scale = 1.25;
    before.maximized = true;
    before.layout.column_width = 411;
    before.layout.panels_visible = false;
    remember_recent(before, "/a/one.toml");
    remember_recent(before, "/a/two.toml");
    remember_recent(before, "/a/one.toml"); // newest first, once each
    ASSERT_TRUE(save_preferences(before, folder.path / "deep" / "window.json"));
    const auto after = load_preferences(folder.path / "deep" / "window.json");
    EXPECT_EQ(after.width, 1723);
    EXPECT_EQ(after.scale, 1.25);
    EXPECT_TRUE(after.maximized);
    EXPECT_EQ(after.layout.column_width, 411);
    EXPECT_FALSE(after.layout.panels_visible);
    EXPECT_EQ(after.recent, (std::vector<std::filesystem::path>{"/a/one.toml", "/a/two.toml"}));
}

TEST(Preferences, RubbishGivesDefaults) {
    const Folder folder;
    std::filesystem::create_directories(folder.path);
    for (const char* text :
         {"", "{", "[]", "{\"width\": \"wide\", \"recent\": 3}", "{\"width\": -5, \"scale\": 1e9}"}) {
        const auto file = folder.path / "window.json";
        std::ofstream(file) << text;
        const auto preferences = load_preferences(file);
        EXPECT_GE(preferences.width, 640) << text;
        EXPECT_LE(preferences.scale, 4) << text;
        EXPECT_TRUE(preferences.recent.empty()) << text;
    }
    EXPECT_EQ(load_preferences(folder.path / "is not there").width, Preferences{}.width);
}

} // namespace
} // namespace lueur
