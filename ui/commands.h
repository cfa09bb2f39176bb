// Everything that menus, keys and buttons can ask for, once: the menus, the help page and the keyboard read the same
// table.
#pragma once

#include <optional>
#include <span>

namespace lueur {

enum class Command {
    open,
    save,
    save_as,
    screenshot,
    screenshot_as,
    spectral_picture_as,
    quit,
    undo,
    redo,
    view_shaded,
    view_elements,
    view_unshot,
    view_luminance,
    view_illuminance,
    view_side_by_side,
    view_difference,
    view_error,
    frame_selection,
    home,
    toggle_panels,
    toggle_probe,
    toggle_links,
    toggle_levels,
    deselect,
    pause,
    step,
    restart,
    help,
    log,
    about,
};

struct CommandInfo {
    Command command;
    const char* text; // in menus and on the help page
    const char* keys; // as shown
};

std::span<const CommandInfo> all_commands();
const CommandInfo& info(Command command);

// GLFW key and modifier bits -> what they ask for.
std::optional<Command> command_for_key(int key, int modifiers);

} // namespace lueur
