#include "ui/commands.h"

#include <set>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace lueur {
namespace {

TEST(Commands, EachIsInTheTableOnce) {
    std::set<Command> seen;
    for (const auto& entry : all_commands()) {
        EXPECT_TRUE(seen.insert(entry.command).second) << entry.text;
        EXPECT_EQ(&info(entry.command), &entry);
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(Command::about) + 1);
}

TEST(Commands, KeysAskForThem) {
    EXPECT_EQ(command_for_key(GLFW_KEY_O, GLFW_MOD_CONTROL), Command::open);
    EXPECT_EQ(command_for_key(GLFW_KEY_S, GLFW_MOD_CONTROL), Command::save);
    EXPECT_EQ(command_for_key(GLFW_KEY_S, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT), Command::save_as);
    EXPECT_EQ(command_for_key(GLFW_KEY_Z, GLFW_MOD_CONTROL), Command::undo);
    EXPECT_EQ(command_for_key(GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT), Command::redo);
    EXPECT_EQ(command_for_key(GLFW_KEY_Y, GLFW_MOD_CONTROL), Command::redo);
    EXPECT_EQ(command_for_key(GLFW_KEY_F12, 0), Command::screenshot);
    EXPECT_EQ(command_for_key(GLFW_KEY_P, 0), Command::screenshot);
    EXPECT_EQ(command_for_key(GLFW_KEY_SPACE, 0), Command::pause);
    EXPECT_EQ(command_for_key(GLFW_KEY_TAB, 0), Command::toggle_panels);
    EXPECT_EQ(command_for_key(GLFW_KEY_L, 0), Command::toggle_links);
    EXPECT_EQ(command_for_key(GLFW_KEY_V, 0), Command::toggle_levels);
    // S alone walks back; it must not save.
    EXPECT_EQ(command_for_key(GLFW_KEY_S, 0), std::nullopt);
    EXPECT_EQ(command_for_key(GLFW_KEY_TAB, GLFW_MOD_ALT), std::nullopt);
}

} // namespace
} // namespace lueur
