// The spectra of a scene file: reflectances and emissions in all their forms (scene_file.h has the format).
#pragma once

#include <filesystem>
#include <optional>

#include "core/scene/scene.h"
#include "core/scene/toml_values.h"
#include "core/spectrum/spectrum_library.h"

namespace lueur {

class TomlSpectra {
public:
    // Paths are seen from `folder`; `library` is the folder of the program's own spectra, empty when there is none.
    TomlSpectra(const TomlFile& file, std::filesystem::path folder, std::filesystem::path library)
        : file_(file)
        , folder_(std::move(folder))
        , library_folder_(std::move(library)) {}

    // Each gives nothing after having told the error.
    std::optional<Reflectance> reflectance(const toml::node& node);
    std::optional<EmissionSpectrum> emission(const toml::node& node);

private:
    std::optional<SpectrumFile> from_file(const toml::table& node, const std::string& what);
    std::optional<LibrarySpectrum> from_library(const toml::table& node, const std::string& what, LibraryKind kind);
    std::optional<Drawn> from_points(const toml::table& node, const std::string& what);
    std::optional<Lines> lines(const toml::table& node);
    std::optional<double> kelvin(const toml::table& node, std::string_view key, double lowest);
    std::optional<SimpleEmission> simple(const toml::node& node);
    std::optional<Mix> mix(const toml::table& node);
    bool list_library(const toml::node& node);

    const TomlFile& file_;
    std::filesystem::path folder_, library_folder_;
    std::optional<SpectrumLibrary> library_; // listed when it is first asked for
};

} // namespace lueur
