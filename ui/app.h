// The editor with a window: a document, a worker that solves it, and a loop that waits for events.
//
// Idle it draws nothing: a frame follows an event, a new snapshot, a held key or a note that fades, and nothing else.
#pragma once

#include "editor/commands/command_line.h"

namespace lueur {

// Exit status. Without a display: one line on stderr and 1.
int run_editor(const EditorCommand& command);

} // namespace lueur
