// A folder of spectra known by name: CIE illuminants, measured lamps, paints.
//
// Each .csv of the folder whose comments hold `# library: GROUP` is part of it, and every column is one spectrum, named
// as the column is (after `# prefix: TEXT `, where there is one). `# kind: reflectance` says that the values are 0..1
// and paint; else they are lights. `# source: TEXT` says where the figures come from; it may go on in more such lines.
#pragma once

#include <filesystem>

#include "core/spectrum/read_spectrum.h"

namespace lueur {

enum class LibraryKind { light, reflectance };

struct LibraryGroup { // a file
    std::filesystem::path file;
    std::string name;   // "CIE fluorescent lamps"
    std::string source; // for a person
    LibraryKind kind = LibraryKind::light;
};

struct LibraryEntry {
    std::string name; // unique within its kind
    std::string column;
    std::size_t group = 0;
};

struct SpectrumLibrary {
    std::vector<LibraryGroup> groups; // by name
    std::vector<LibraryEntry> entries;
};

// What the folder holds; reads no numbers. A folder that is not there is an empty library. Files that cannot be read
// and names that are there twice are errors.
std::expected<SpectrumLibrary, SpectrumErrors> list_spectrum_library(const std::filesystem::path& folder);

const LibraryEntry* find_entry(const SpectrumLibrary& library, LibraryKind kind, const std::string& name);

std::expected<Spectrum, SpectrumErrors> read_library_spectrum(const SpectrumLibrary& library,
                                                              const LibraryEntry& entry);

} // namespace lueur
