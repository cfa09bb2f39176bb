#include "ui/commands.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <array>

namespace lueur {
namespace {

constexpr std::array<CommandInfo, 30> command_table{{
    {Command::open, "Open...", "Ctrl+O"},
    {Command::save, "Save", "Ctrl+S"},
    {Command::save_as, "Save as...", "Ctrl+Shift+S"},
    {Command::screenshot, "Save picture", "F12 or P"},
    {Command::screenshot_as, "Save picture as...", "Shift+P"},
    {Command::spectral_picture_as, "Save spectral picture as...", ""},
    {Command::quit, "Quit", "Ctrl+Q"},
    {Command::undo, "Undo", "Ctrl+Z"},
    {Command::redo, "Redo", "Ctrl+Y"},
    {Command::view_shaded, "Shaded", "1"},
    {Command::view_elements, "Elements", "2"},
    {Command::view_unshot, "Unshot energy", "3"},
    {Command::view_luminance, "Luminance in false colours", "4"},
    {Command::view_illuminance, "Illuminance, isolux lines", "5"},
    {Command::view_side_by_side, "Spectral beside RGB", "6"},
    {Command::view_difference, "Difference from RGB", "7"},
    {Command::view_error, "Estimated error", "8"},
    {Command::frame_selection, "Frame the selection, or all", "F"},
    {Command::home, "Camera of the scene", "Home"},
    {Command::toggle_panels, "Hide or show the panels", "Tab"},
    {Command::toggle_probe, "Probe beside the pointer", "T"},
    {Command::toggle_links, "Links of the place clicked at", "L"},
    {Command::toggle_levels, "Outlines of the element levels", "V"},
    {Command::deselect, "Select nothing", "Esc"},
    {Command::pause, "Pause or go on solving", "Space"},
    {Command::step, "One step while paused", "."},
    {Command::restart, "Solve again from black", "Ctrl+R"},
    {Command::help, "Keys and mouse", "F1"},
    {Command::log, "Messages", "F2"},
    {Command::about, "About Lueur", ""},
}};

} // namespace

std::span<const CommandInfo> all_commands() {
    return command_table;
}

const CommandInfo& info(Command command) {
    for (const auto& entry : command_table)
        if (entry.command == command) return entry;
    return command_table.back();
}

std::optional<Command> command_for_key(int key, int modifiers) {
    const bool control = modifiers & GLFW_MOD_CONTROL, shift = modifiers & GLFW_MOD_SHIFT;
    if (modifiers & (GLFW_MOD_ALT | GLFW_MOD_SUPER)) return {};
    if (control) {
        switch (key) {
        case GLFW_KEY_O:
            return Command::open;
        case GLFW_KEY_S:
            return shift ? Command::save_as : Command::save;
        case GLFW_KEY_Z:
            return shift ? Command::redo : Command::undo;
        case GLFW_KEY_Y:
            return Command::redo;
        case GLFW_KEY_Q:
            return Command::quit;
        case GLFW_KEY_R:
            return Command::restart;
        default:
            return {};
        }
    }
    switch (key) {
    case GLFW_KEY_F12:
    case GLFW_KEY_P:
        return shift ? Command::screenshot_as : Command::screenshot;
    case GLFW_KEY_1:
    case GLFW_KEY_KP_1:
        return Command::view_shaded;
    case GLFW_KEY_2:
    case GLFW_KEY_KP_2:
        return Command::view_elements;
    case GLFW_KEY_3:
    case GLFW_KEY_KP_3:
        return Command::view_unshot;
    case GLFW_KEY_4:
    case GLFW_KEY_KP_4:
        return Command::view_luminance;
    case GLFW_KEY_5:
    case GLFW_KEY_KP_5:
        return Command::view_illuminance;
    case GLFW_KEY_6:
    case GLFW_KEY_KP_6:
        return Command::view_side_by_side;
    case GLFW_KEY_7:
    case GLFW_KEY_KP_7:
        return Command::view_difference;
    case GLFW_KEY_8:
    case GLFW_KEY_KP_8:
        return Command::view_error;
    case GLFW_KEY_F:
        return Command::frame_selection;
    case GLFW_KEY_HOME:
        return Command::home;
    case GLFW_KEY_TAB:
        return Command::toggle_panels;
    case GLFW_KEY_T:
        return Command::toggle_probe;
    case GLFW_KEY_L:
        return Command::toggle_links;
    case GLFW_KEY_V:
        return Command::toggle_levels;
    case GLFW_KEY_ESCAPE:
        return Command::deselect;
    case GLFW_KEY_SPACE:
        return Command::pause;
    case GLFW_KEY_PERIOD:
        return Command::step;
    case GLFW_KEY_F1:
        return Command::help;
    case GLFW_KEY_F2:
        return Command::log;
    default:
        return {};
    }
}

} // namespace lueur
