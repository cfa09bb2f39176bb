#include <cstdio>
#include <variant>

#include "editor/commands/command_line.h"
#include "ui/app.h"

namespace {

int run(const lueur::ExitNow& exit) {
    std::fputs(exit.text.c_str(), exit.code == 0 ? stdout : stderr);
    return exit.code;
}
int run(const lueur::EditorCommand& command) {
    return lueur::run_editor(command);
}
using lueur::run;

} // namespace

int main(int argc, char** argv) {
    return std::visit([](const auto& command) { return run(command); }, lueur::parse_command_line(argc, argv));
}
