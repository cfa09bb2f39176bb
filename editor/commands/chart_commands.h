// The charts of `lueur chart`, one function a subject.
#pragma once

#include <memory>

#include "editor/commands/batch_session.h"
#include "editor/commands/command_line.h"

namespace lueur {

// The scene, when it and the output files are in order; what is not has been told.
std::shared_ptr<Scene> chart_scene(const ChartCommand& command, BatchSession& session);

int chart_methods(const ChartCommand& command, BatchSession& session);
int chart_spectra(const ChartCommand& command, BatchSession& session);

} // namespace lueur
