#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/spectrum/spectrum_text.h"

namespace lueur {

namespace {

constexpr std::string_view allowed_csv =
    "allowed: a text file, a header line wavelength_nm,NAME,... and rows of numbers";

std::vector<Cell> split(std::string_view line, std::size_t number) {
    std::vector<Cell> cells;
    std::size_t start = 0;
    while (true) {
        const std::size_t comma = std::min(line.find(',', start), line.size());
        std::size_t first = start, last = comma;
        while (first < last && (line[first] == ' ' || line[first] == '\t')) ++first;
        while (last > first && (line[last - 1] == ' ' || line[last - 1] == '\t')) --last;
        cells.push_back({line.substr(first, last - first), number, first + 1});
        if (comma == line.size()) return cells;
        start = comma + 1;
    }
}

bool says_nothing(const std::vector<Cell>& cells) {
    return cells.front().text.starts_with('#') || (cells.size() == 1 && cells.front().text.empty());
}

// The index of the wanted column among the header's cells.
std::optional<std::size_t> find_column(SpectrumText& text, const std::vector<Cell>& header, const std::string& column) {
    if (header.front().text != "wavelength_nm") {
        text.error(header.front(),
                   fmt::format("the first column is \"{}\"; allowed: wavelength_nm, then one or more columns of "
                               "values, parted by commas",
                               header.front().text));
        return {};
    }
    std::vector<std::string_view> names;
    for (std::size_t i = 1; i < header.size(); ++i) names.push_back(header[i].text);
    if (names.empty()) {
        text.error(header.front(),
                   "there is no column of values; allowed: wavelength_nm, then one or more columns of values");
        return {};
    }
    if (column.empty()) return 1;
    std::optional<std::size_t> found;
    for (std::size_t i = 1; i < header.size(); ++i) {
        if (header[i].text != column) continue;
        if (found) {
            text.error(header[i], fmt::format("column \"{}\" is there twice; allowed: each name once", column));
            return {};
        }
        found = i;
    }
    if (!found)
        text.error({{}, header.front().line, 1},
                   fmt::format("there is no column \"{}\"; allowed: {}", column, fmt::join(names, ", ")));
    return found;
}

} // namespace

std::expected<Spectrum, SpectrumErrors> read_spectrum_csv(const std::filesystem::path& file,
                                                          const std::string& column) {
    auto opened = open_spectrum_text(file, allowed_csv);
    if (!opened) return std::unexpected(std::move(opened.error()));
    SpectrumText& text = *opened;

    Spectrum spectrum;
    std::size_t column_count = 0; // 0: no header yet
    std::optional<std::size_t> wanted;
    std::string_view line;
    for (SpectrumLines lines(text.text); !text.full() && lines.next(line);) {
        const std::vector<Cell> cells = split(line, lines.number());
        if (says_nothing(cells)) continue;
        if (column_count == 0) {
            column_count = cells.size();
            wanted = find_column(text, cells, column);
            if (cells.front().text != "wavelength_nm") break; // not a spectrum file: its rows would all be wrong
            continue;
        }
        if (cells.size() != column_count) {
            text.error(cells.back(),
                       fmt::format("{} cells; allowed: {}, as the header has", cells.size(), column_count));
            continue;
        }
        if (const auto nm = text.wavelength(cells.front())) text.append_wavelength(spectrum, cells.front(), *nm);
        if (!wanted) continue;
        if (const auto value = text.number(cells[*wanted])) spectrum.value.push_back(*value);
    }
    if (column_count == 0) text.error(fmt::format("is empty; {}", allowed_csv));
    return text.finish(std::move(spectrum));
}

std::expected<std::vector<std::string>, SpectrumErrors> csv_columns(const std::filesystem::path& file) {
    auto opened = open_spectrum_text(file, allowed_csv);
    if (!opened) return std::unexpected(std::move(opened.error()));
    std::string_view line;
    for (SpectrumLines lines(opened->text); lines.next(line);) {
        const std::vector<Cell> cells = split(line, lines.number());
        if (says_nothing(cells)) continue;
        if (!find_column(*opened, cells, {})) return std::unexpected(std::move(opened->errors));
        std::vector<std::string> names;
        for (std::size_t i = 1; i < cells.size(); ++i) names.emplace_back(cells[i].text);
        return names;
    }
    opened->error(fmt::format("is empty; {}", allowed_csv));
    return std::unexpected(std::move(opened->errors));
}

} // namespace lueur
