#include "core/spectrum/spectrum_library.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <tuple>

namespace lueur {

namespace {

struct Header {
    LibraryGroup group;
    std::string prefix;
};

// The comments before the first line that is none; nothing for a file that is not of the library.
std::optional<Header> read_header(const std::filesystem::path& file) {
    Header header;
    header.group.file = file;
    std::ifstream stream(file, std::ios::binary);
    for (std::string line; std::getline(stream, line) && line.starts_with('#');) {
        if (line.ends_with('\r')) line.pop_back();
        const auto after = [&](std::string_view key) -> std::optional<std::string> {
            return line.starts_with(key) ? std::optional(line.substr(key.size())) : std::nullopt;
        };
        if (const auto name = after("# library: ")) header.group.name = *name;
        if (const auto prefix = after("# prefix: ")) header.prefix = *prefix;
        if (const auto kind = after("# kind: "); kind && *kind == "reflectance")
            header.group.kind = LibraryKind::reflectance;
        if (const auto source = after("# source: "))
            header.group.source += (header.group.source.empty() ? "" : " ") + *source;
    }
    return header.group.name.empty() ? std::nullopt : std::optional(std::move(header));
}

} // namespace

std::expected<SpectrumLibrary, SpectrumErrors> list_spectrum_library(const std::filesystem::path& folder) {
    std::vector<Header> headers;
    std::error_code error;
    for (const auto& file : std::filesystem::directory_iterator(folder, error))
        if (file.path().extension() == ".csv")
            if (auto header = read_header(file.path())) headers.push_back(std::move(*header));
    std::ranges::sort(headers, {}, [](const Header& header) { return std::tie(header.group.name, header.group.file); });

    SpectrumLibrary library;
    SpectrumErrors errors;
    for (const Header& header : headers) {
        auto columns = spectrum_columns(header.group.file);
        if (!columns) {
            errors.insert(errors.end(), columns.error().begin(), columns.error().end());
            continue;
        }
        library.groups.push_back(header.group);
        for (const std::string& column : *columns) {
            const std::string name = header.prefix + column;
            if (find_entry(library, header.group.kind, name))
                errors.push_back(fmt::format("{}: \"{}\" is in the library already; allowed: each name once",
                                             header.group.file.string(), name));
            library.entries.push_back({name, column, library.groups.size() - 1});
        }
    }
    if (!errors.empty()) return std::unexpected(std::move(errors));
    return library;
}

const LibraryEntry* find_entry(const SpectrumLibrary& library, LibraryKind kind, const std::string& name) {
    for (const LibraryEntry& entry : library.entries)
        if (entry.name == name && library.groups[entry.group].kind == kind) return &entry;
    return nullptr;
}

std::expected<Spectrum, SpectrumErrors> read_library_spectrum(const SpectrumLibrary& library,
                                                              const LibraryEntry& entry) {
    return read_spectrum(library.groups.at(entry.group).file, entry.column);
}

} // namespace lueur
