// What the programs of this folder have in common: options by the library that `lueur` uses, scenes with their faults
// told, exit status 2 for what cannot be read.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/scene/scene_file.h"

namespace lueur::bench {

inline constexpr int exit_mistake = 2;

// Nothing: go on; else the exit status.
inline std::optional<int> parse(CLI::App& program, int argc, char** argv) {
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return program.exit(error) == 0 ? 0 : exit_mistake;
    }
    return {};
}

// Nothing: its faults are on the standard error stream.
inline std::optional<Scene> scene_of(const std::string& file) {
    auto loaded = load_scene(file);
    if (loaded) return loaded->scene;
    for (const std::string& line : loaded.error()) fmt::print(stderr, "{}\n", line);
    return {};
}

} // namespace lueur::bench
