// `.spd`: one wavelength and one value a line.
#include <algorithm>
#include <fmt/format.h>

#include "core/spectrum/spectrum_text.h"

namespace lueur {

namespace {

constexpr std::string_view blanks = " \t,;";

std::vector<Cell> words(std::string_view line, std::size_t number) {
    line = line.substr(0, std::min(line.find('#'), line.size()));
    std::vector<Cell> cells;
    for (std::size_t start = line.find_first_not_of(blanks); start != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(blanks, start), line.size());
        cells.push_back({line.substr(start, end - start), number, start + 1});
        start = line.find_first_not_of(blanks, end);
    }
    return cells;
}

} // namespace

std::expected<Spectrum, SpectrumErrors> read_pairs(SpectrumText text, const std::string& column) {
    Spectrum spectrum;
    if (!column.empty())
        text.error(fmt::format("there is no column \"{}\"; allowed: none, for the file holds one spectrum", column));
    bool any = false;
    std::string_view line;
    for (SpectrumLines lines(text.text); !text.full() && lines.next(line);) {
        const std::vector<Cell> cells = words(line, lines.number());
        if (cells.empty()) continue;
        any = true;
        if (cells.size() != 2) {
            text.error(cells.size() > 2 ? cells[2] : cells[0],
                       fmt::format("{} numbers in a line; allowed: two, a wavelength in nm and a value", cells.size()));
            continue;
        }
        if (const auto nm = text.wavelength(cells[0])) text.append_wavelength(spectrum, cells[0], *nm);
        if (const auto value = text.number(cells[1])) spectrum.value.push_back(*value);
    }
    if (!any) text.error(fmt::format("is empty; {}", text.allowed));
    return text.finish(std::move(spectrum));
}

} // namespace lueur
