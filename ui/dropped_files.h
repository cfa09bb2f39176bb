// Files that are dropped on the window or chosen for a material or a luminaire, made into edits.
#pragma once

#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/edit.h"
#include "editor/snapshot.h"
#include "ui/spectrum_state.h"

namespace lueur {

enum class DroppedKind { scene, picture, spectrum, unknown };
DroppedKind kind_of_dropped(const std::filesystem::path& file); // by its name
std::vector<std::string> picture_extensions();

// Errors are one line for a person.
std::expected<Edit, std::string> texture_edit(const std::filesystem::path& file, const Scene& scene,
                                              MaterialIndex material);
std::expected<Edit, std::string> reflectance_edit(const std::filesystem::path& file, const std::string& column,
                                                  const Scene& scene, MaterialIndex material);
std::expected<Edit, std::string> emission_edit(const std::filesystem::path& file, const std::string& column,
                                               const Scene& scene, LuminaireIndex luminaire);

// A picture becomes the texture of the surface it fell on, a spectrum its reflectance, or the lamp's spectrum where it
// fell on a lamp. Beside the picture, a spectrum is for what the panel in front has open.
std::expected<Edit, std::string> edit_of_dropped(const std::filesystem::path& file, const Scene& scene,
                                                 const std::optional<Probe>& target, const SpectrumTarget& open = {});

} // namespace lueur
